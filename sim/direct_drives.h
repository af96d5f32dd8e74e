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

struct DriveTiming {
  std::int64_t period_ns = 1'000'000;    ///< T: positions are sampled at its multiples; cycle k begins at k T
  std::int64_t delay_ns = 1'000'000;     ///< t_d: any number of periods, and fractions of one, up to 8 periods
  std::int64_t enable_ns = 200'000'000;  ///< when the operator, who is asked to, begins to hold the enable switch
  /// Of each joint, less than a period: how long after k T it is sampled, and after k T + t_d its torque acts. With
  /// those of a bus plan the drives are as those behind that bus when nothing blocks its frames.
  std::array<std::int64_t, kMaxJoints> sampled_ns{};
  std::array<std::int64_t, kMaxJoints> acts_ns{};
  std::int64_t collect_ns = 0;  ///< after k T: all have been sampled, and the controller may take the samples
};

/// What has gone over the wire.
struct DriveCounters {
  std::int64_t commands = 0;    ///< that `send` was called with
  std::int64_t not_finite = 0;  ///< torques among them that no drive can take; zero acts in their place
  std::int64_t dropped = 0;     ///< commands of a joint that went nowhere, by the script
};

/// The drives of a simulated arm in the same process and in lock-step: nothing moves but while `advance_to` runs, and
/// the plant runs in it, in equal steps of at most `Plant::kStep_ns` from one event to the next. Real-time safe;
/// allocates nothing.
///
/// Timing. All joints are sampled at k T. The torque of a `send` before (k + 1) T, however early in the cycle, acts
/// from k T + t_d on, exactly, and is held until the next one does. (If the sender is later than k T + t_d, it acts at
/// once.) Both may be later by an amount of each joint's own, see DriveTiming; `delay()` is the longest time from a
/// joint's sample to its torque, t_d without these. Power requests travel with the torque. `receive` brings the newest
/// sample, that of the present cycle from `collect_ns` after its beginning on.
class DirectDrives final : public hal::JointDrives, public World {
 public:
  /// The plant is at time zero; the plant and the script must outlive this.
  DirectDrives(Plant& plant, std::span<const JointHardwareParameters> joints, const DriveTiming& timing,
               std::span<const DriveFault> script = {}) noexcept;

  int joint_count() const noexcept override { return plant_.joint_count(); }
  void request() noexcept override {}  // joints are sampled by the clock
  std::int64_t collect_ns() const noexcept override { return timing_.collect_ns; }
  void receive(hal::JointReading& reading) noexcept override;
  bool send(const hal::JointCommand& command) noexcept override;
  double delay() const noexcept override;

  std::int64_t now_ns() const noexcept override { return plant_.now_ns(); }
  void advance_to(std::int64_t ns) noexcept override;

  /// The operator's switches, beside what the script says of them. Both begin released; the enable switch is held
  /// from `DriveTiming::enable_ns` on until it is said otherwise.
  void press_emergency_stop(bool pressed) noexcept { emergency_stop_ = pressed; }
  void hold_enable_switch(bool held) noexcept { enable_switch_ = held; }

  const JointHardware& joint(int i) const noexcept { return hardware_[static_cast<std::size_t>(i)]; }
  const DriveCounters& counters() const noexcept { return counters_; }

 private:
  static constexpr std::int64_t kHistory = 16;

  struct Sample {
    JointVector position = JointVector::Zero();
    JointVector torque = JointVector::Zero();
    std::array<hal::DriveState, kMaxJoints> state{};
  };
  struct Pending {
    hal::JointCommand command;
    std::array<std::int64_t, kMaxJoints> at_ns{};
    std::array<bool, kMaxJoints> waits{};  ///< neither has it arrived nor is it dropped
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
  std::array<Sample, kHistory> samples_;            ///< of cycle k at k modulo its size
  std::array<std::int64_t, kMaxJoints> sampled_;    ///< cycle of the newest sample
  std::array<std::int64_t, kMaxJoints> delivered_;  ///< of the newest one that has come
  std::array<std::int32_t, kMaxJoints> counter_{};
  std::array<std::int64_t, kMaxJoints> counts_{};  ///< the same without wraps, from q = 0
  std::array<Pending, kHistory> pending_;          ///< oldest first, from first_pending_ on
  std::int64_t first_pending_ = 0;
  std::int64_t end_pending_ = 0;
  hal::JointReading last_;
  bool emergency_stop_ = false;
  bool enable_switch_ = false;
  DriveCounters counters_;
};

}  // namespace godobject::sim
