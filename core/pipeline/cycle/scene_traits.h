#pragma once

#include "core/scene/scene_view.h"

namespace godobject {

/// The parts of the pipelines that a build contains. A build for one scene leaves out the parts that this scene does
/// not need (core/CMakeLists.txt defines GODOBJECT_NO_...); they are not compiled.
struct SceneTraits {
  bool paper = true;
  bool corrected = true;
  bool contact = true;
  bool friction = true;
  bool features = true;  ///< the second direction of `contact`
  bool edges = true;     ///< edge against edge of `contact`
  bool points = true;    ///< `contact` for any number of points; false: only for a frictionless ball (is_ball)
};

/// The parts of this build.
inline constexpr SceneTraits kSceneTraits{
#ifdef GODOBJECT_NO_PAPER
    .paper = false,
#endif
#ifdef GODOBJECT_NO_CORRECTED
    .corrected = false,
#endif
#ifdef GODOBJECT_NO_CONTACT
    .contact = false,
#endif
#ifdef GODOBJECT_NO_FRICTION
    .friction = false,
#endif
#ifdef GODOBJECT_NO_FEATURES
    .features = false,
#endif
#ifdef GODOBJECT_NO_EDGES
    .edges = false,
#endif
#ifdef GODOBJECT_NO_POINTS
    .points = false,
#endif
};

/// A part that a build may leave out.
enum class Part : std::uint8_t { kNone, kPaper, kCorrected, kContact, kFriction, kFeatures, kEdges, kPoints };

/// Returns the first part that a pipeline needs and a build with `traits` leaves out; kNone: the pipeline can run.
/// `has_features`: the scene has the second direction. `ball`: the scene is a ball (is_ball). `has_edges`: the scene
/// has sharp edges of both bodies.
constexpr Part missing_part(const SceneTraits& traits, format::Solver solver, bool friction, bool has_features,
                            bool ball = false, bool has_edges = false) noexcept {
  switch (solver) {
    case format::Solver::kPaper:
      if (!traits.paper) return Part::kPaper;
      break;
    case format::Solver::kCorrected:
      if (!traits.corrected) return Part::kCorrected;
      break;
    case format::Solver::kContact:
      if (!traits.contact) return Part::kContact;
      if (has_features && !traits.features) return Part::kFeatures;
      if (has_edges && !traits.edges) return Part::kEdges;
      if (!traits.points && (!ball || friction)) return Part::kPoints;
      break;
  }
  return friction && !traits.friction ? Part::kFriction : Part::kNone;
}

/// Tells whether the moving body is a ball that is represented by its centre: its one sample point is the centre of
/// mass, and the still body's distances are reduced by the radius.
inline bool is_ball(const SceneView& scene) noexcept {
  return scene.pointshell.size == 1 && scene.pointshell.point(0).isZero(0.0) && !scene.has_features() &&
         !scene.has_edges();
}

/// Returns the first part that a pipeline needs on `scene` and this build leaves out.
inline Part missing_part(const SceneView& scene, format::Solver solver, bool friction) noexcept {
  return missing_part(kSceneTraits, solver, friction, scene.has_features(), is_ball(scene), scene.has_edges());
}

}  // namespace godobject
