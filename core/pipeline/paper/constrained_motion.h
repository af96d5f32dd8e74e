#pragma once

#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/paper/correction.h"
#include "godobject/pose.h"

namespace godobject {

/// A motion split along a constrained direction u, eq (34) and (35); u is a unit vector or zero.
struct SplitMotion {
  Vector3 parallel = Vector3::Zero();  ///< along u
  Vector3 perpendicular = Vector3::Zero();
};

inline SplitMotion split(const Vector3& motion, const Vector3& u) noexcept {
  const Vector3 parallel = motion.dot(u) * u;
  return {parallel, motion - parallel};
}

/// Step #4 of `paper` for translations or rotations alone, equations (36)-(40), (47): the motion left of
/// `unconstrained` [m or rad] when u is the constrained direction and `delta` [m or rad] the step that would reach
/// contact, eq (7). Region A: `penetration` >= 0, region B otherwise. (38) treats translation and rotation apart, as
/// printed.
Vector3 constrained_motion(const Vector3& unconstrained, const Vector3& u, double delta, double penetration) noexcept;

/// Algorithm 1: what friction takes off a motion, x_fr of eq (48); add it to the constrained motion.
/// `restricted` is x_r,|| of eq (40), `perpendicular` x_u,perp of eq (35); the ratios are mu_s, mu_k, mu_v [1].
/// Without a slip state, as printed: it saw-tooths between mu_k and mu_s.
Vector3 paper_friction(const Vector3& restricted, const Vector3& perpendicular, double mu_static, double mu_kinetic,
                       double mu_viscous) noexcept;

}  // namespace godobject
