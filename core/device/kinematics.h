#pragma once

#include <array>

#include "core/device/arm_model.h"

namespace godobject {

/// Rows: translation, then rotation, as in `Motion` and `Wrench`. Columns from the joint count on are zero.
using Jacobian = Eigen::Matrix<double, 6, kMaxJoints>;

/// Poses of an arm's parts in the room R.
struct ArmKinematics {
  int joint_count = 0;
  std::array<Pose, kMaxJoints> H_RL;       ///< poses of the links L_i
  std::array<Vector3, kMaxJoints> axis_R;  ///< unit axes of the joints: the z axes of the links
  Pose H_RM;                               ///< pose of the tool
};

/// Forward kinematics: the poses of links and tool at the joint positions q [rad].
/// A position that is not finite gives poses that are not finite. Cost: below 1 us for seven joints. Real-time safe.
ArmKinematics forward_kinematics(const ArmModel& model, const JointVector& q) noexcept;

/// Geometric Jacobian, on the axes of R, of the point P that moves with the tool and is at p_RP [m]: column i is
/// (axis_i x (p_RP - origin_i), axis_i). A wrench F_P_R (about P) has the joint torques J^T F_P_R.
/// Cost: 100 ns. Real-time safe.
Jacobian geometric_jacobian(const ArmKinematics& kinematics, const Vector3& p_RP) noexcept;

/// Velocity [m/s] of the Jacobian's point and angular velocity [rad/s] of the tool, on the axes of R, at the joint
/// velocities qd [rad/s].
inline Motion tool_velocity(const Jacobian& jacobian, const JointVector& qd) noexcept {
  return {jacobian.topRows<3>() * qd, jacobian.bottomRows<3>() * qd};
}

}  // namespace godobject
