#pragma once

#include <filesystem>
#include <string>

#include "core/scene/scene_view.h"
#include "toolchain/files/aligned_bytes.h"

namespace godobject::files {

/// A scene image in memory and the core's view of it, for tools at the desk. The controller has its own reader
/// (firmware/configuration/scene_file.h), which locks the memory and accepts no links.
struct SceneImage {
  AlignedBytes bytes;
  SceneView scene;

  /// Opens an image. Throws Failure (kBadData) if the bytes are no image, or with the core's reason. `name` stands for
  /// it in messages.
  SceneImage(AlignedBytes image, const std::string& name);

  /// Reads a file. Throws Failure: kNoInput if it cannot be read, kBadData if it is larger than any image.
  static SceneImage read(const std::filesystem::path& file);
};

}  // namespace godobject::files
