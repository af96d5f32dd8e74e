#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace godobject::files {

/// An output file that appears under its name only when it is complete. The bytes go to a temporary file beside it, are
/// flushed to the disk and then renamed. Without `commit` nothing is left behind. A symbolic link is followed and stays
/// a link. Anything but a regular file is never replaced. Throws Failure (kIo, kNoPermission) naming the file.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Buffered, so short pieces are cheap.
  void write(std::string_view text);
  void write(std::span<const std::byte> bytes);

  /// Flushes to the disk. The bytes can then be read under `temporary()`.
  void flush();
  const std::filesystem::path& temporary() const noexcept { return temporary_; }

  /// Flushes the file and gives it its name.
  void commit();

 private:
  void write_through();
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path file_;    // as named by the user
  std::filesystem::path target_;  // after following links
  std::filesystem::path temporary_;
  std::string pending_;
  int descriptor_ = -1;
};

}  // namespace godobject::files
