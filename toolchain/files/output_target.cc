#include "toolchain/files/output_target.h"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace godobject::files {

using command::ExitCode;
using command::Failure;

namespace {

const char* name_of(std::filesystem::file_type type) {
  switch (type) {
    case std::filesystem::file_type::directory: return "folder";
    case std::filesystem::file_type::block:
    case std::filesystem::file_type::character: return "device";
    case std::filesystem::file_type::fifo: return "pipe";
    case std::filesystem::file_type::socket: return "socket";
    default: return "special file";
  }
}

/// Requires a folder in which the temporary file of an output can be created.
void require_writable(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::status(folder, error).type();
  if (type == std::filesystem::file_type::not_found) {
    throw Failure(ExitCode::kIo,
                  fmt::format("{}: cannot be written: there is no folder {}; make it, or choose a folder "
                              "that exists",
                              file.string(), folder.string()));
  }
  if (type == std::filesystem::file_type::none) throw output_failure(file, "cannot be examined", error.value());
  if (type != std::filesystem::file_type::directory) {
    throw Failure(ExitCode::kIo, fmt::format("{}: cannot be written: {} is not a folder; choose a folder that exists",
                                             file.string(), folder.string()));
  }
  if (::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
    throw output_failure(file, "cannot be written", errno);
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  return folder.empty() ? "." : folder;
}

}  // namespace

std::filesystem::path output_target(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::status(file, error).type();
  if (type == std::filesystem::file_type::none) throw output_failure(file, "cannot be examined", error.value());
  if (type != std::filesystem::file_type::not_found && type != std::filesystem::file_type::regular) {
    throw Failure(ExitCode::kIo,
                  fmt::format("{}: is a {}, which an output would replace; name a new file or one that may be replaced",
                              file.string(), name_of(type)));
  }
  std::filesystem::path target = file;  // status() followed the links, so they end
  while (std::filesystem::is_symlink(target, error)) {
    const std::filesystem::path next = std::filesystem::read_symlink(target, error);
    if (error) throw output_failure(file, "is a link that cannot be followed", error.value());
    target = target.parent_path() / next;  // an absolute path replaces the folder
  }
  require_writable(folder_of(target), file);
  return target;
}

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw output_failure(folder, "cannot be made", error.value());
  require_writable(folder, folder);
}

Failure output_failure(const std::filesystem::path& file, std::string_view what, int error) {
  const bool forbidden = error == EACCES || error == EPERM;
  return Failure(forbidden ? ExitCode::kNoPermission : ExitCode::kIo,
                 fmt::format("{}: {} ({}); {}", file.string(), what, std::strerror(error),
                             forbidden ? "choose a folder that you may write to, or change its permissions"
                                       : "choose a folder that exists, can be written and has free space"));
}

}  // namespace godobject::files
