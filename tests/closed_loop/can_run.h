#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "hal/cia402/bus_plan.h"
#include "hal/cia402/can_drives.h"
#include "sim/can_device.h"
#include "tests/closed_loop/simulated_run.h"
#include "toolchain/files/aligned_bytes.h"

namespace godobject::firmware {

/// A bus as the controller sees it, with what befalls its side of it: more frames than it may take in a cycle, stamps
/// by a clock that is set, and SDO that takes no time on the wire.
class DisturbedBus final : public hal::CanBus {
 public:
  explicit DisturbedBus(hal::CanBus& bus) noexcept : bus_(bus) {}

  hal::SendResult send(const hal::CanFrame& frame) noexcept override;
  bool receive(hal::ReceivedFrame& received) noexcept override;
  hal::BusHealth health() const noexcept override { return bus_.health(); }

  /// So many foreign frames are before all others in this cycle; stamps are off by `clock_ns`.
  void begin_cycle(int flood, std::int64_t clock_ns) noexcept;
  int most_taken() const noexcept { return most_taken_; }  ///< frames in a cycle

  /// SDO requests of the cycles reach this bus's nodes at once, and their answers the controller.
  void answer_beside_the_wire(sim::CanNodes& nodes, int bus) noexcept;

 private:
  hal::CanBus& bus_;
  int flood_ = 0;
  bool cycles_ = false;  // the start is over
  int taken_ = 0;
  int most_taken_ = 0;
  std::int64_t clock_ns_ = 0;
  sim::CanNodes* nodes_ = nullptr;  // that answer beside the wire
  int number_ = 0;
  std::optional<hal::CanFrame> answer_;
};

/// The whole controller on the simulated arm over its three buses, in virtual time; otherwise as SimulatedRun.
class CanRun {
 public:
  struct Options {
    std::vector<Vector3> path;  ///< of the ball in the scene, 1 ms apart, from time `begin` on
    double begin = 1.2;         ///< [s]
    std::vector<sim::BusFault> bus_faults;
    std::vector<sim::DriveFault> drive_faults;
    double zero = 0.0;        ///< position of joint 2 where its counter is 0 [rad]
    double hold_from = 1.04;  ///< when the enable switch is held [s]
    bool quiet = false;       ///< for 3 s from its first heartbeat on nothing is on the wires but SYNC and PDOs
    struct Flood {
      int bus = 0;
      std::int64_t first_cycle = 0;
      std::int64_t cycles = 0;
      int frames = 0;  ///< in each cycle
    } flood;
    struct ClockSet {
      std::int64_t first_cycle = 0;
      std::int64_t step_ns = 0;
    } clock_set;
  };

  CanRun(const test::SceneImage& image, const Options& options);

  /// Starts the nodes.
  hal::BringUpResult bring_up() { return drives_->bring_up(*clock_); }

  /// So many cycles more; each is kept. `events` are those of the first one.
  void run(std::int64_t cycles, const LoopEvents& events = {});

  /// Without anything from the controller: it was killed.
  void go_on_alone(double seconds) {
    device_->advance_to(device_->now_ns() + static_cast<std::int64_t>(1e9 * seconds));
  }

  /// Cycles from the period `number` on until nothing is rendered any more, that of `number` being the first; 0: never.
  int cycles_to_stop(std::int64_t number) const;

  struct Cycle {
    std::int64_t number = 0;  ///< period since time zero
    CycleRecord record;
  };
  std::vector<Cycle> cycles;

  int most_taken() const;  ///< frames from a bus in a cycle

  ControlCycle& controller() { return *cycle_; }
  hal::CanDrives& drives() { return *drives_; }
  sim::CanDevice& device() { return *device_; }
  const sim::Plant& plant() const { return *plant_; }
  const hal::BusLayout& layout() const { return placement_.device.bus; }

 private:
  Scene scene_;
  Placement placement_;
  Options options_;
  std::vector<Pose> path_R_;
  std::array<sim::JointHardwareParameters, kMaxJoints> hardware_;
  std::unique_ptr<sim::Plant> plant_;
  std::unique_ptr<sim::CanDevice> device_;
  std::unique_ptr<sim::VirtualClock> clock_;
  std::vector<DisturbedBus> buses_;
  std::optional<hal::CanDrives> drives_;
  files::AlignedBytes memory_{GodObject::least_memory_size()};
  std::unique_ptr<ControlCycle> cycle_;
  std::int64_t deadline_ns_ = 0;
};

}  // namespace godobject::firmware
