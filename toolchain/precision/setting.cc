#include "toolchain/precision/setting.h"

#include <algorithm>

#include <fmt/format.h>

#include "toolchain/scene_compiler/points/sample_elimination.h"

namespace godobject::precision {
namespace {

constexpr double kNeverRefined = 1e3;    // field_tolerance [voxels]: no brick is refined
constexpr double kAlwaysRefined = 0.05;  // field_tolerance [voxels]: the default of scene files

}  // namespace

ImageSetting image_setting(const scene_compiler::SceneConfig& config) {
  return {.voxel_size = config.voxel_size,
          .refined = config.accuracy || config.field_tolerance < 1.0,
          .both_directions = config.both_directions,
          .points = config.points,
          .levels = config.levels};
}

scene_compiler::SceneConfig with(const scene_compiler::SceneConfig& config, const ImageSetting& setting) {
  scene_compiler::SceneConfig changed = config;
  const double ratio = setting.voxel_size / config.voxel_size;
  changed.voxel_size = setting.voxel_size;
  changed.body_voxel_size *= ratio;
  changed.between_points *= ratio;
  changed.settings.safety_distance *= ratio;
  changed.settings.margin *= ratio;
  changed.thickness = std::max(config.thickness, setting.voxel_size);
  if (setting.refined != image_setting(config).refined) {
    changed.field_tolerance = setting.refined ? kAlwaysRefined : kNeverRefined;
    changed.accuracy.reset();
  }
  changed.both_directions = setting.both_directions;
  changed.points = setting.points;
  changed.levels = std::min(setting.levels, scene_compiler::most_levels(setting.points));
  return changed;
}

std::string name(const ImageSetting& setting) {
  return fmt::format("{:.4g} mm, {}, {}, {} points, {} levels", 1e3 * setting.voxel_size,
                     setting.refined ? "refined" : "not refined",
                     setting.both_directions ? "both directions" : "one direction", setting.points, setting.levels);
}

std::string name(const Setting& setting) {
  return fmt::format("{}, {}friction, {}, margin {:.3g} um",
                     format::kSolverNames[static_cast<std::size_t>(setting.solver)], setting.friction ? "" : "no ",
                     name(setting.image), 1e6 * setting.margin);
}

}  // namespace godobject::precision
