#pragma once

#include <algorithm>
#include <cmath>

#include "core/pipeline/cycle/device_force.h"
#include "core/scene/workspace_box.h"
#include "godobject/pose.h"

/// How a scene's workspace (WorkspaceBox) is kept.
///
/// **The origin of B never leaves the box.** By induction over the god object's poses: the first is the device's, which
/// is not taken before it is within the box. From there on the pose that the cycle follows is the device's with its
/// origin moved to the nearest point of the box (GodObject), and every pose that a cycle goes to is one of: the pose
/// before; the one that it follows; `kept_within` of another; or, in `contact` and the cycle of the ball, another whose
/// origin was moved to `nearest`, and which the certificate has seen as such. The box is convex and a motion takes the
/// origin straight, so it stays inside between two such poses, too. What moves with the body is therefore within R_max
/// of the box at every look-up, the certificate's chords included: the points within R_max of the box are a convex set.
namespace godobject {

/// Faces of the box at the device, which is outside of it by `back_W`, the way to the nearest point of the box: along
/// each axis the coupling's spring, (46) and #7, and the damping b_D, which never turns the push into a pull.
/// `velocity_W`: of D's origin [m/s].
DeviceForce workspace_push(const Vector3& back_W, const Vector3& velocity_W, const Parameters& parameters) noexcept;

/// As much of the motion from H0, whose origin is in the box, to H1 as leaves it there.
inline Pose kept_within(const WorkspaceBox& box, const Pose& H0, const Pose& H1) noexcept {
  if (!box.limited || box.contains(H1.translation)) return H1;
  const Vector3 way = H1.translation - H0.translation;
  const Vector3 room = box.nearest(H1.translation) - H0.translation;
  double share = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::fabs(room[axis]) < share * std::fabs(way[axis])) share = room[axis] / way[axis];
  }
  Motion motion = get_motion(H0.inverse() * H1);
  motion.translation *= share;
  motion.rotation *= share;
  Pose kept = H0 * set_matrix(motion);
  kept.translation = box.nearest(kept.translation);  // rounding
  return kept;
}

/// The faces of the box as constraints of a motion that other constraints have pushed out of it, without friction:
/// `end_of(push_W)` is where the origin ends if it does not want to go where it did but `push_W` less far. By
/// duality a push along a face's normal that brings the end onto the face is that face's force. The end yields to
/// the push along an axis by a share of 0 to 1 that stays the same while the same constraints hold: so the secant finds
/// it in two steps. What is left over after a few is for the caller to cut off.
template <class EndOf>
void push_within(const WorkspaceBox& box, double tolerance, EndOf&& end_of) noexcept {
  constexpr int kRounds = 6;
  constexpr double kLeastYield = 0.02;
  Vector3 push = Vector3::Zero();
  Vector3 end = end_of(push);
  Vector3 out = end - box.nearest(end);
  Vector3 yield = Vector3::Ones();
  for (int round = 0; round < kRounds && out.cwiseAbs().maxCoeff() > tolerance; ++round) {
    const Vector3 before = out;
    const Vector3 step = out.cwiseQuotient(yield);
    push += step;
    end = end_of(push);
    out = end - box.nearest(end);
    for (int axis = 0; axis < 3; ++axis) {
      if (step[axis] == 0.0 || out[axis] == 0.0) continue;
      yield[axis] = std::max(kLeastYield, (before[axis] - out[axis]) / step[axis]);
    }
  }
}

}  // namespace godobject
