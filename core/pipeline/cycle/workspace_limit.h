#pragma once

#include <algorithm>
#include <cmath>

#include "core/pipeline/cycle/device_force.h"
#include "core/scene/workspace_box.h"
#include "godobject/pose.h"

/// Enforcement of a scene's workspace (WorkspaceBox).
///
/// **The origin of B never leaves the box.** Proof by induction over the god object's poses. The first pose is the
/// device's; GodObject renders nothing until that is within the box. From then on the cycle follows the device pose
/// with its origin moved to the nearest point of the box (GodObject). Every pose that a cycle ends at is one of these:
/// the pose before; the followed pose; `clipped_to` of another pose; or, in `contact` and the cycle of the ball, a pose
/// whose origin was moved to `nearest` before the certificate checked it. The box is convex and a motion moves the
/// origin along a straight line, so the origin is inside between two such poses, too. Every point of the body is
/// therefore within R_max of the box at every look-up, also on the certificate's chords: the points within R_max of the
/// box are a convex set.
namespace godobject {

/// Returns the force of the box's faces on a device that is outside of the box [N]: along each axis the coupling's
/// spring, (46) and #7, and the damping b_D, which never turns the push into a pull. `back_W`: vector from D's origin
/// to the nearest point of the box [m]. `velocity_W`: of D's origin [m/s]. Real-time safe.
DeviceForce workspace_push(const Vector3& back_W, const Vector3& velocity_W, const Parameters& parameters) noexcept;

/// Returns the end of the motion from H0 to H1, shortened so that the origin stays in the box. The origin of H0 must be
/// in the box. Real-time safe.
inline Pose clipped_to(const WorkspaceBox& box, const Pose& H0, const Pose& H1) noexcept {
  if (!box.limited || box.contains(H1.translation)) return H1;
  const Vector3 displacement = H1.translation - H0.translation;
  const Vector3 room = box.nearest(H1.translation) - H0.translation;
  double share = 1.0;
  for (const int axis : {0, 1, 2}) {
    if (std::fabs(room[axis]) < share * std::fabs(displacement[axis])) share = room[axis] / displacement[axis];
  }
  Motion motion = get_motion(H0.inverse() * H1);
  motion.translation *= share;
  motion.rotation *= share;
  Pose end = H0 * set_matrix(motion);
  end.translation = box.nearest(end.translation);  // rounding
  return end;
}

/// Adds the faces of the box, without friction, to the constraints of a motion with friction that other constraints
/// push out of the box. False: it did not converge, and the end is still outside.
///
/// `end_of(push_W)` solves for the motion whose target is reduced by `push_W` [m] and returns the end of the origin, in
/// W [m]. By duality a push along a face's normal that brings the end onto the face is that face's force. Along an axis
/// the end moves by 0 to 1 times the push, and this ratio is constant while the same constraints are active. So the
/// secant method finds the push in two steps, unless contacts couple the axes. It stops within `tolerance` [m]; the
/// caller cuts off the remainder. Cost: at most 1 + kRounds calls of `end_of`.
template <class EndOf>
bool push_within(const WorkspaceBox& box, double tolerance, EndOf&& end_of) noexcept {
  constexpr int kRounds = 6;
  constexpr double kLeastYield = 0.02;
  Vector3 push = Vector3::Zero();
  // the distance beyond the face, and along a pushed axis also the distance that is missing to it
  const auto beyond = [&](const Vector3& end) noexcept {
    Vector3 out = end - box.nearest(end);
    for (const int axis : {0, 1, 2}) {
      if (push[axis] > 0.0) out[axis] = end[axis] - box.high[axis];
      if (push[axis] < 0.0) out[axis] = end[axis] - box.low[axis];
    }
    return out;
  };
  Vector3 out = beyond(end_of(push));
  Vector3 yield = Vector3::Ones();
  for (int round = 0; round < kRounds && out.cwiseAbs().maxCoeff() > tolerance; ++round) {
    const Vector3 before = out;
    const Vector3 last = push;
    push += out.cwiseQuotient(yield);
    for (const int axis : {0, 1, 2}) {
      if (push[axis] * last[axis] < 0.0) push[axis] = 0.0;  // a face does not pull
    }
    out = beyond(end_of(push));
    const Vector3 step = push - last;
    for (const int axis : {0, 1, 2}) {
      if (step[axis] == 0.0 || out[axis] == 0.0) continue;
      yield[axis] = std::clamp((before[axis] - out[axis]) / step[axis], kLeastYield, 1.0);
    }
  }
  return out.cwiseAbs().maxCoeff() <= tolerance;
}

/// Calls push(normal_S, gain) for each face of the box: the motion x of the origin, in S [m], must satisfy
/// normal_S . x >= gain. `H_WS`: the body, its origin in the box.
template <class Push>
void push_faces(const WorkspaceBox& box, const Pose& H_WS, const Push& push) noexcept {
  const Matrix3 R_SW = H_WS.rotation.toRotationMatrix().transpose();
  for (const int axis : {0, 1, 2}) {
    push(Vector3(R_SW.col(axis)), box.low[axis] - H_WS.translation[axis]);
    push(Vector3(-R_SW.col(axis)), H_WS.translation[axis] - box.high[axis]);
  }
}

}  // namespace godobject
