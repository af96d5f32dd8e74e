#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "core/scene/scene_view.h"

namespace godobject::firmware {

/// A scene image in memory of its own, so later changes of the file have no effect. The memory is locked against paging
/// if that is permitted, and read-only after validation.
class SceneFile {
 public:
  /// Largest image [bytes]. Chosen: 40 times the largest of the demo, and small enough to be locked in memory.
  static constexpr std::size_t kLargest = std::size_t{1} << 30;

  /// Throws command::Failure: kNoInput if there is no regular file of that name (symbolic links are not followed),
  /// kNoPermission if it may not be read, kBadData if it is no valid image or too large, kIo if reading fails.
  /// Checks header and size before it takes memory. Cost: one pass over the bytes, about 1 ms per MiB.
  explicit SceneFile(const std::filesystem::path& file);
  ~SceneFile();
  SceneFile(const SceneFile&) = delete;
  SceneFile& operator=(const SceneFile&) = delete;

  const SceneView& scene() const noexcept { return scene_; }
  std::size_t size() const noexcept { return size_; }

  /// The checksum in the header. It covers the checksums of all sections, so it tells two images apart.
  std::uint64_t checksum() const noexcept { return checksum_; }
  bool locked() const noexcept { return locked_; }

 private:
  void read(int descriptor, const std::filesystem::path& file);

  std::byte* bytes_ = nullptr;
  std::size_t size_{};
  std::uint64_t checksum_{};
  bool locked_{};
  SceneView scene_;
};

}  // namespace godobject::firmware
