#include "toolchain/scene_compiler/output_file.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "toolchain/scene_compiler/failure.h"

namespace godobject::scene_compiler {

OutputFile::OutputFile(std::filesystem::path file)
    : file_(std::move(file)), temporary_(file_.string() + fmt::format(".{}.tmp", ::getpid())) {
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail("cannot be written");
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  std::error_code ignored;  // gone after a rename
  std::filesystem::remove(temporary_, ignored);
}

void OutputFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("writing failed");
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void OutputFile::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

void OutputFile::flush() {
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail("flushing to the disk failed");
}

void OutputFile::commit() {
  flush();
  if (::rename(temporary_.c_str(), file_.c_str()) != 0) fail("cannot be given its name");
}

void OutputFile::fail(const char* what) const {
  throw Failure(ExitCode::kIo, fmt::format("{}: {} ({}); check the folder, its permissions and free space",
                                           file_.string(), what, std::strerror(errno)));
}

}  // namespace godobject::scene_compiler
