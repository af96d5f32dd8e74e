#pragma once

#include <cstdint>
#include <limits>

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

/// The state as one or two words. Never null.
const char* name(PowerState state) noexcept;

/// Error codes of 603F for the drive's own faults.
inline constexpr std::uint16_t kOverCurrent = 0x2310;
inline constexpr std::uint16_t kRunsAway = 0x8400;

/// A written value makes the drive trip with this error code: for tests over the bus.
inline constexpr std::uint16_t kTripObject = 0x2000;

/// The temperature object of a drive whose layout has none: tenths of a degree, 16 bits, signed.
inline constexpr hal::TemperatureConfig kUsualTemperature{.index = 0x2310, .scale = 0.1};

/// A CiA 402 servo drive with one mode, 10, cyclic synchronous torque, on a joint's motor, brake and encoder. Real-time
/// safe.
///
/// Transitions 3 and 4 take the times of `JointHardwareParameters` for power stage and brake; until then the statusword
/// shows the state before. Transitions 5, 8, 9 and 10 cut the torque at once, and the brake closes after it. Transition
/// 11 stops by 605A: 0 cuts; 1 and 2 bring the joint to rest by the drive's own loop, close the brake and end in
/// switch-on disabled. Transitions 13 and 14 do the same by 605E. Reaction to a lost connection by 6007: 0 none, 1
/// fault, 2 disable voltage, 3 quick stop. The command deadline is that of the RPDO, 1400:5.
class Cia402Slave final : public CanopenNode {
 public:
  /// Steps of encoder and torque and the given fields of the identity are those of `config`; all other parameters those
  /// of `joint`.
  Cia402Slave(const hal::DriveConfig& config, const JointHardwareParameters& joint, bool fd) noexcept;

  /// Advances the states to `now_ns` and computes the torque from then on. Position and velocity are the joint's [rad,
  /// rad/s]. Called at each step of the plant, before frames that end at this time and again after them.
  void update(std::int64_t now_ns, double position, double velocity) noexcept;

  PowerState state() const noexcept { return state_; }
  double motor_torque() const noexcept { return config_.sign * motor_.motor_torque(); }  ///< on the joint [Nm]
  double brake_torque() const noexcept { return motor_.brake_torque(); }
  std::uint16_t statusword() const noexcept;

  std::uint64_t commands() const noexcept { return commands_; }  ///< received controlwords
  std::uint64_t trips() const noexcept { return trips_; }  ///< faults, and connections lost while the drive had power

  void trip(std::uint16_t code, std::int64_t now_ns) noexcept;  ///< a fault of the drive's own
  void disable(std::int64_t now_ns) noexcept;                   ///< the drive switches off without a request

  /// The drive shows another mode in 6061 and ignores the torque, while bit 12 of the statusword stays. kModeTorque
  /// ends it.
  void slip_mode(std::int8_t mode) noexcept;

  /// The temperature that the drive tells [degC]; 30 at first.
  void set_temperature(double celsius) noexcept { temperature_ = celsius; }

  /// The drive's own limit of its torque at the joint [Nm], as by current or heat. Bit 11 of the statusword shows it
  /// while it clips. At first infinite.
  void set_own_limit(double torque) noexcept { own_limit_ = torque; }

  /// Encoder faults: the reading is `jump` [rad] too large, and constant while `stuck`.
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
  bool limited_ = false;  ///< the commanded torque is above 6072, 60E0, 60E1 or the own limit
  double temperature_ = 30.0;
  double own_limit_ = std::numeric_limits<double>::infinity();
  double position_ = 0.0;
  double velocity_ = 0.0;
  double encoder_jump_ = 0.0;
  bool encoder_stuck_ = false;
  std::int8_t slipped_mode_ = hal::canopen::kModeTorque;
  double stuck_at_ = 0.0;
};

}  // namespace godobject::sim
