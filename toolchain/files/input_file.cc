#include "toolchain/files/input_file.h"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "toolchain/command_line/failure.h"

namespace godobject::files {

using command::ExitCode;
using command::Failure;

namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view what) {
  throw Failure(ExitCode::kNoInput, fmt::format("{}: {}", file.string(), what));
}

[[noreturn]] void refuse_error(const std::filesystem::path& file, std::string_view cure, int error) {
  if (error == ENOENT || error == ENOTDIR) refuse(file, fmt::format("no such file; {}", cure));
  if (error == EACCES) refuse(file, "no permission to read it; change the permissions of the file and its folder");
  refuse(file, fmt::format("cannot be read ({}); {}", std::strerror(error), cure));
}

}  // namespace

void require_input(const std::filesystem::path& file, std::string_view cure) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) refuse_error(file, cure, errno);
  if (S_ISDIR(found.st_mode)) refuse(file, "is a folder; name a file in it");
  if (::faccessat(AT_FDCWD, file.c_str(), R_OK, AT_EACCESS) != 0) refuse_error(file, cure, errno);
}

void require_regular_input(const std::filesystem::path& file, std::string_view cure) {
  require_input(file, cure);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) refuse(file, "is a pipe or a device; name a file");
}

}  // namespace godobject::files
