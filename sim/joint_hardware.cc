#include "sim/joint_hardware.h"

#include <algorithm>
#include <cmath>

#include "sim/arm_dynamics.h"

namespace godobject::sim {

std::array<JointHardwareParameters, kMaxJoints> usual_hardware(const ArmModel& model) noexcept {
  constexpr double kBandwidth = 100.0;  // [rad/s]
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

void JointHardware::set_brake(bool open, std::int64_t now_ns) noexcept {
  if (open == brake_open_) return;
  brake_open_ = open;
  brake_since_ns_ = now_ns;
}

void JointHardware::go_off(Mode mode, std::int64_t now_ns) noexcept {
  mode_ = mode;
  mode_since_ns_ = now_ns;
  torque_ = 0.0;
  set_brake(false, now_ns);
}

void JointHardware::command(hal::PowerRequest power, double torque, std::int64_t now_ns) noexcept {
  if (mode_ == Mode::kNoSupply) return;
  command_ns_ = now_ns;
  commanded_ = rounded(torque);
  switch (power) {
    case hal::PowerRequest::kOff:
      if (mode_ != Mode::kFault && mode_ != Mode::kOff) go_off(Mode::kOff, now_ns);
      return;
    case hal::PowerRequest::kEnable:
      if (mode_ == Mode::kOff) {
        mode_ = Mode::kPowerStage;
        mode_since_ns_ = now_ns;
      }
      return;
    case hal::PowerRequest::kQuickStop:
      if (mode_ == Mode::kPowerStage || mode_ == Mode::kBrakeOpens) go_off(Mode::kOff, now_ns);
      if (mode_ == Mode::kEnabled) {
        mode_ = Mode::kQuickStop;
        mode_since_ns_ = now_ns;
        stop_begins_ = true;
      }
      return;
    case hal::PowerRequest::kReset:
      if (mode_ == Mode::kFault) go_off(Mode::kOff, now_ns);
      return;
  }
}

bool JointHardware::is_late(std::int64_t now_ns) const noexcept {
  return now_ns - command_ns_ > parameters_.command_deadline_ns;
}

void JointHardware::update(std::int64_t now_ns, double position, double velocity) noexcept {
  const JointHardwareParameters& p = parameters_;
  if (now_ns - brake_since_ns_ >= (brake_open_ ? p.brake_open_ns : p.brake_close_ns)) brake_holds_ = !brake_open_;
  const std::int64_t in_mode_ns = now_ns - mode_since_ns_;
  switch (mode_) {
    case Mode::kPowerStage:
    case Mode::kBrakeOpens:
      if (is_late(now_ns)) return trip(now_ns);
      if (mode_ == Mode::kPowerStage && in_mode_ns >= p.enable_ns) {
        mode_ = Mode::kBrakeOpens;
        set_brake(true, now_ns);
      }
      if (mode_ != Mode::kBrakeOpens || brake_holds_) return;
      mode_ = Mode::kEnabled;
      torque_ = commanded_;
      return;
    case Mode::kEnabled:
      if (is_late(now_ns)) return trip(now_ns);
      torque_ = commanded_;
      return;
    case Mode::kQuickStop:
      if (stop_begins_) {
        stop_position_ = position;
        stop_speed_ = std::fabs(velocity);
        stop_torque_ = torque_;
        stop_begins_ = false;
      }
      if (std::fabs(velocity) > stop_speed_ + p.stop_speed_margin) return trip(now_ns);
      torque_ = rounded(stop_torque_ - p.quick_stop_damping * velocity -
                        p.quick_stop_stiffness * (position - stop_position_));
      if (std::fabs(velocity) < p.rest_velocity || in_mode_ns >= p.quick_stop_ns) set_brake(false, now_ns);
      if (brake_holds_) go_off(Mode::kOff, now_ns);
      return;
    case Mode::kOff:
    case Mode::kFault:
    case Mode::kNoSupply: return;
  }
}

void JointHardware::trip(std::int64_t now_ns) noexcept {
  if (mode_ != Mode::kNoSupply) go_off(Mode::kFault, now_ns);
}

void JointHardware::disable(std::int64_t now_ns) noexcept {
  if (mode_ != Mode::kNoSupply && mode_ != Mode::kFault) go_off(Mode::kOff, now_ns);
}

void JointHardware::set_supply(bool on, std::int64_t now_ns) noexcept {
  if (on == (mode_ != Mode::kNoSupply)) return;
  go_off(on ? Mode::kOff : Mode::kNoSupply, now_ns);
}

hal::DriveState JointHardware::state() const noexcept {
  switch (mode_) {
    case Mode::kEnabled: return hal::DriveState::kEnabled;
    case Mode::kQuickStop: return hal::DriveState::kQuickStop;
    case Mode::kFault: return hal::DriveState::kFault;
    case Mode::kNoSupply: return hal::DriveState::kUnavailable;
    case Mode::kOff:
    case Mode::kPowerStage:
    case Mode::kBrakeOpens: break;
  }
  return hal::DriveState::kOff;
}

double JointHardware::rounded(double torque) const noexcept {
  const double limit = parameters_.torque_limit;
  const double step = parameters_.torque_step;
  const double within = std::clamp(torque, -limit, limit);
  return step > 0.0 ? step * std::round(within / step) : within;
}

std::int32_t JointHardware::counter(double position) const noexcept {
  const auto counts = static_cast<std::int64_t>(std::floor(position / parameters_.encoder_step));
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(counts + parameters_.counter_at_zero));
}

}  // namespace godobject::sim
