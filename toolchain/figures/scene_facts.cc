#include "toolchain/figures/scene_facts.h"

#include <fmt/format.h>

namespace godobject::figures {

std::string scene_facts(const SceneView& scene) {
  constexpr double kMillimetre = 1e3;
  const format::Settings& settings = scene.settings;
  std::string text = fmt::format("Voxels of {:.4g} mm, {} points of the moving body in {} levels",
                                 kMillimetre * scene.grid.voxel_size, scene.body.point_count, scene.body.level_count);
  if (scene.has_features()) text += fmt::format(", {} of the still one", scene.features.size);
  if (settings.friction == 0) return text + ", no friction.";
  return text + fmt::format(", friction {:.4g} (static) and {:.4g} (kinetic).", settings.friction_static,
                            settings.friction_kinetic);
}

}  // namespace godobject::figures
