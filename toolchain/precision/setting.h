#pragma once

#include <cstdint>
#include <string>

#include "godobject/god_object.h"
#include "toolchain/scene_compiler/scene_config.h"

namespace godobject::precision {

/// The part of a setting that needs its own image.
struct ImageSetting {
  double voxel_size = 0.0;      ///< of the still body's field [m]
  bool refined = true;          ///< the field is refined at edges
  bool both_directions = true;  ///< also points of the still body in the moving body's field
  std::uint32_t points = 0;     ///< requested
  std::uint32_t levels = 0;     ///< at most; fewer if the points do not suffice
};

/// A combination that a user can choose.
struct Setting {
  ImageSetting image;
  Solver solver = Solver::kContact;
  bool friction = false;
  double margin = 0.0;  ///< m of `contact` [m]
};

/// Returns the image setting of a scene file.
ImageSetting image_setting(const scene_compiler::SceneConfig& config);

/// Returns the scene file with another setting. Other lengths follow the voxel edge as their defaults do (safety
/// distance, margin, the body's voxel edge, the bound between points). A shell keeps its thickness as far as the voxels
/// allow.
scene_compiler::SceneConfig with(const scene_compiler::SceneConfig& config, const ImageSetting& setting);

/// Returns "2 mm, refined, both directions, 5587 points, 7 levels".
std::string name(const ImageSetting& setting);

/// Returns "contact, friction, 2 mm, ...".
std::string name(const Setting& setting);

}  // namespace godobject::precision
