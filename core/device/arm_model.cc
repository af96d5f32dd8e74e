#include "core/device/arm_model.h"

#include <cmath>

#include "core/device/symmetric_eigen.h"

namespace godobject {
namespace {

bool is_finite(const LinkMass& body) noexcept {
  return std::isfinite(body.mass) && body.com.allFinite() && body.inertia.allFinite();
}

bool is_finite(const ArmJoint& joint) noexcept {
  for (const double number : {joint.a, joint.alpha, joint.d, joint.offset, joint.lower, joint.upper, joint.velocity,
                              joint.torque, joint.rotor, joint.damping}) {
    if (!std::isfinite(number)) return false;
  }
  return is_finite(joint.link);
}

bool is_unit(const Quaternion& rotation) noexcept { return std::fabs(rotation.norm() - 1.0) < 1e-6; }

/// The second moments of the mass, trace(I)/2 - I, are positive semidefinite. This implies both conditions on I.
bool is_inertia(const Matrix3& inertia) noexcept {
  const double tolerance = 1e-6 * inertia.cwiseAbs().maxCoeff();
  if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() > tolerance) return false;
  const Matrix3 symmetric = 0.5 * (inertia + inertia.transpose());
  SymmetricEigen<3> moments;
  return symmetric_eigen<3>(symmetric, moments) &&
         moments.values.maxCoeff() <= 0.5 * moments.values.sum() + tolerance;
}

}  // namespace

Status validate(const ArmModel& model) noexcept {
  if (model.joint_count < 1 || model.joint_count > kMaxJoints) return Status::kArmShape;
  if (!model.H_RA.is_finite() || !model.H_FM.is_finite() || !model.gravity_R.allFinite() || !is_finite(model.payload)) {
    return Status::kNotFinite;
  }
  if (!is_unit(model.H_RA.rotation) || !is_unit(model.H_FM.rotation)) return Status::kArmShape;
  if (model.payload.mass < 0.0 || !is_inertia(model.payload.inertia)) return Status::kArmMass;
  for (int i = 0; i < model.joint_count; ++i) {
    const ArmJoint& joint = model.joints[static_cast<std::size_t>(i)];
    if (!is_finite(joint)) return Status::kNotFinite;
    if (!(joint.link.mass > 0.0) || joint.rotor < 0.0 || joint.damping < 0.0) return Status::kArmMass;
    if (!is_inertia(joint.link.inertia)) return Status::kArmMass;
    if (!(joint.lower < joint.upper) || !(joint.velocity > 0.0) || !(joint.torque > 0.0)) return Status::kArmLimits;
  }
  return Status::kOk;
}

}  // namespace godobject
