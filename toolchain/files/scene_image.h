#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "core/scene/scene.h"

namespace godobject::files {

/// The bytes of a scene image, aligned as the format requires, initially zero.
class AlignedBytes {
 public:
  explicit AlignedBytes(std::size_t size);

  std::span<std::byte> span() noexcept { return {bytes_.get(), size_}; }
  std::span<const std::byte> span() const noexcept { return {bytes_.get(), size_}; }

 private:
  struct Free {
    void operator()(std::byte* bytes) const noexcept;
  };
  std::unique_ptr<std::byte, Free> bytes_;
  std::size_t size_;
};

/// A scene image in memory and the core's view of it, for tools at the desk. The controller has its own reader
/// (firmware/scene_file.h), which locks the memory and accepts no links.
struct SceneImage {
  AlignedBytes bytes;
  Scene scene;

  /// Opens an image. Throws Failure (kBadData) if the bytes are no image, or with the core's reason. `name` stands for
  /// it in messages.
  SceneImage(AlignedBytes image, const std::string& name);

  /// Reads a file. Throws Failure: kNoInput if it cannot be read, kBadData if it is larger than any image.
  static SceneImage read(const std::filesystem::path& file);
};

}  // namespace godobject::files
