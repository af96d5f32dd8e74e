#include "core/device/kinematics.h"

#include <cmath>

namespace godobject {
namespace {

/// Rot_x(alpha) Trans_x(a) Rot_z(theta) Trans_z(d)
Pose link_pose(const ArmJoint& joint, double q) noexcept {
  const double half_theta = 0.5 * (joint.offset + q);
  const double ca = std::cos(0.5 * joint.alpha);
  const double sa = std::sin(0.5 * joint.alpha);
  const double ct = std::cos(half_theta);
  const double st = std::sin(half_theta);
  Pose pose;
  pose.rotation = Quaternion(ca * ct, sa * ct, -sa * st, ca * st);
  pose.translation = Vector3(joint.a, -2.0 * sa * ca * joint.d, (ca * ca - sa * sa) * joint.d);
  return pose;
}

}  // namespace

ArmKinematics forward_kinematics(const ArmModel& model, const JointVector& q) noexcept {
  ArmKinematics kinematics;
  kinematics.joint_count = model.joint_count;
  Pose H_RL = model.H_RA;
  for (int i = 0; i < model.joint_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    H_RL = H_RL * link_pose(model.joints[k], q[i]);
    kinematics.H_RL[k] = H_RL;
    kinematics.axis_R[k] = H_RL.rotation._transformVector(Vector3::UnitZ());
  }
  kinematics.H_RM = H_RL * model.H_FM;
  return kinematics;
}

Jacobian geometric_jacobian(const ArmKinematics& kinematics, const Vector3& p_RP) noexcept {
  Jacobian jacobian = Jacobian::Zero();
  for (int i = 0; i < kinematics.joint_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    jacobian.col(i).head<3>() = kinematics.axis_R[k].cross(p_RP - kinematics.H_RL[k].translation);
    jacobian.col(i).tail<3>() = kinematics.axis_R[k];
  }
  return jacobian;
}

}  // namespace godobject
