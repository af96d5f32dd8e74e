#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "hal/cia402/bus_plan.h"
#include "hal/cia402/can_drives.h"
#include "sim/can_device.h"
#include "tests/closed_loop/simulated_run.h"

namespace godobject::firmware {

/// The whole controller on the simulated arm over its three buses, in virtual time; otherwise as SimulatedRun.
class CanRun {
 public:
  struct Options {
    std::vector<Vector3> path;  ///< of the ball in the scene, 1 ms apart, from time `begin` on
    double begin = 0.9;         ///< [s]
    std::vector<sim::BusFault> bus_faults;
    std::vector<sim::DriveFault> drive_faults;
    double zero = 0.0;  ///< position of joint 2 where its counter is 0 [rad]
  };

  CanRun(const test::SceneImage& image, const Options& options);

  /// Starts the nodes.
  hal::BringUpResult bring_up() { return drives_->bring_up(*clock_); }

  /// So many cycles more; each is kept.
  void run(std::int64_t cycles);

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
  std::optional<hal::CanDrives> drives_;
  std::unique_ptr<ControlCycle> cycle_;
  std::int64_t deadline_ns_ = 0;
};

}  // namespace godobject::firmware
