#include "toolchain/report/study/made_once.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"

namespace godobject::report {
namespace {

/// A lock that one thread of all processes holds at a time.
class FileLock {
 public:
  explicit FileLock(const std::filesystem::path& file)
      : descriptor_(::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666)) {
    int result = descriptor_ < 0 ? -1 : ::flock(descriptor_, LOCK_EX);
    while (result < 0 && errno == EINTR) result = ::flock(descriptor_, LOCK_EX);
    if (result == 0) return;
    const int why = errno;
    if (descriptor_ >= 0) ::close(descriptor_);
    throw command::Failure(command::ExitCode::kIo,
                           fmt::format("{}: cannot be locked ({})", file.string(), std::strerror(why)));
  }
  ~FileLock() { ::close(descriptor_); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace

void make_once(const std::filesystem::path& file, const std::function<void()>& make) {
  const FileLock lock(file.string() + ".lock");
  if (!std::filesystem::exists(file)) make();
}

}  // namespace godobject::report
