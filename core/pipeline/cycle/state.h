#pragma once

#include "core/pipeline/contact/qp/least_constraint.h"
#include "core/pipeline/corrected/projection.h"
#include "godobject/pose.h"

namespace godobject {

/// What the operator's side gives to one cycle: the body's pose on the device and its velocity, in W.
struct CycleInput {
  Pose H_WD;          ///< frame B of the moving body as the device holds it, its origin in the workspace
  Motion velocity_W;  ///< of D's origin [m/s] and angular [rad/s]; damping only
};

/// Carried from cycle to cycle; written once, at the end of a cycle that went well.
struct State {
  Pose H_WS;                   ///< the god object
  bool started = false;        ///< a cycle has been finished
  bool inside = false;         ///< it started in penetration and has not come out
  ProjectionState projection;  ///< of `corrected`
  ConstrainedStep contact;     ///< of `contact`: its last motion and what held it
  Pose H_WD;                   ///< of `contact`: the device
};

/// Of one cycle of `corrected` or `contact`.
inline constexpr std::uint32_t kMaxSubsteps = 8;

}  // namespace godobject
