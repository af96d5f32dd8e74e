#pragma once

#include <cstdint>
#include <string>

#include "godobject/god_object.h"
#include "toolchain/scene_compiler/scene_config.h"

namespace godobject::precision {

/// What of a setting needs an image of its own.
struct ImageSetting {
  double voxel_size = 0.0;      ///< of the still body's field [m]
  bool refined = true;          ///< the field at edges
  bool both_directions = true;  ///< also points of the still body against the moving body's field
  std::uint32_t points = 0;     ///< asked for
  std::uint32_t levels = 0;     ///< at most; fewer where the points do not suffice
};

/// A combination that a user may choose.
struct Setting {
  ImageSetting image;
  Solver solver = Solver::kContact;
  bool friction = false;
  double margin = 0.0;  ///< m of `contact` [m]
};

/// That of a scene file.
ImageSetting image_setting(const scene_compiler::SceneConfig& config);

/// The scene file with another setting. The other lengths follow the voxel edge as their defaults do (safety distance,
/// margin, the body's voxel edge, the bound between points); a shell's thickness stays, as far as the voxels allow.
scene_compiler::SceneConfig with(const scene_compiler::SceneConfig& config, const ImageSetting& setting);

/// "2 mm, refined, both directions, 5587 points, 7 levels"
std::string name(const ImageSetting& setting);

/// "contact, friction, 2 mm, ..."
std::string name(const Setting& setting);

}  // namespace godobject::precision
