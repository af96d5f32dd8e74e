#include "toolchain/scene_compiler/image/build_traits.h"

#include <vector>

#include <fmt/format.h>

namespace godobject::scene_compiler {

SceneTraits traits_of(const SceneView& scene) noexcept {
  SceneTraits traits;
  traits.paper = scene.holds(format::Solver::kPaper);
  traits.corrected = scene.holds(format::Solver::kCorrected);
  traits.contact = scene.holds(format::Solver::kContact);
  traits.friction = scene.settings.friction != 0;
  traits.features = traits.contact && scene.has_features();
  traits.edges = traits.contact && scene.has_edges();
  traits.points = traits.contact && (traits.friction || !is_ball(scene));
  return traits;
}

std::string traits_text(const SceneTraits& traits, const std::string& scene_name) {
  std::vector<const char*> solvers;
  if (traits.contact) solvers.push_back("contact");
  if (traits.corrected) solvers.push_back("corrected");
  if (traits.paper) solvers.push_back("paper");
  const auto on = [](bool trait) { return trait ? "ON" : "OFF"; };
  return fmt::format(
      "# The parts of the core that {} needs, for a build of its own: cmake -DGODOBJECT_SCENE=<this file>\n"
      "set(GODOBJECT_SCENE_SOLVERS {})\n"
      "set(GODOBJECT_SCENE_FRICTION {})\n"
      "set(GODOBJECT_SCENE_FEATURES {})\n"
      "set(GODOBJECT_SCENE_EDGES {})\n"
      "set(GODOBJECT_SCENE_POINTS {})\n",
      scene_name, fmt::join(solvers, " "), on(traits.friction), on(traits.features), on(traits.edges),
      on(traits.points));
}

}  // namespace godobject::scene_compiler
