#include "firmware/records/log_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"

namespace godobject::firmware {

LogFile::LogFile(const std::filesystem::path& file) : path_(file) {
  const std::filesystem::path folder = file.parent_path();
  std::error_code error;
  if (std::filesystem::create_directories(folder, error); error) {
    throw command::Failure(command::ExitCode::kIo, fmt::format("{}: cannot make this folder ({}); name another one",
                                                               folder.string(), error.message()));
  }
  descriptor_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    throw command::Failure(command::ExitCode::kIo, fmt::format("{}: cannot be written ({}); check the folder",
                                                               file.string(), std::strerror(errno)));
  }
}

LogFile::~LogFile() { ::close(descriptor_); }

void LogFile::write(std::string_view block, std::uint64_t records) {
  std::size_t done = 0;
  while (!torn_ && done < block.size()) {
    const ssize_t put = ::write(descriptor_, block.data() + done, block.size() - done);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) break;
    done += static_cast<std::size_t>(put);
  }
  if (done == block.size()) {
    size_ += done;
    written_ += records;
    return;
  }
  lost_ += records;
  if (done > 0) torn_ = ::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0;
}

}  // namespace godobject::firmware
