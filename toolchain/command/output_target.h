#pragma once

#include <filesystem>
#include <string_view>

#include "firmware/command/failure.h"

namespace godobject::command {

/// The file that an output named `file` makes or replaces: symbolic links are followed, so that a link stays one.
/// Throws Failure: kIo if a folder, a device, a pipe or a socket stands there, which a rename would do away with;
/// kNoPermission if one may not look.
std::filesystem::path output_target(const std::filesystem::path& file);

/// What ends a command whose output `file` failed with `error` (an errno): kNoPermission for EACCES and EPERM, kIo for
/// all others; each with its cure.
Failure output_failure(const std::filesystem::path& file, std::string_view what, int error);

}  // namespace godobject::command
