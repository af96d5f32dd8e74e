#pragma once

#include <string>

namespace godobject::firmware {

/// Prints one line for the user on stderr, after everything that stdout holds: the order stays right where both go to
/// one file.
void warn(const std::string& line);

}  // namespace godobject::firmware
