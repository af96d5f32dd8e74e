#pragma once

#include <array>

#include "core/device/arm_model.h"

namespace godobject {

/// Rows: translation, then rotation, as in `Motion` and `Wrench`; columns from the joint count on are zero.
using Jacobian = Eigen::Matrix<double, 6, kMaxJoints>;

/// Where an arm's parts are.
struct ArmKinematics {
  int joint_count = 0;
  std::array<Pose, kMaxJoints> H_WL;       ///< of the links
  std::array<Vector3, kMaxJoints> axis_W;  ///< of the joints: the z axes of the links
  Pose H_WM;                               ///< of the tool
};

/// Forward kinematics of the joint positions q [rad].
/// A position that is not finite gives poses that are not. Cost: below 1 us for seven joints. Real-time safe.
ArmKinematics forward_kinematics(const ArmModel& model, const JointVector& q) noexcept;

/// Geometric Jacobian in W of the point p_W [m] that moves with the tool: column i is (axis_i x (p - origin_i),
/// axis_i). A wrench about p_W gives the joint torques J^T F. Cost: 100 ns. Real-time safe.
Jacobian geometric_jacobian(const ArmKinematics& kinematics, const Vector3& p_W) noexcept;

/// What the joint velocities qd [rad/s] do at the Jacobian's point: its velocity [m/s] and the tool's angular velocity
/// [rad/s], in W.
inline Motion tool_velocity(const Jacobian& jacobian, const JointVector& qd) noexcept {
  return {jacobian.topRows<3>() * qd, jacobian.bottomRows<3>() * qd};
}

}  // namespace godobject
