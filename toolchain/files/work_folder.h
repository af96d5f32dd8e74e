#pragma once

#include <filesystem>
#include <string_view>

namespace godobject::files {

/// A temporary folder for intermediate files of an output, in the output's own folder, so a rename out of it is atomic.
/// The destructor removes it. Throws Failure (kIo, kNoPermission) if it cannot be created, or if the output would
/// replace anything but a regular file.
class WorkFolder {
 public:
  /// `output`: the file that will appear beside this folder.
  explicit WorkFolder(const std::filesystem::path& output);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Writes a complete file into the folder and returns its path.
  std::filesystem::path write(const char* name, std::string_view text) const;

  /// Moves a finished file out of the folder to `output`.
  void deliver(const char* name, const std::filesystem::path& output) const;

 private:
  std::filesystem::path path_;
};

}  // namespace godobject::files
