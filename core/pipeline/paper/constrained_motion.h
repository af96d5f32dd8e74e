#pragma once

#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/paper/correction.h"
#include "godobject/pose.h"

namespace godobject {

/// A translation [m] or rotation [rad] split along a constrained direction u, eq (34) and (35).
struct SplitMotion {
  Vector3 parallel = Vector3::Zero();       ///< along u
  Vector3 perpendicular = Vector3::Zero();  ///< across u
};

/// Returns the parts of `motion` along and across u, a unit vector or zero.
inline SplitMotion split(const Vector3& motion, const Vector3& u) noexcept {
  const Vector3 parallel = motion.dot(u) * u;
  return {parallel, motion - parallel};
}

/// Returns the constrained part of the motion `unconstrained` [m or rad]. Step #4 of `paper` for translations or
/// rotations alone, equations (36)-(40), (47). u: the constrained direction; `delta`: the step that would reach
/// contact, eq (7) [m or rad]; `penetration`: p of eq (6) [m], region A if >= 0, region B otherwise. (38) treats
/// translation and rotation separately, as printed. A motion that is not restricted is returned to the last bit.
Vector3 constrained_motion(const Vector3& unconstrained, const Vector3& u, double delta, double penetration) noexcept;

/// Returns the motion x_fr of eq (48) by Algorithm 1: add it to the constrained motion. `restricted` is x_r,|| of eq
/// (40) and `perpendicular` x_u,perp of eq (35) [m or rad]; the ratios are mu_s, mu_k, mu_v [1]. There is no slip
/// state, as printed: the force saw-tooths between mu_k and mu_s.
Vector3 paper_friction(const Vector3& restricted, const Vector3& perpendicular, double mu_static, double mu_kinetic,
                       double mu_viscous) noexcept;

}  // namespace godobject
