#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "core/scene/scene.h"

namespace godobject::command {

/// A scene image in memory, opened. Movable; the scene looks at bytes that stay where they are.
class SceneFile {
 public:
  /// Throws Failure naming the file and the cure: kNoInput if it cannot be read, kBadData if Scene::open refuses it.
  explicit SceneFile(const std::filesystem::path& file);

  const Scene& scene() const { return scene_; }
  std::span<const std::byte> bytes() const;

 private:
  struct alignas(format::kAlignment) Block {
    std::byte byte[format::kAlignment];
  };
  std::vector<Block> blocks_;
  std::size_t size_ = 0;
  Scene scene_;
};

}  // namespace godobject::command
