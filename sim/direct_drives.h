#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hal/joint_drives.h"
#include "sim/drive_fault.h"
#include "sim/joint_hardware.h"
#include "sim/plant.h"
#include "sim/virtual_clock.h"

namespace godobject::sim {

/// Times of the drives.
struct DriveTiming {
  std::int64_t period_ns = 1'000'000;    ///< T: positions are sampled at multiples of T; cycle k begins at k T
  std::int64_t delay_ns = 1'000'000;     ///< t_d: up to 8 periods, also with a fraction
  std::int64_t enable_ns = 200'000'000;  ///< time from which the operator holds the enable switch
  /// Additional delays of each joint, less than a period: of its sample after k T, and of its torque after k T + t_d.
  /// With those of a bus plan the drives behave as drives on that bus without blocking frames.
  std::array<std::int64_t, kMaxJoints> sampled_ns{};
  std::array<std::int64_t, kMaxJoints> acts_ns{};
  std::int64_t collect_ns =
      0;  ///< time after k T at which the controller takes the samples; all joints are sampled by then
};

/// Figures of the drives.
struct DriveCounters {
  std::int64_t commands = 0;    ///< calls of `send`
  std::int64_t not_finite = 0;  ///< torques that are not finite; zero acts in their place
  std::int64_t dropped = 0;     ///< commands of a joint that were lost by a fault
};

/// The drives of a simulated arm in the same process and in lock-step, without a bus. Time passes only in `advance_to`,
/// which integrates the plant in equal steps of at most `Plant::kStep_ns` from one event to the next. Real-time safe;
/// does not allocate.
///
/// Timing: all joints are sampled at k T. The torque of a `send` before (k + 1) T acts exactly from k T + t_d on,
/// however early it was sent, and until the next one acts. If it is sent after k T + t_d, it acts at once. Both times
/// may have additional delays for each joint, see DriveTiming. `delay()` is the longest time from a joint's sample to
/// its torque: t_d without additional delays. Power requests travel with the torque. `receive` returns the newest
/// sample: from `collect_ns` on that of the present cycle.
class DirectDrives final : public hal::JointDrives, public World {
 public:
  /// The plant is at time zero; plant and script outlive this.
  DirectDrives(Plant& plant, std::span<const JointHardwareParameters> joints, const DriveTiming& timing,
               std::span<const DriveFault> script = {}) noexcept;

  int joint_count() const noexcept override { return plant_.joint_count(); }
  void request() noexcept override {}  // the clock samples the joints
  std::int64_t collect_ns() const noexcept override { return timing_.collect_ns; }
  void receive(hal::JointReading& reading) noexcept override;
  bool send(const hal::JointCommand& command) noexcept override;
  double delay() const noexcept override;

  std::int64_t now_ns() const noexcept override { return plant_.now_ns(); }
  void advance_to(std::int64_t ns) noexcept override;

  /// The operator's switches, in addition to the script. Both are released at first; the enable switch is held from
  /// `DriveTiming::enable_ns` on, until the next call.
  void press_emergency_stop(bool pressed) noexcept { emergency_stop_ = pressed; }
  void hold_enable_switch(bool held) noexcept { enable_switch_ = held; }

  const JointHardware& joint(int i) const noexcept { return hardware_[static_cast<std::size_t>(i)]; }
  const DriveCounters& counters() const noexcept { return counters_; }

 private:
  static constexpr std::int64_t kHistory = 16;  // cycles; derived: a reading may be 15 cycles late, see DriveFault

  struct Sample {
    JointVector position = JointVector::Zero();
    JointVector torque = JointVector::Zero();
    std::array<hal::DriveState, kMaxJoints> state{};
  };
  struct Pending {
    hal::JointCommand command;
    std::array<std::int64_t, kMaxJoints> at_ns{};
    std::array<bool, kMaxJoints> waits{};  ///< the command has neither arrived nor been dropped
  };

  std::int64_t cycle() const noexcept { return plant_.now_ns() / timing_.period_ns; }
  const DriveFault* fault(FaultKind kind, int joint) const noexcept;
  void apply_commands() noexcept;
  void run_to(std::int64_t ns) noexcept;
  std::int64_t next_event_ns() const noexcept;
  void begin_cycle() noexcept;
  void sample_due() noexcept;
  void sample(int i) noexcept;
  double read_position(int i) noexcept;

  Plant& plant_;
  DriveTiming timing_;
  std::span<const DriveFault> script_;
  std::array<JointHardware, kMaxJoints> hardware_;
  std::array<Sample, kHistory> samples_;            ///< the sample of cycle k is at k modulo kHistory
  std::array<std::int64_t, kMaxJoints> sampled_;    ///< cycle of the newest sample
  std::array<std::int64_t, kMaxJoints> delivered_;  ///< cycle of the newest sample that has arrived
  std::array<std::int32_t, kMaxJoints> counter_{};
  std::array<std::int64_t, kMaxJoints> counts_{};  ///< counts without wraps, from q = 0
  std::array<Pending, kHistory> pending_;          ///< oldest first, from first_pending_ on
  std::int64_t first_pending_ = 0;
  std::int64_t end_pending_ = 0;
  hal::JointReading last_;
  bool emergency_stop_ = false;
  bool enable_switch_ = false;
  DriveCounters counters_;
};

}  // namespace godobject::sim
