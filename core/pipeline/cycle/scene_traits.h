#pragma once

#include "core/scene/scene.h"

namespace godobject {

/// What a build of the core can do: everything, but for what a build for one scene leaves out because that scene does
/// not need it (core/CMakeLists.txt defines GODOBJECT_NO_...). What is left out is not compiled at all.
struct SceneTraits {
  bool paper = true;
  bool corrected = true;
  bool contact = true;
  bool friction = true;
  bool features = true;  ///< the second direction of `contact`
  bool points = true;    ///< any number of points for `contact`; without, a ball by its centre, frictionless (is_ball)
};

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
#ifdef GODOBJECT_NO_POINTS
    .points = false,
#endif
};

/// A part of the pipelines that a build may be without.
enum class Part : std::uint8_t { kNone, kPaper, kCorrected, kContact, kFriction, kFeatures, kPoints };

/// The first part that the pipeline needs on this scene and that a build with `traits` is without; kNone: it can run.
/// `ball`: as is_ball.
constexpr Part missing_part(const SceneTraits& traits, format::Solver solver, bool friction, bool has_features,
                            bool ball = false) noexcept {
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
      if (!traits.points && (!ball || friction)) return Part::kPoints;
      break;
  }
  return friction && !traits.friction ? Part::kFriction : Part::kNone;
}

/// Whether the moving body is a ball that is met by its centre: its one sample point is the centre of mass, and the
/// still body's distances are less by the radius.
inline bool is_ball(const Scene& scene) noexcept {
  return scene.pointshell.size == 1 && scene.pointshell.point(0).isZero(0.0) && !scene.has_features();
}

/// Of this build.
inline Part missing_part(const Scene& scene, format::Solver solver, bool friction) noexcept {
  return missing_part(kSceneTraits, solver, friction, scene.has_features(), is_ball(scene));
}

}  // namespace godobject
