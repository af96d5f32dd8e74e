#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace godobject::scene_compiler {

/// A file that appears under its name only when complete: written to a temporary name beside it, flushed to the disk,
/// renamed. Without `commit` the temporary is removed. Throws Failure (kIo) naming the file.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);

  /// Flushes to the disk; the bytes can be read back under `temporary()`.
  void flush();
  const std::filesystem::path& temporary() const noexcept { return temporary_; }

  /// Flushes and gives the file its name.
  void commit();

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path file_;
  std::filesystem::path temporary_;
  int descriptor_ = -1;
};

}  // namespace godobject::scene_compiler
