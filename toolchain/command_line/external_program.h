#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace godobject::command {

/// Where a program stands on PATH; nothing if it is not there.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// Runs a program found on PATH, without a shell, and waits. What it prints is kept; it reads nothing.
/// Throws Failure (kInternal): if it is not installed, naming `package` as the cure, or if it fails, with the end of
/// what it printed.
void run_program(const std::vector<std::string>& arguments, const std::string& package);

}  // namespace godobject::command
