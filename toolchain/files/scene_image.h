#pragma once

#include <filesystem>
#include <string>

#include "core/scene/scene.h"
#include "toolchain/files/aligned_bytes.h"

namespace godobject::command {

/// A scene image in memory and the core's view of it.
struct SceneImage {
  AlignedBytes bytes;
  Scene scene;

  /// Throws Failure (kBadData) if it is no image at all, else with the core's reason; `name` is used in the message.
  SceneImage(AlignedBytes image, const std::string& name);

  /// Reads a file. Throws Failure: kNoInput if it cannot be read, kBadData if it is larger than any image.
  static SceneImage read(const std::filesystem::path& file);
};

}  // namespace godobject::command
