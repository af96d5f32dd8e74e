#pragma once

#include <cstdint>

#include "hal/joint_drives.h"
#include "sim/joint_motor.h"

namespace godobject::sim {

/// The power states, the brake and the loops of a drive that obeys `hal::PowerRequest`. The caller passes the time.
/// Real-time safe.
///
/// - off, then `kEnable`: the power stage starts, the brake opens, the drive is enabled
/// - enabled, then `kQuickStop`: the drive's velocity loop, which starts from the present torque, brings the joint to
/// rest;
///   the brake closes; then the torque is switched off
/// - enabled, then `kOff`: the torque is switched off at once, and the brake closes after it
/// - a fault does the same; only `kReset` ends it
///
/// A drive gives torque only while it is enabled or in a quick stop.
class JointHardware {
 public:
  JointHardware() = default;
  explicit JointHardware(const JointHardwareParameters& parameters) noexcept : motor_(parameters) {}

  /// Takes a command at time `now_ns`.
  void command(hal::PowerRequest power, double torque, std::int64_t now_ns) noexcept;

  /// Advances the states to `now_ns` and computes the torque from then on. Called at each step of the plant.
  void update(std::int64_t now_ns, double position, double velocity) noexcept;

  void trip(std::int64_t now_ns) noexcept;                 ///< a fault of the drive's own
  void disable(std::int64_t now_ns) noexcept;              ///< the drive switches off without a request
  void set_supply(bool on, std::int64_t now_ns) noexcept;  ///< without supply: no torque, brake closing, no answer

  hal::DriveState state() const noexcept;
  double measured_torque() const noexcept { return motor_.torque(); }     ///< as the drive measures it [Nm]
  double motor_torque() const noexcept { return motor_.motor_torque(); }  ///< on the joint [Nm]
  double brake_torque() const noexcept { return motor_.brake_torque(); }

  const JointHardwareParameters& parameters() const noexcept { return motor_.parameters(); }
  std::int32_t counter(double position) const noexcept { return motor_.counter(position); }  ///< as in JointMotor

 private:
  enum class Mode : std::uint8_t { kOff, kPowerStage, kBrakeOpens, kEnabled, kQuickStop, kFault, kNoSupply };

  void go_off(Mode mode, std::int64_t now_ns) noexcept;
  bool is_late(std::int64_t now_ns) const noexcept;

  JointMotor motor_;
  Mode mode_ = Mode::kOff;
  std::int64_t mode_since_ns_ = 0;
  std::int64_t command_ns_ = 0;
  double commanded_ = 0.0;
  bool stop_begins_ = false;
};

}  // namespace godobject::sim
