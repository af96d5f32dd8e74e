#include "toolchain/command/output_target.h"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

namespace godobject::command {
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

}  // namespace

std::filesystem::path output_target(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::status(file, error).type();
  if (type == std::filesystem::file_type::none) throw output_failure(file, "cannot be looked at", error.value());
  if (type != std::filesystem::file_type::not_found && type != std::filesystem::file_type::regular) {
    throw Failure(ExitCode::kIo,
                  fmt::format("{}: is a {}, which an output would replace; name a file that is new or may be replaced",
                              file.string(), name_of(type)));
  }
  std::filesystem::path target = file;  // status() followed the links: they end
  while (std::filesystem::is_symlink(target, error)) {
    const std::filesystem::path next = std::filesystem::read_symlink(target, error);
    if (error) throw output_failure(file, "is a link that cannot be followed", error.value());
    target = target.parent_path() / next;  // an absolute one replaces the folder
  }
  return target;
}

Failure output_failure(const std::filesystem::path& file, std::string_view what, int error) {
  const bool forbidden = error == EACCES || error == EPERM;
  return Failure(forbidden ? ExitCode::kNoPermission : ExitCode::kIo,
                 fmt::format("{}: {} ({}); {}", file.string(), what, std::strerror(error),
                             forbidden ? "choose a folder that you may write to, or have its rights changed"
                                       : "choose a folder that exists, may be written to and has room"));
}

}  // namespace godobject::command
