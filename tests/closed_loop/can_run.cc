#include "tests/closed_loop/can_run.h"

#include <stdexcept>

namespace godobject::firmware {

CanRun::CanRun(const test::SceneImage& image, const Options& options)
    : scene_(test::open_scene(image)),
      placement_(run_placement()),
      options_(options),
      path_R_(run_path(placement_, options.path)) {
  set_run_gains(2000.0, scene_);
  const ArmModel& arm = placement_.device.model;
  hal::BusLayout& layout = placement_.device.bus;
  layout.drives[1].zero = options.zero;
  layout.boot_timeout = 1.0;
  hardware_ = sim::usual_hardware(arm);
  sim::HandParameters hand;
  hand.grip = sim::Grip::kSpring;
  plant_ =
      std::make_unique<sim::Plant>(arm, SimulatedRun::posture(), JointVector::Zero(),
                                   sim::OperatorHand(hand, path_R_, static_cast<std::int64_t>(1e9 * options.begin)));
  device_ = std::make_unique<sim::CanDevice>(
      *plant_, layout, hardware_, sim::CanScript{.hold_from_ns = 740'000'000, .faults = options_.drive_faults},
      options_.bus_faults);
  clock_ = std::make_unique<sim::VirtualClock>(*device_);
  std::array<hal::CanBus*, 3> buses{&device_->bus(0), &device_->bus(1), &device_->bus(2)};
  drives_.emplace(layout, buses, hal::plan_buses(layout).timing);
  CycleSetup setup = run_setup(scene_, placement_);
  setup.supervisor.sign_test = false;
  cycle_ = std::make_unique<ControlCycle>(setup, *drives_);
  if (cycle_->start() != Status::kOk) throw std::runtime_error("the scene lacks the solver");
}

void CanRun::run(std::int64_t count) {
  constexpr std::int64_t kPeriod_ns = 1'000'000;
  for (std::int64_t i = 0; i < count; ++i) {
    deadline_ns_ = (device_->now_ns() + kPeriod_ns - 1) / kPeriod_ns * kPeriod_ns;
    clock_->sleep_until(deadline_ns_);
    cycle_->request();
    clock_->sleep_until(deadline_ns_ + cycle_->collect_ns());
    cycle_->run_once({});
    cycles.push_back({deadline_ns_ / kPeriod_ns, cycle_->record()});
  }
}

int CanRun::cycles_to_stop(std::int64_t number) const {
  for (const Cycle& cycle : cycles) {
    if (cycle.number >= number && cycle.record.share == 0.0) return static_cast<int>(cycle.number - number + 1);
  }
  return 0;
}

}  // namespace godobject::firmware
