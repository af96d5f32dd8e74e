#pragma once

#include "core/device/kinematics.h"

namespace godobject {

/// Settings of `joint_torque`.
struct JointTorqueParameters {
  double rotation_length = 0.16;  ///< L: metres that a radian counts in singular values; best the coupling's rho
  /// Singular values of the Jacobian [m/rad]: in directions up to `singular_none` nothing is rendered, from
  /// `singular_full` on everything, between them a share that rises smoothly.
  double singular_none = 0.005;
  double singular_full = 0.02;
  JointVector null_damping = JointVector::Zero();     ///< damping of motions that leave the tool at rest [Nms/rad]
  double limit_band = 0.1;                            ///< distance before a position limit at which springs begin [rad]
  JointVector limit_stiffness = JointVector::Zero();  ///< stiffness of these springs [Nm/rad]
  JointVector limit_damping = JointVector::Zero();    ///< damping towards the limit, in full at the limit [Nms/rad]
};

/// `kNotFinite`; `kArmControl`: a negative number, a length, band or singular value that is not positive,
/// `singular_none` not below `singular_full`, or a band wider than half the range of a joint.
Status validate(const JointTorqueParameters& parameters, const ArmModel& model) noexcept;

/// A wrench to render at a point P of the tool.
struct TorqueRequest {
  JointVector q = JointVector::Zero();   ///< joint positions [rad]
  JointVector qd = JointVector::Zero();  ///< joint velocities [rad/s]
  ArmKinematics kinematics;              ///< of q
  Wrench F_P_R;                          ///< wrench on the tool about P, on the axes of R [N, Nm]
  Vector3 p_RP = Vector3::Zero();        ///< position of P [m]
};

struct JointTorque {
  JointVector torque = JointVector::Zero();   ///< torques for the drives [Nm]
  JointVector gravity = JointVector::Zero();  ///< the part of them that holds the arm [Nm]
  Wrench rendered_P_R;     ///< the part of F_P_R that `torque` renders, about P, on the axes of R [N, Nm]
  double scale = 0.0;      ///< factor by which the wrench was reduced to stay within the torque limits [0, 1]
  double left_out = 0.0;   ///< share of F_P_R, by its weighted length, in singular directions [0, 1]
  bool gravity_clipped{};  ///< a joint cannot hold the arm
};

/// tau = gravity + limit springs + null-space damping + scale J^T F', each joint within its torque limit.
///
/// F' is F without the directions that cannot be rendered. With L = `rotation_length` and Z = diag(1, 1, 1, L, L, L)
/// let Z J = U S V^T. Then F' = Z U f(S) U^T Z^-1 F, with f rising from 0 to 1 between the two singular values.
/// J^T F' = V S f(S) U^T Z^-1 F is never longer than J^T F. It is continuous in q through a singularity, because it is
/// a smooth function of the symmetric matrix Z J J^T Z. Where f is neither 0 nor 1 it changes with q, so a spring at
/// the tool is not exactly conservative there.
///
/// The damping torque is -P D P qd, D = diag(`null_damping`), P = 1 - V f(S) V^T. In regular postures P is the
/// orthogonal projector on the null space of J, so J tau = 0. The power -(P qd)^T D (P qd) is never positive and does
/// not depend on the tool's motion, even if the mass model is wrong. A dynamically consistent projection would also
/// leave the tool's acceleration alone, but needs the true M(q). In singular directions the damping acts on the motion
/// that is no longer rendered.
///
/// Limits: gravity comes first. Then the springs take at most 0.9 of the remaining torque of each joint. Then the
/// damping takes at most 0.9 of the remainder, with one factor for all joints. The wrench takes the rest, with one
/// factor for all joints, so its direction stays. Springs push only away from the limit. Rendered torque towards a
/// limit fades out in the band: at a share t of the way to the limit it is at most 1 - t of the torque that a wrench of
/// this size could give at the joint, or 0.9 of the spring if that is more. So no wrench presses the arm through its
/// springs.
///
/// `kNotFinite`: an input or a result is not finite, or the singular values were not found. Then `torque` is gravity
/// within the limits, and the caller stops. If gravity is not finite either, `torque` is zero and `gravity` tells it,
/// so that the caller can hold the arm with an earlier torque. Cost: 5 us for seven joints (one eigenvalue problem of
/// size six). Real-time safe.
Status joint_torque(const ArmModel& model, const JointTorqueParameters& parameters, const TorqueRequest& request,
                    JointTorque& result) noexcept;

}  // namespace godobject
