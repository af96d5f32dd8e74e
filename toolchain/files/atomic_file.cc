#include "toolchain/files/atomic_file.h"

#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "toolchain/files/output_target.h"

namespace godobject::files {

AtomicFile::AtomicFile(std::filesystem::path file)
    : file_(std::move(file)),
      target_(output_target(file_)),
      temporary_(fmt::format("{}.{}.part", target_.string(), ::getpid())) {
  ::unlink(temporary_.c_str());  // of a process that died; a link that somebody left there is not followed
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail("cannot be written");
}

AtomicFile::~AtomicFile() {
  ::close(descriptor_);
  std::error_code ignored;  // the file does not exist after a rename
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::write(std::string_view text) {
  constexpr std::size_t kPiece = std::size_t{1} << 18;
  pending_ += text;
  if (pending_.size() >= kPiece) write_through();
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  write(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void AtomicFile::write_through() {
  std::string_view rest = pending_;
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("cannot be written completely");
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  pending_.clear();
}

void AtomicFile::flush() {
  write_through();
  // EINVAL, EROFS: the device has nothing to flush
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail("cannot be flushed to the disk");
}

void AtomicFile::commit() {
  flush();
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot be renamed to its final name");
}

void AtomicFile::fail(const char* what) const { throw output_failure(file_, what, errno); }

}  // namespace godobject::files
