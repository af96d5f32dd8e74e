#include "hal/cia402/joint_channel.h"

#include <algorithm>
#include <cmath>

#include "hal/canopen/little_endian.h"
#include "hal/canopen/network.h"

namespace godobject::hal::cia402 {

JointChannel::JointChannel(const DriveConfig& drive, bool fd, double period) noexcept
    : scaling_(drive),
      node_(drive.node),
      fd_(fd),
      reset_hold_(std::max(1, static_cast<int>(std::lround(kResetHold / period)))) {}

bool JointChannel::take(const CanFrame& tpdo) noexcept {
  if (tpdo.length != 8) return false;
  const auto statusword = static_cast<std::uint16_t>(canopen::load(tpdo.data, 0, 2));
  const PowerState state = power_state(statusword);
  if (state == PowerState::kUnknown) return false;
  state_ = state;
  follows_ = (statusword & kStatusFollowsTarget) != 0;
  limited_ = (statusword & kStatusInternalLimit) != 0;
  if (power_ == PowerRequest::kEnable && state == PowerState::kOperationEnabled) {
    was_enabled_ = true;
    has_followed_ = has_followed_ || follows_;
  }
  position_ = scaling_.position(static_cast<std::int32_t>(canopen::load(tpdo.data, 2, 4)));
  torque_ = scaling_.torque(static_cast<std::int16_t>(canopen::load(tpdo.data, 6, 2)));
  return true;
}

DriveState JointChannel::state() const noexcept {
  switch (state_) {
    case PowerState::kOperationEnabled:
      return follows_ || power_ != PowerRequest::kEnable ? DriveState::kEnabled : DriveState::kOff;
    case PowerState::kQuickStopActive: return DriveState::kQuickStop;
    case PowerState::kFaultReaction:
    case PowerState::kFault: return DriveState::kFault;
    case PowerState::kSwitchOnDisabled:
    case PowerState::kReadyToSwitchOn:
    case PowerState::kSwitchedOn: return DriveState::kOff;
    case PowerState::kNotReady:
    case PowerState::kUnknown: break;
  }
  return DriveState::kUnavailable;
}

bool JointChannel::left_torque_mode() const noexcept {
  return state_ == PowerState::kOperationEnabled && has_followed_ && !follows_;
}

PowerGoal JointChannel::goal(PowerRequest power) const noexcept {
  switch (power) {
    case PowerRequest::kEnable:
      return was_enabled_ && state_ != PowerState::kOperationEnabled ? PowerGoal::kQuickStop : PowerGoal::kEnabled;
    case PowerRequest::kQuickStop: return PowerGoal::kQuickStop;
    case PowerRequest::kReset: return PowerGoal::kReset;
    case PowerRequest::kOff: break;
  }
  return PowerGoal::kOff;
}

bool JointChannel::command(PowerRequest power, double torque, CanFrame& rpdo) noexcept {
  power_ = power;
  if (power != PowerRequest::kEnable) was_enabled_ = has_followed_ = false;
  const bool reset_bit = (reset_cycles_ / reset_hold_) % 2 == 1;
  reset_cycles_ = power == PowerRequest::kReset ? reset_cycles_ + 1 : 0;
  const PowerGoal towards = goal(power);
  std::int16_t permille = 0;
  const bool finite = scaling_.permille(torque, permille);
  if (towards != PowerGoal::kEnabled) permille = 0;
  rpdo = CanFrame{canopen::cob(canopen::kCobRpdo1, node_), 4, fd_};
  canopen::store(rpdo.data, 0, 2, next_controlword(state_, towards, reset_bit));
  canopen::store(rpdo.data, 2, 2, static_cast<std::uint16_t>(permille));
  return finite;
}

}  // namespace godobject::hal::cia402
