#pragma once

#include <filesystem>
#include <string_view>

#include "toolchain/command_line/failure.h"

namespace godobject::files {

/// The file that an output named `file` makes or replaces: symbolic links are followed, so that a link stays one. To be
/// called before the work whose result it is.
/// Throws Failure: kIo if a folder, a device, a pipe or a socket stands there, which a rename would do away with, or if
/// its folder is not there or no folder; kNoPermission if one may not look, or not write to that folder.
std::filesystem::path output_target(const std::filesystem::path& file);

/// Makes a folder of outputs, and those above it, where it is not there; one may write to it.
/// Throws Failure: kIo if it cannot be made, kNoPermission if one may not.
void make_output_folder(const std::filesystem::path& folder);

/// What ends a command whose output `file` failed with `error` (an errno): kNoPermission for EACCES and EPERM, kIo for
/// all others; each with its cure.
command::Failure output_failure(const std::filesystem::path& file, std::string_view what, int error);

}  // namespace godobject::files
