#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace godobject::command {

/// Returns the path of a program on PATH; nothing if it is not there.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// Runs a program found on PATH, without a shell and without input, and waits for it. Captures its output. Throws
/// Failure (kInternal): if the program is not installed, naming `package` as the cure, or if it fails, with the end of
/// its output.
void run_program(const std::vector<std::string>& arguments, const std::string& package);

}  // namespace godobject::command
