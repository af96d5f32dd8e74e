#pragma once

#include <cstdint>

#include "hal/can_frame.h"
#include "hal/cia402/bus_layout.h"
#include "hal/cia402/joint_scaling.h"
#include "hal/cia402/power_state.h"
#include "hal/joint_drives.h"

namespace godobject::hal::cia402 {

/// One joint's drive as its PDOs have it: TPDO1 {6041, 6064, 6077}, RPDO1 {6040, 6071}. Real-time safe.
///
/// A drive that has left operation while power was asked for is not enabled again before another power request has come
/// in between.
class JointChannel {
 public:
  JointChannel() = default;
  JointChannel(const DriveConfig& drive, bool fd) noexcept;

  /// Takes a sample. False: the drive cannot have sent it; nothing has changed.
  bool take(const CanFrame& tpdo) noexcept;

  double position() const noexcept { return position_; }  ///< [rad]
  double torque() const noexcept { return torque_; }      ///< [Nm]

  /// Enabled is a drive that follows the torque; one that is still opening its brake is off. Unasked, whatever is in
  /// operation counts as enabled.
  DriveState state() const noexcept;

  /// It is in operation and followed the torque, but does so no more.
  bool left_torque_mode() const noexcept;

  /// The frame for this cycle. False: the torque was not a finite number; zero is in the frame.
  bool command(PowerRequest power, double torque, CanFrame& rpdo) noexcept;

 private:
  static constexpr int kResetHold = 8;  // cycles for which the bit of a fault reset is low, and then high

  PowerGoal goal(PowerRequest power) const noexcept;

  JointScaling scaling_;
  int node_ = 0;
  bool fd_ = false;
  PowerState state_ = PowerState::kNotReady;
  bool follows_ = false;       // bit 12 of the statusword
  bool was_enabled_ = false;   // since power is asked for
  bool has_followed_ = false;  // since power is asked for
  PowerRequest power_ = PowerRequest::kOff;
  int reset_cycles_ = 0;
  double position_ = 0.0;
  double torque_ = 0.0;
};

}  // namespace godobject::hal::cia402
