#include "core/device/dynamics.h"

namespace godobject {
namespace {

/// One rigid body or several that move as one: mass, centre of mass and the inertia about it, on the axes of R.
struct Composite {
  double mass{};
  Vector3 com_R = Vector3::Zero();
  Matrix3 inertia_R = Matrix3::Zero();
};

/// `H_RX`: pose of the body's own frame X.
Composite in_room(const LinkMass& body, const Pose& H_RX) noexcept {
  const Matrix3 R_RX = H_RX.rotation.toRotationMatrix();
  return {body.mass, H_RX * body.com, R_RX * body.inertia * R_RX.transpose()};
}

/// The sum of two bodies. Its inertia is about the common centre of mass, so an arm far from R's origin loses no
/// digits.
Composite join(const Composite& a, const Composite& b) noexcept {
  const double mass = a.mass + b.mass;
  if (!(mass > 0.0)) return {0.0, a.com_R, a.inertia_R + b.inertia_R};
  const Vector3 between = b.com_R - a.com_R;
  const double reduced_mass = a.mass * b.mass / mass;
  Composite sum;
  sum.mass = mass;
  sum.com_R = a.com_R + (b.mass / mass) * between;
  sum.inertia_R = a.inertia_R + b.inertia_R +
                  reduced_mass * (between.squaredNorm() * Matrix3::Identity() - between * between.transpose());
  return sum;
}

/// Momentum of bodies and its moment about the base's origin A, on the axes of R.
struct SpatialMomentum {
  Vector3 linear_R = Vector3::Zero();
  Vector3 angular_R = Vector3::Zero();

  /// Adds a body whose frame X moves with the tool twist: velocity of the point at A and angular velocity.
  void add(const LinkMass& body, const Pose& H_RX, const Vector3& p_RA, const Motion& at_A) noexcept {
    const Composite placed = in_room(body, H_RX);
    const Vector3 arm_R = placed.com_R - p_RA;
    const Vector3 momentum_R = placed.mass * (at_A.translation + at_A.rotation.cross(arm_R));
    linear_R += momentum_R;
    angular_R += placed.inertia_R * at_A.rotation + arm_R.cross(momentum_R);
  }
};

}  // namespace

JointVector gravity_torque(const ArmModel& model, const ArmKinematics& kinematics) noexcept {
  JointVector torque = JointVector::Zero();
  double mass = model.payload.mass;
  Vector3 moment_R = mass * (kinematics.H_RM * model.payload.com);  // sum of mass times position
  for (int i = model.joint_count - 1; i >= 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    const LinkMass& link = model.joints[k].link;
    mass += link.mass;
    moment_R += link.mass * (kinematics.H_RL[k] * link.com);
    const Vector3 arm_R = moment_R - mass * kinematics.H_RL[k].translation;
    torque[i] = -kinematics.axis_R[k].dot(arm_R.cross(model.gravity_R));
  }
  return torque;
}

JointMatrix mass_matrix(const ArmModel& model, const ArmKinematics& kinematics) noexcept {
  JointMatrix matrix = JointMatrix::Zero();
  Composite beyond = in_room(model.payload, kinematics.H_RM);
  for (int j = model.joint_count - 1; j >= 0; --j) {
    const auto k = static_cast<std::size_t>(j);
    beyond = join(in_room(model.joints[k].link, kinematics.H_RL[k]), beyond);
    // momentum of the bodies beyond joint j at unit speed of joint j alone; its moment about each joint i before it
    const Vector3& axis_R = kinematics.axis_R[k];
    const Vector3 momentum_R = beyond.mass * axis_R.cross(beyond.com_R - kinematics.H_RL[k].translation);
    const Vector3 spin_R = beyond.inertia_R * axis_R;
    for (int i = 0; i <= j; ++i) {
      const auto l = static_cast<std::size_t>(i);
      const Vector3 arm_R = beyond.com_R - kinematics.H_RL[l].translation;
      matrix(i, j) = kinematics.axis_R[l].dot(spin_R + arm_R.cross(momentum_R));
      matrix(j, i) = matrix(i, j);
    }
    matrix(j, j) += model.joints[k].rotor;
  }
  return matrix;
}

ArmMomentum arm_momentum(const ArmModel& model, const ArmKinematics& kinematics, const JointVector& qd) noexcept {
  const Vector3& p_RA = model.H_RA.translation;
  std::array<Vector3, kMaxJoints> moment_R;  // with the axis the unit twist of a joint at A
  std::array<Motion, kMaxJoints> twist_R;    // of each link, at A
  Motion sum;
  for (int i = 0; i < model.joint_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    moment_R[k] = (kinematics.H_RL[k].translation - p_RA).cross(kinematics.axis_R[k]);
    sum.translation += qd[i] * moment_R[k];
    sum.rotation += qd[i] * kinematics.axis_R[k];
    twist_R[k] = sum;
  }
  ArmMomentum result;
  SpatialMomentum beyond;
  beyond.add(model.payload, kinematics.H_RM, p_RA, sum);
  for (int i = model.joint_count - 1; i >= 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    const Vector3& axis_R = kinematics.axis_R[k];
    const Motion& twist = twist_R[k];
    beyond.add(model.joints[k].link, kinematics.H_RL[k], p_RA, twist);
    result.momentum[i] =
        axis_R.dot(beyond.angular_R) + moment_R[k].dot(beyond.linear_R) + model.joints[k].rotor * qd[i];
    result.change[i] = -beyond.angular_R.dot(axis_R.cross(twist.rotation)) -
                       beyond.linear_R.dot(axis_R.cross(twist.translation) + moment_R[k].cross(twist.rotation));
  }
  return result;
}

}  // namespace godobject
