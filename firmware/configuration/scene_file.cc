#include "firmware/configuration/scene_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "core/scene/format.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware {
namespace {

using command::ExitCode;
using command::Failure;

/// A file descriptor, closed by the destructor.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

[[noreturn]] void cannot_open(const std::filesystem::path& file, int error) {
  switch (error) {
    case EACCES:
    case EPERM:
      throw Failure(ExitCode::kNoPermission,
                    fmt::format("{}: no right to read it; check its permissions", file.string()));
    case ELOOP:
      throw Failure(ExitCode::kNoInput,
                    fmt::format("{}: is a symbolic link; name the scene image itself", file.string()));
    default:
      throw Failure(ExitCode::kNoInput,
                    fmt::format("{}: {}; check the path, or compile the scene with godobject-scenec", file.string(),
                                std::strerror(error)));
  }
}

[[noreturn]] void refuse(const std::filesystem::path& file, const char* why) {
  throw Failure(ExitCode::kBadData,
                fmt::format("{}: {}; compile the scene again with godobject-scenec", file.string(), why));
}

}  // namespace

SceneFile::SceneFile(const std::filesystem::path& file) {
  // O_NONBLOCK: a named pipe would block
  const Descriptor descriptor{::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK)};
  if (descriptor.number < 0) cannot_open(file, errno);
  struct stat status {};
  if (::fstat(descriptor.number, &status) != 0) cannot_open(file, errno);
  if (!S_ISREG(status.st_mode)) {
    throw Failure(ExitCode::kNoInput, fmt::format("{}: is not a regular file; name a scene image", file.string()));
  }
  size_ = static_cast<std::size_t>(status.st_size);
  if (size_ > kLargest) refuse(file, "is larger than 1 GiB");
  format::Header header{};
  const bool whole = ::pread(descriptor.number, &header, sizeof header, 0) == static_cast<ssize_t>(sizeof header);
  if (!whole || std::memcmp(header.magic, format::kMagic, sizeof header.magic) != 0)
    refuse(file, "is not a scene image");
  if (header.total_bytes != size_) refuse(file, describe(Status::kImageTruncated));

  void* memory = ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) refuse(file, "does not fit into the memory");
  bytes_ = static_cast<std::byte*>(memory);
  try {
    read(descriptor.number, file);
  } catch (...) {
    ::munmap(bytes_, size_);
    throw;
  }
}

void SceneFile::read(int descriptor, const std::filesystem::path& file) {
  for (std::size_t done = 0; done < size_;) {
    const ssize_t got = ::pread(descriptor, bytes_ + done, size_ - done, static_cast<off_t>(done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw Failure(ExitCode::kIo, fmt::format("{}: cannot be read; check the disk", file.string()));
    done += static_cast<std::size_t>(got);
  }
  const Status status = SceneView::open({bytes_, size_}, scene_);
  if (status != Status::kOk) refuse(file, describe(status));
  format::Header header{};
  std::memcpy(&header, bytes_, sizeof header);
  checksum_ = header.checksum;
  ::mprotect(bytes_, size_, PROT_READ);
  locked_ = ::mlock(bytes_, size_) == 0;
}

SceneFile::~SceneFile() {
  if (bytes_ != nullptr) ::munmap(bytes_, size_);
}

}  // namespace godobject::firmware
