#pragma once

#include <filesystem>
#include <string_view>

namespace godobject::files {

/// A folder for what is made on the way to an output, in the output's own folder (so that a rename out of it is
/// atomic); gone at the end, whatever happens. Throws Failure (kIo, kNoPermission) if it cannot be made, or if the
/// output would replace what is no regular file.
class WorkFolder {
 public:
  /// `output` is a file that is to appear beside it.
  explicit WorkFolder(const std::filesystem::path& output);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Writes a file in it whole and returns its path.
  std::filesystem::path write(const char* name, std::string_view text) const;

  /// Moves a finished file out of it.
  void deliver(const char* name, const std::filesystem::path& output) const;

 private:
  std::filesystem::path path_;
};

}  // namespace godobject::files
