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

/// A bus with disturbances on the controller's side: more frames than the controller may take in a cycle, time stamps
/// of a clock that is set during the run, and SDO transfers that need no time on the wire.
class DisturbedBus final : public hal::CanBus {
 public:
  explicit DisturbedBus(hal::CanBus& bus) noexcept : bus_(bus) {}

  hal::SendResult send(const hal::CanFrame& frame) noexcept override;
  bool receive(hal::ReceivedFrame& received) noexcept override;
  hal::BusHealth health() const noexcept override { return bus_.health(); }

  /// Begins a cycle in which `flood` foreign frames precede all other frames and time stamps are off by `clock_ns`.
  void begin_cycle(int flood, std::int64_t clock_ns) noexcept;
  int most_taken() const noexcept { return most_taken_; }  ///< largest number of frames in a cycle

  /// From the first cycle on passes SDO requests to the nodes of this bus at once, and the answers to the controller.
  void answer_beside_the_wire(sim::CanNodes& nodes, int bus) noexcept;

 private:
  hal::CanBus& bus_;
  int flood_ = 0;
  bool cycles_ = false;  // the start is over
  int taken_ = 0;
  int most_taken_ = 0;
  std::int64_t clock_ns_ = 0;
  sim::CanNodes* nodes_ = nullptr;  // nodes that answer beside the wire
  int number_ = 0;
  std::optional<hal::CanFrame> answer_;
};

/// Runs the whole controller on the simulated arm over its buses, three at 1 ms, in virtual time. Otherwise as
/// SimulatedRun.
class CanRun {
 public:
  struct Options {
    std::vector<Vector3> path;  ///< positions of the ball in the scene, 1 ms apart, from time `begin` on
    double begin = 1.2;         ///< [s]
    std::vector<sim::BusFault> bus_faults;
    std::vector<sim::DriveFault> drive_faults;
    double period = 1e-3;       ///< T; below 1 ms each joint has a bus of its own, with FD frames alone [s]
    double stiffness = 2000.0;  ///< of the wall [N/m]
    double zero = 0.0;          ///< position of joint 2 where its counter is 0 [rad]
    double hold_from = 1.04;    ///< the enable switch is held from this time on [s]
    bool names_drives = true;   ///< the layout names the identities of the drives, as the device file does
    bool temperatures = false;  ///< the layout names the simulated drives' temperatures: warn at 70, stop at 85 degC
    bool quiet = false;         ///< for 3 s from the first heartbeat on, only SYNC and PDOs are on the wires
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

  /// Runs so many more cycles and appends each to the member `cycles`. `events` are the events of the first one.
  void run(std::int64_t cycles, const LoopEvents& events = {});

  /// Advances the arm without the controller, as after the controller was killed.
  void go_on_alone(double seconds) {
    device_->advance_to(device_->now_ns() + static_cast<std::int64_t>(1e9 * seconds));
  }

  /// Returns the number of cycles from the period `number` to the first one without rendering, both included; 0: never.
  int cycles_to_stop(std::int64_t number) const;

  struct Cycle {
    std::int64_t number = 0;  ///< period since time zero
    CycleRecord record;
  };
  std::vector<Cycle> cycles;

  int most_taken() const;  ///< largest number of frames taken from a bus in a cycle

  ControlCycle& controller() { return *cycle_; }
  hal::CanDrives& drives() { return *drives_; }
  sim::CanDevice& device() { return *device_; }
  const sim::Plant& plant() const { return *plant_; }
  const hal::BusLayout& layout() const { return placement_.device.bus; }

 private:
  SceneView scene_;
  Placement placement_;
  Options options_;
  std::vector<Pose> path_R_;
  std::array<sim::JointHardwareParameters, kMaxJoints> hardware_;
  std::unique_ptr<sim::Plant> plant_;
  std::unique_ptr<sim::CanDevice> device_;
  std::unique_ptr<sim::VirtualClock> clock_;
  std::vector<DisturbedBus> buses_;
  std::optional<hal::CanDrives> drives_;
  files::AlignedBytes memory_{GodObject::memory_size(Scene::of(scene_))};
  std::unique_ptr<ControlCycle> cycle_;
  std::int64_t deadline_ns_ = 0;
};

}  // namespace godobject::firmware
