#pragma once

#include <cstdint>

#include "hal/cia402/bus_layout.h"
#include "sim/canopen_node.h"
#include "sim/joint_motor.h"

namespace godobject::sim {

/// Power states of CiA 402.
enum class PowerState : std::uint8_t {
  kNotReady,
  kSwitchOnDisabled,
  kReady,
  kSwitchedOn,
  kEnabled,
  kQuickStop,
  kFaultReaction,
  kFault,
};

/// One or two words.
const char* name(PowerState state) noexcept;

/// Error codes of 603F that the drive itself trips with.
inline constexpr std::uint16_t kOverCurrent = 0x2310;
inline constexpr std::uint16_t kRunsAway = 0x8400;

/// Writes an error code of 603F into the drive, which trips with it: for tests from outside.
inline constexpr std::uint16_t kTripObject = 0x2000;

/// A servo drive after CiA 402, profile torque only in the mode 10, cyclic synchronous torque, on a joint's motor,
/// brake and encoder. Real-time safe.
///
/// Transitions 3 and 4 take the times of `JointHardwareParameters`: the power stage, then the brake; until then the
/// statusword shows the state before. 5 and 8 cut the torque at once, the brake closes behind it, as 9 and 10 do. 11
/// stops by 605A: 0 cuts, 1 and 2 bring the joint to rest by the drive's own loop, close the brake and end in switch on
/// disabled. 13 and 14 do the same by 605E. A lost connection is answered by 6007: 0 nothing, 1 fault, 2 disable
/// voltage, 3 quick stop. The command deadline is the RPDO's, 1400:5.
class Cia402Slave final : public CanopenNode {
 public:
  /// Steps of encoder and torque are the drive's own, from `config`; of `joint` the rest counts.
  Cia402Slave(const hal::DriveConfig& config, const JointHardwareParameters& joint, bool fd) noexcept;

  /// Moves states on to `now_ns` and finds the torque from there on; position and velocity are the joint's [rad,
  /// rad/s]. Called at each step of the plant, before frames that come at this time are received and again after them.
  void update(std::int64_t now_ns, double position, double velocity) noexcept;

  PowerState state() const noexcept { return state_; }
  double motor_torque() const noexcept { return config_.sign * motor_.motor_torque(); }  ///< on the joint [Nm]
  double brake_torque() const noexcept { return motor_.brake_torque(); }
  std::uint16_t statusword() const noexcept;

  std::uint64_t commands() const noexcept { return commands_; }  ///< controlwords that have come
  std::uint64_t trips() const noexcept { return trips_; }        ///< faults, and connections that were lost under power

  void trip(std::uint16_t code, std::int64_t now_ns) noexcept;  ///< a fault of the drive's own
  void disable(std::int64_t now_ns) noexcept;                   ///< it goes off although nobody asked for it

  /// It shows another mode in 6061 and follows no torque, though bit 12 of the statusword stays; kModeTorque: no more.
  void slip_mode(std::int8_t mode) noexcept;

  /// What the encoder reads in place of the position: `jump` [rad] more, and while `stuck` always the same.
  void set_encoder_fault(double jump, bool stuck) noexcept;

 private:
  enum class Command : std::uint8_t { kDisableVoltage, kQuickStop, kShutdown, kSwitchOn, kEnable };

  void sample() noexcept override;
  SdoAbort check(const ObjectEntry& entry, std::uint32_t value) const noexcept override;
  void written(const ObjectEntry& entry, std::int64_t now_ns) noexcept override;
  void connection_lost(std::uint16_t code, std::int64_t now_ns) noexcept override;
  void reset_device(bool supply, std::int64_t now_ns) noexcept override;

  void enter(PowerState state, std::int64_t now_ns) noexcept;
  void obey(std::uint16_t controlword, std::int64_t now_ns) noexcept;
  void quick_stop(std::int64_t now_ns) noexcept;
  void fault(std::uint16_t code, std::int64_t now_ns) noexcept;
  void run_stop(PowerState end, std::int64_t now_ns) noexcept;
  void follow_torque() noexcept;
  bool has_power() const noexcept;
  bool polarity(int bit) const noexcept;
  std::int8_t mode_display() const noexcept;
  static Command command_of(std::uint16_t controlword) noexcept;

  hal::DriveConfig config_;
  JointMotor motor_;
  PowerState state_ = PowerState::kNotReady;
  Command command_ = Command::kDisableVoltage;
  bool reset_bit_ = false;
  std::int64_t command_since_ns_ = 0;
  std::uint64_t commands_ = 0;
  std::uint64_t trips_ = 0;
  bool limited_ = false;  ///< the torque asked for is beyond 6072
  double position_ = 0.0;
  double velocity_ = 0.0;
  double encoder_jump_ = 0.0;
  bool encoder_stuck_ = false;
  std::int8_t slipped_mode_ = hal::canopen::kModeTorque;
  double stuck_at_ = 0.0;
};

}  // namespace godobject::sim
