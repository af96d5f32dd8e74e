#pragma once

#include <algorithm>
#include <cmath>

#include "core/pipeline/cycle/device_force.h"
#include "core/pipeline/cycle/state.h"
#include "core/scene/workspace_box.h"
#include "godobject/pose.h"

/// Enforcement of a scene's workspace (WorkspaceBox).
///
/// **The origin of B never leaves the box.** Proof by induction over the god object's poses. The first pose is the
/// device's; GodObject renders nothing until that is within the box. From then on the cycle follows the device pose
/// with its origin moved to the nearest point of the box (GodObject). While contacts act, `contact` aims at the device
/// pose itself, with the faces as constraints; else spring and push would not be those of one energy, and a hand could
/// gain work on a closed path. Every pose that a cycle ends at is one of these:
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

/// Longest way beyond the box at whose end the god object aims, in radii of the moving body or voxels, whichever are
/// larger. Chosen: farther than any arm reaches beyond its workspace; much longer ways would cost precision, and with
/// friction time.
inline constexpr double kFarthestAim = 1e4;

/// Returns the input of a cycle for the device pose `H_WD` and the velocity of its origin. Outside of the workspace the
/// pose is moved into it, with the way out, shortened to kFarthestAim, and the push of its faces. Real-time safe.
CycleInput input_within(const Pose& H_WD, const Motion& velocity_W, const Parameters& parameters) noexcept;

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
