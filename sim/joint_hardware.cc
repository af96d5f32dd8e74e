#include "sim/joint_hardware.h"

namespace godobject::sim {

void JointHardware::go_off(Mode mode, std::int64_t now_ns) noexcept {
  mode_ = mode;
  mode_since_ns_ = now_ns;
  motor_.cut(now_ns);
}

void JointHardware::command(hal::PowerRequest power, double torque, std::int64_t now_ns) noexcept {
  if (mode_ == Mode::kNoSupply) return;
  command_ns_ = now_ns;
  commanded_ = torque;
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
  return now_ns - command_ns_ > motor_.parameters().command_deadline_ns;
}

void JointHardware::update(std::int64_t now_ns, double position, double velocity) noexcept {
  motor_.update(now_ns);
  const std::int64_t in_mode_ns = now_ns - mode_since_ns_;
  switch (mode_) {
    case Mode::kPowerStage:
    case Mode::kBrakeOpens:
      if (is_late(now_ns)) return trip(now_ns);
      if (mode_ == Mode::kPowerStage && in_mode_ns >= motor_.parameters().enable_ns) {
        mode_ = Mode::kBrakeOpens;
        motor_.set_brake(true, now_ns);
      }
      if (mode_ != Mode::kBrakeOpens || motor_.brake_holds()) return;
      mode_ = Mode::kEnabled;
      motor_.set_torque(commanded_);
      return;
    case Mode::kEnabled:
      if (is_late(now_ns)) return trip(now_ns);
      motor_.set_torque(commanded_);
      return;
    case Mode::kQuickStop:
      if (stop_begins_) motor_.begin_stop(now_ns, position, velocity);
      stop_begins_ = false;
      switch (motor_.stop(now_ns, position, velocity)) {
        case Stopping::kSlowing: return;
        case Stopping::kHeld: return go_off(Mode::kOff, now_ns);
        case Stopping::kRunsAway: return trip(now_ns);
      }
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

}  // namespace godobject::sim
