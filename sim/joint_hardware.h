#pragma once

#include <cstdint>

#include "hal/joint_drives.h"
#include "sim/joint_motor.h"

namespace godobject::sim {

/// The power states of a drive, its brake and its loops, in time that is passed in. Real-time safe.
///
/// Off -enable-> power stage, brake opens -> enabled. Enabled -quick stop-> brought to rest by the drive's own velocity
/// loop, which starts from the torque that acts; then the brake closes, then torque goes off. Enabled -off-> torque off
/// at once, the brake closes behind it. A fault does the same and is left by a reset only. While it is not enabled and
/// not in a quick stop, a drive gives no torque.
class JointHardware {
 public:
  JointHardware() = default;
  explicit JointHardware(const JointHardwareParameters& parameters) noexcept : motor_(parameters) {}

  /// What the bus brings, at time `now_ns`.
  void command(hal::PowerRequest power, double torque, std::int64_t now_ns) noexcept;

  /// Moves states on to `now_ns` and finds the torque from there on. Called at each step of the plant.
  void update(std::int64_t now_ns, double position, double velocity) noexcept;

  void trip(std::int64_t now_ns) noexcept;                 ///< a fault of the drive's own
  void disable(std::int64_t now_ns) noexcept;              ///< it goes off although nobody asked for it
  void set_supply(bool on, std::int64_t now_ns) noexcept;  ///< without supply: no torque, brake closing, no answer

  hal::DriveState state() const noexcept;
  double measured_torque() const noexcept { return motor_.torque(); }     ///< as the drive has it [Nm]
  double motor_torque() const noexcept { return motor_.motor_torque(); }  ///< on the joint [Nm]
  double brake_torque() const noexcept { return motor_.brake_torque(); }

  const JointHardwareParameters& parameters() const noexcept { return motor_.parameters(); }
  std::int32_t counter(double position) const noexcept { return motor_.counter(position); }  ///< as JointMotor

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
