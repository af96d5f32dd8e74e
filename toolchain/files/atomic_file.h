#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace godobject::files {

/// An output that appears under its name only when it is complete: written to a temporary name beside it, flushed to
/// the disk, renamed. Without `commit` nothing is left behind. A link is followed and stays one; what is no regular
/// file is never replaced. Throws Failure (kIo, kNoPermission) naming the file.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Cheap for short pieces: they are gathered.
  void write(std::string_view text);
  void write(std::span<const std::byte> bytes);

  /// Flushes to the disk; the bytes can be read back under `temporary()`.
  void flush();
  const std::filesystem::path& temporary() const noexcept { return temporary_; }

  /// Flushes and gives the file its name.
  void commit();

 private:
  void write_through();
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path file_;    // as the user named it
  std::filesystem::path target_;  // behind its links
  std::filesystem::path temporary_;
  std::string pending_;
  int descriptor_ = -1;
};

}  // namespace godobject::files
