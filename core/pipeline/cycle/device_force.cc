#include "core/pipeline/cycle/device_force.h"

#include <algorithm>

namespace godobject {
namespace {

/// Returns spring and damping along the spring's direction, never reversed.
Vector3 damped(const Vector3& spring, const Vector3& velocity, double damping) noexcept {
  constexpr double kNoForce = 1e-12;  // [N, Nm] derived: rounding of stretches of a metre at 2000 N/m, 4e-13
  const double magnitude = spring.norm();
  if (magnitude < kNoForce) return Vector3::Zero();
  const Vector3 direction = spring / magnitude;
  return std::max(0.0, magnitude - damping * velocity.dot(direction)) * direction;
}

}  // namespace

DeviceForce device_force(const Wrench& coupling_D, const Pose& H_WD, const Motion& velocity_W,
                         const Parameters& parameters) noexcept {
  DeviceForce out;
  out.spring_W.force = parameters.stiffness * H_WD.rotation._transformVector(coupling_D.force);
  out.spring_W.torque = parameters.stiffness * H_WD.rotation._transformVector(coupling_D.torque);
  out.total_W.force =
      damped(out.spring_W.force, velocity_W.translation, parameters.damping * parameters.coupling_translation);
  out.total_W.torque =
      damped(out.spring_W.torque, velocity_W.rotation, parameters.damping * parameters.coupling_rotation);
  return out;
}

}  // namespace godobject
