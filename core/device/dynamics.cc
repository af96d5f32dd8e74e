#include "core/device/dynamics.h"

namespace godobject {
namespace {

/// A rigid body, or several that move as one: centre of mass and inertia about it, on the axes of W.
struct Composite {
  double mass = 0.0;
  Vector3 com_W = Vector3::Zero();
  Matrix3 inertia_W = Matrix3::Zero();
};

Composite in_world(const LinkMass& body, const Pose& H_WB) noexcept {
  const Matrix3 R_WB = H_WB.rotation.toRotationMatrix();
  return {body.mass, H_WB * body.com, R_WB * body.inertia * R_WB.transpose()};
}

/// The inertia stays about the common centre of mass: no digits are lost to an arm that stands far from W's origin.
Composite join(const Composite& a, const Composite& b) noexcept {
  const double mass = a.mass + b.mass;
  if (!(mass > 0.0)) return {0.0, a.com_W, a.inertia_W + b.inertia_W};
  const Vector3 between = b.com_W - a.com_W;
  const double reduced_mass = a.mass * b.mass / mass;
  Composite sum;
  sum.mass = mass;
  sum.com_W = a.com_W + (b.mass / mass) * between;
  sum.inertia_W = a.inertia_W + b.inertia_W +
                  reduced_mass * (between.squaredNorm() * Matrix3::Identity() - between * between.transpose());
  return sum;
}

}  // namespace

JointVector gravity_torque(const ArmModel& model, const ArmKinematics& kinematics) noexcept {
  JointVector torque = JointVector::Zero();
  double mass = model.payload.mass;
  Vector3 moment_W = mass * (kinematics.H_WM * model.payload.com);  // sum of mass times position
  for (int i = model.joint_count - 1; i >= 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    const LinkMass& link = model.joints[k].link;
    mass += link.mass;
    moment_W += link.mass * (kinematics.H_WL[k] * link.com);
    const Vector3 arm_W = moment_W - mass * kinematics.H_WL[k].translation;
    torque[i] = -kinematics.axis_W[k].dot(arm_W.cross(model.gravity_W));
  }
  return torque;
}

JointMatrix mass_matrix(const ArmModel& model, const ArmKinematics& kinematics) noexcept {
  JointMatrix matrix = JointMatrix::Zero();
  Composite beyond = in_world(model.payload, kinematics.H_WM);
  for (int j = model.joint_count - 1; j >= 0; --j) {
    const auto k = static_cast<std::size_t>(j);
    beyond = join(in_world(model.joints[k].link, kinematics.H_WL[k]), beyond);
    // momentum of all beyond joint j at unit speed of it alone, and what of it each joint before feels
    const Vector3& axis_W = kinematics.axis_W[k];
    const Vector3 momentum_W = beyond.mass * axis_W.cross(beyond.com_W - kinematics.H_WL[k].translation);
    const Vector3 spin_W = beyond.inertia_W * axis_W;
    for (int i = 0; i <= j; ++i) {
      const auto l = static_cast<std::size_t>(i);
      const Vector3 arm_W = beyond.com_W - kinematics.H_WL[l].translation;
      matrix(i, j) = kinematics.axis_W[l].dot(spin_W + arm_W.cross(momentum_W));
      matrix(j, i) = matrix(i, j);
    }
    matrix(j, j) += model.joints[k].rotor;
  }
  return matrix;
}

}  // namespace godobject
