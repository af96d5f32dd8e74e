#pragma once

#include <cstdint>

#include "hal/can_frame.h"
#include "hal/cia402/bus_layout.h"
#include "hal/cia402/joint_scaling.h"
#include "hal/cia402/power_state.h"
#include "hal/joint_drives.h"

namespace godobject::hal::cia402 {

/// The PDOs of one joint's drive: TPDO1 {6041, 6064, 6077}, RPDO1 {6040, 6071}. Real-time safe.
///
/// A drive that left operation while power was requested is not enabled again before another power request was made.
class JointChannel {
 public:
  JointChannel() = default;
  /// `fd`: its PDOs are FD frames; `period`: T [s].
  JointChannel(const DriveConfig& drive, bool fd, double period) noexcept;

  /// Takes a sample. False: it is invalid; nothing changes.
  bool take(const CanFrame& tpdo) noexcept;

  double position() const noexcept { return position_; }  ///< [rad]
  double torque() const noexcept { return torque_; }      ///< [Nm]
  bool limited() const noexcept { return limited_; }      ///< bit 11 of the statusword

  /// The drive's state. A drive in operation is enabled if it follows the torque; while it still opens its brake it is
  /// off. Without a request for power every drive in operation counts as enabled.
  DriveState state() const noexcept;

  /// True if the drive is in operation, has followed the torque and no longer does.
  bool left_torque_mode() const noexcept;

  /// Makes the frame of this cycle. False: the torque was not finite; the frame has zero torque.
  bool command(PowerRequest power, double torque, CanFrame& rpdo) noexcept;

 private:
  /// Time for which the bit of a fault reset is low, and then high [s]. A drive needs the rising edge. Chosen: a drive
  /// that reads its controlword every few milliseconds sees both levels; tests/closed_loop pass with 1 to 64 ms.
  static constexpr double kResetHold = 8e-3;

  PowerGoal goal(PowerRequest power) const noexcept;

  JointScaling scaling_;
  int node_ = 0;
  bool fd_ = false;
  int reset_hold_ = 1;  // cycles
  PowerState state_ = PowerState::kNotReady;
  bool follows_{};             // bit 12 of the statusword
  bool limited_ = false;       // bit 11 of the statusword
  bool was_enabled_ = false;   // since power was requested
  bool has_followed_ = false;  // since power was requested
  PowerRequest power_ = PowerRequest::kOff;
  int reset_cycles_ = 0;
  double position_ = 0.0;
  double torque_ = 0.0;
};

}  // namespace godobject::hal::cia402
