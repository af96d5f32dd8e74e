#pragma once

#include <vector>

#include "toolchain/path/keyframes.h"

namespace godobject::path {

/// 0 at u <= 0, 1 at u >= 1, in between 10 u^3 - 15 u^4 + 6 u^5: the motion from rest to rest with the least jerk, as a
/// person's hand makes it. Velocity and acceleration are 0 at both ends.
double minimum_jerk(double u);

/// The moving mesh's frame in W at time t: between two keyframes the pivot goes straight and the rotation along the
/// shorter arc (slerp), both by `minimum_jerk`; then the oscillations, faded by it. Twice continuously differentiable
/// in t. Before the first and after the last keyframe it rests there.
Pose pose_at(const Keyframes& motion, double t);

/// One pose a millisecond, from the first keyframe to the last.
struct Sample {
  double t;  ///< [s]
  Pose pose;
};
std::vector<Sample> sample(const Keyframes& motion);

}  // namespace godobject::path
