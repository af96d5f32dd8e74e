#pragma once

#include <filesystem>
#include <string_view>

#include "toolchain/command_line/failure.h"

namespace godobject::files {

/// Returns the file that an output named `file` creates or replaces. Symbolic links are followed, so a link stays one.
/// Call it before the work that makes the output. Throws Failure: kIo if a folder, a device, a pipe or a socket has
/// this name, because a rename would remove it, or if the containing folder does not exist; kNoPermission if that
/// folder cannot be searched or written.
std::filesystem::path output_target(const std::filesystem::path& file);

/// Creates an output folder and its parents if necessary, and checks that it can be written. Throws Failure: kIo if it
/// cannot be created, kNoPermission without the permission.
void make_output_folder(const std::filesystem::path& folder);

/// Returns the failure of an output `file` with `error` (an errno): kNoPermission for EACCES and EPERM, kIo for all
/// others. Each has its cure.
command::Failure output_failure(const std::filesystem::path& file, std::string_view what, int error);

}  // namespace godobject::files
