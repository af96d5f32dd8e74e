#pragma once

#include "core/device/kinematics.h"

namespace godobject {

/// How a wrench becomes joint torques.
struct JointTorqueParameters {
  double rotation_length = 0.16;  ///< metres that a radian counts in singular values; best the virtual coupling's rho
  /// Singular values of the Jacobian, in metres a radian: at most `singular_none` nothing is rendered in that
  /// direction, from `singular_full` on all of it, between them a share that rises smoothly.
  double singular_none = 0.005;
  double singular_full = 0.02;
  JointVector null_damping = JointVector::Zero();     ///< of motions that leave the tool at rest [Nms/rad]
  double limit_band = 0.1;                            ///< springs begin this far before a position limit [rad]
  JointVector limit_stiffness = JointVector::Zero();  ///< [Nm/rad]
  JointVector limit_damping = JointVector::Zero();    ///< of motion towards the limit, in full at the limit [Nms/rad]
};

/// `kNotFinite`; `kArmControl`: a negative number, a length, band or singular value that is not positive,
/// `singular_none` not below `singular_full`, or a band wider than half the range of a joint.
Status validate(const JointTorqueParameters& parameters, const ArmModel& model) noexcept;

struct TorqueRequest {
  JointVector q = JointVector::Zero();   ///< [rad]
  JointVector qd = JointVector::Zero();  ///< [rad/s]
  ArmKinematics kinematics;              ///< of q
  Wrench F_W;                            ///< on the tool, in W about p_W [N, Nm]
  Vector3 p_W = Vector3::Zero();         ///< [m]
};

struct JointTorque {
  JointVector torque = JointVector::Zero();   ///< what the drives are to give [Nm]
  JointVector gravity = JointVector::Zero();  ///< the part that holds the arm [Nm]
  Wrench rendered_W;                          ///< what `torque` shows of F_W, in W about p_W [N, Nm]
  double scale = 0.0;     ///< by how much everything rendered was made smaller to stay within the torque limits [0, 1]
  double left_out = 0.0;  ///< share of F_W, by its weighted length, that is in singular directions [0, 1]
  bool gravity_clipped = false;  ///< a joint cannot hold the arm
};

/// tau = gravity + limit springs + null-space damping + scale J^T F', each joint within its torque limit.
///
/// F' is F without what cannot be rendered. With L = `rotation_length` and W = diag(1, 1, 1, L, L, L) let
/// W J = U S V^T: F' = W U f(S) U^T W^-1 F with f rising from 0 to 1 between the two singular values. J^T F' is then
/// V S f(S) U^T W^-1 F: never longer than J^T F, and continuous in q through a singularity, because it is a smooth
/// function of the symmetric matrix W J J^T W. Where f is not 0 or 1 it moves with q, so that a spring at the tool is
/// not exactly conservative there.
///
/// The damping torque is -P D P qd, D = diag(`null_damping`), P = 1 - V f(S) V^T: for regular postures the orthogonal
/// projector on the null space of J, J tau = 0. Its power -(P qd)^T D (P qd) is never positive and does not depend on
/// the tool's motion, whatever the mass model is worth. A dynamically consistent projection would also leave the tool's
/// acceleration alone, but needs the true M(q). In singular directions it damps what is no longer rendered.
///
/// Limits: gravity comes first; then the springs take at most 0.9 of what it leaves at each joint, then the damping at
/// most 0.9 of what is left with one factor for all joints, then the wrench the rest with one factor for all joints, so
/// that it keeps its direction. Springs push only away from the limit. What is rendered towards a limit fades out in
/// the band: at a share t of its way to at most 1 - t of what a wrench of this size could give at the joint, or to 0.9
/// of the spring if that is more. So no wrench presses the arm through its springs.
///
/// `kNotFinite`: something that came in or would have left is not finite, or the singular values were not found.
/// Then `torque` is gravity within the limits, or zero if that is not finite either, and the caller stops.
/// Cost: 5 us for seven joints (one eigenvalue problem of size six). Real-time safe.
Status joint_torque(const ArmModel& model, const JointTorqueParameters& parameters, const TorqueRequest& request,
                    JointTorque& result) noexcept;

}  // namespace godobject
