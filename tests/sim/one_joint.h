#pragma once

#include "core/device/arm_model.h"

namespace godobject::test {

inline constexpr std::int64_t kPeriod_ns = 1'000'000;

/// A rotor about a vertical axis, which gravity does not move; the tool stands at a lever of 1 m.
inline ArmModel one_joint(double inertia, double damping) {
  ArmModel model;
  model.joint_count = 1;
  ArmJoint& joint = model.joints[0];
  joint.link = {1e-9, Vector3::Zero(), Matrix3::Zero()};
  joint.rotor = inertia;
  joint.damping = damping;
  joint.lower = -10.0;
  joint.upper = 10.0;
  joint.velocity = 10.0;
  joint.torque = 100.0;
  model.H_FM.translation = Vector3::UnitX();
  return model;
}

}  // namespace godobject::test
