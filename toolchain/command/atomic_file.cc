#include "toolchain/command/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "toolchain/command/failure.h"

namespace godobject::command {

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)), partial_(fmt::format("{}.{}.part", path_.string(), ::getpid())) {
  file_ = std::fopen(partial_.c_str(), "wb");
  if (file_ == nullptr) fail("cannot be written");
}

AtomicFile::~AtomicFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  std::error_code ignored;
  std::filesystem::remove(partial_, ignored);
}

void AtomicFile::write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }

void AtomicFile::write(std::span<const std::byte> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("could not be written whole");
}

void AtomicFile::commit() {
  if (std::fflush(file_) != 0 || ::fsync(::fileno(file_)) != 0) fail("could not be written whole");
  std::FILE* file = std::exchange(file_, nullptr);
  if (std::fclose(file) != 0 || std::rename(partial_.c_str(), path_.c_str()) != 0) {
    const int error = errno;
    std::error_code ignored;
    std::filesystem::remove(partial_, ignored);
    errno = error;
    fail("could not be put in its place");
  }
}

void AtomicFile::fail(const char* what) const {
  throw Failure(ExitCode::kIo, fmt::format("{}: {} ({}); choose a folder that exists, may be written to and has room",
                                           path_.string(), what, std::strerror(errno)));
}

}  // namespace godobject::command
