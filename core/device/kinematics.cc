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
  Pose H_WL = model.H_WA;
  for (int i = 0; i < model.joint_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    H_WL = H_WL * link_pose(model.joints[k], q[i]);
    kinematics.H_WL[k] = H_WL;
    kinematics.axis_W[k] = H_WL.rotation._transformVector(Vector3::UnitZ());
  }
  kinematics.H_WM = H_WL * model.H_FM;
  return kinematics;
}

Jacobian geometric_jacobian(const ArmKinematics& kinematics, const Vector3& p_W) noexcept {
  Jacobian jacobian = Jacobian::Zero();
  for (int i = 0; i < kinematics.joint_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    jacobian.col(i).head<3>() = kinematics.axis_W[k].cross(p_W - kinematics.H_WL[k].translation);
    jacobian.col(i).tail<3>() = kinematics.axis_W[k];
  }
  return jacobian;
}

}  // namespace godobject
