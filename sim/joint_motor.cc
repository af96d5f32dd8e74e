#include "sim/joint_motor.h"

#include <algorithm>
#include <cmath>

#include "sim/arm_dynamics.h"

namespace godobject::sim {

std::array<JointHardwareParameters, kMaxJoints> usual_hardware(const ArmModel& model) noexcept {
  constexpr double kBandwidth = 100.0;  // of the velocity loops, chosen [rad/s]
  const ArmDynamics arm(model);
  ArmPosture posture;
  JointVector q = JointVector::Zero();
  for (int i = 0; i < model.joint_count; ++i) q[i] = 0.5 * model.joints[static_cast<std::size_t>(i)].upper;
  arm.set_posture(q, posture);
  std::array<JointHardwareParameters, kMaxJoints> hardware;
  for (int i = 0; i < model.joint_count; ++i) {
    JointHardwareParameters& joint = hardware[static_cast<std::size_t>(i)];
    joint.encoder_step = 2.0 * M_PI / (1 << 20);
    joint.torque_limit = model.joints[static_cast<std::size_t>(i)].torque;
    joint.torque_step = 1e-3 * joint.torque_limit;
    joint.brake_torque = joint.torque_limit;
    joint.stop_speed_margin = 0.25 * model.joints[static_cast<std::size_t>(i)].velocity;
    joint.quick_stop_damping = kBandwidth * posture.mass(i, i);
    joint.quick_stop_stiffness = 0.25 * kBandwidth * joint.quick_stop_damping;  // critically damped
  }
  return hardware;
}

void JointMotor::update(std::int64_t now_ns) noexcept {
  const std::int64_t takes_ns = brake_open_ ? parameters_.brake_open_ns : parameters_.brake_close_ns;
  if (now_ns - brake_since_ns_ >= takes_ns) brake_holds_ = !brake_open_;
}

void JointMotor::set_brake(bool open, std::int64_t now_ns) noexcept {
  if (open == brake_open_) return;
  brake_open_ = open;
  brake_since_ns_ = now_ns;
}

void JointMotor::cut(std::int64_t now_ns) noexcept {
  torque_ = 0.0;
  set_brake(false, now_ns);
}

void JointMotor::begin_stop(std::int64_t now_ns, double position, double velocity) noexcept {
  stop_since_ns_ = now_ns;
  stop_position_ = position;
  stop_speed_ = std::fabs(velocity);
  stop_torque_ = torque_;
}

Stopping JointMotor::stop(std::int64_t now_ns, double position, double velocity) noexcept {
  const JointHardwareParameters& p = parameters_;
  if (std::fabs(velocity) > stop_speed_ + p.stop_speed_margin) return Stopping::kRunsAway;
  set_torque(stop_torque_ - p.quick_stop_damping * velocity - p.quick_stop_stiffness * (position - stop_position_));
  if (std::fabs(velocity) < p.rest_velocity || now_ns - stop_since_ns_ >= p.quick_stop_ns) set_brake(false, now_ns);
  return brake_holds_ ? Stopping::kHeld : Stopping::kSlowing;
}

double JointMotor::rounded(double torque) const noexcept {
  if (std::isnan(torque)) return 0.0;
  const double limit = parameters_.torque_limit;
  const double step = parameters_.torque_step;
  const double within = std::clamp(torque, -limit, limit);
  return step > 0.0 ? step * std::round(within / step) : within;
}

std::int32_t JointMotor::counter(double position) const noexcept {
  const auto counts = static_cast<std::int64_t>(std::floor(position / parameters_.encoder_step));
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(counts + parameters_.counter_at_zero));
}

}  // namespace godobject::sim
