#include "firmware/records/log_file.h"

#include <unistd.h>

#include <cerrno>

namespace godobject::firmware {

LogFile::~LogFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

LogFile::LogFile(LogFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_),
      torn_(other.torn_),
      written_(other.written_),
      lost_(other.lost_) {}

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
