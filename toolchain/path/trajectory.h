#pragma once

#include <vector>

#include "toolchain/path/keyframes.h"

namespace godobject::path {

/// Returns 0 at u <= 0, 1 at u >= 1, and 10 u^3 - 15 u^4 + 6 u^5 in between: the motion from rest to rest with the
/// least jerk, a model of human reaching (Flash and Hogan 1985). Velocity and acceleration are 0 at both ends.
double minimum_jerk(double u);

/// Returns the moving mesh's frame in W at time t. Between two keyframes the pivot moves straight and the rotation
/// along the shorter arc (slerp), both by `minimum_jerk`. Oscillations are added, faded by `minimum_jerk`. The pose is
/// twice continuously differentiable in t, and rests before the first and after the last keyframe.
Pose pose_at(const Keyframes& motion, double t);

/// One pose of a sampled motion. `sample` gives one for each period of the motion, from the first keyframe to the last.
struct Sample {
  double t;  ///< [s]
  Pose pose;
};
std::vector<Sample> sample(const Keyframes& motion);

}  // namespace godobject::path
