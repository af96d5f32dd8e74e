#include "toolchain/command_line/in_build.h"

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"

namespace godobject::command {
namespace {

const char* describe(Part part) {
  switch (part) {
    case Part::kNone: break;
    case Part::kPaper: return "the solver paper";
    case Part::kCorrected: return "the solver corrected";
    case Part::kContact: return "the solver contact";
    case Part::kFriction: return "friction";
    case Part::kFeatures: return "the second direction (points of the still body against the moving body's field)";
    case Part::kEdges: return "edge against edge (sharp edges of both bodies)";
    case Part::kPoints: return "points of a moving body other than a ball without friction";
  }
  return "nothing";
}

}  // namespace

void require_in_build(const std::string& scene_name, const SceneView& scene, format::Solver solver, bool friction,
                      const SceneTraits& traits) {
  const Part missing = missing_part(traits, solver, friction, scene.has_features(), is_ball(scene), scene.has_edges());
  if (missing == Part::kNone) return;
  throw Failure(ExitCode::kBadConfig,
                fmt::format("{}: needs {}, which this build leaves out; build without -DGODOBJECT_SCENE, or with this "
                            "scene's traits (godobject-scenec --traits)",
                            scene_name, describe(missing)));
}

}  // namespace godobject::command
