#include "tests/closed_loop/can_run.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "firmware/configuration/cia402_keys.h"
#include "firmware/cycle/cycles_in.h"
#include "hal/canopen/network.h"
#include "toolchain/report/stability/fast_buses.h"

namespace godobject::firmware {

void DisturbedBus::begin_cycle(int flood, std::int64_t clock_ns) noexcept {
  flood_ = flood;
  clock_ns_ = clock_ns;
  cycles_ = true;
  taken_ = 0;
}

void DisturbedBus::answer_beside_the_wire(sim::CanNodes& nodes, int bus) noexcept {
  nodes_ = &nodes;
  number_ = bus;
}

hal::SendResult DisturbedBus::send(const hal::CanFrame& frame) noexcept {
  const int node = hal::canopen::node_of(frame.id, hal::canopen::kCobSdoRequest);
  if (nodes_ == nullptr || !cycles_ || node == 0) return bus_.send(frame);
  for (int i = 0; i < nodes_->node_count(); ++i) {
    if (nodes_->bus_of(i) != number_ || nodes_->node(i).number() != node) continue;
    nodes_->node(i).receive(frame, nodes_->now_ns());
    hal::CanFrame answer;
    if (nodes_->node(i).take_frame(answer)) answer_ = answer;
  }
  return hal::SendResult::kSent;
}

bool DisturbedBus::receive(hal::ReceivedFrame& received) noexcept {
  if (flood_ > 0) {
    --flood_;
    received = {.frame = {.id = 0x7A0, .length = 8}};
  } else if (answer_) {
    received = {.frame = *answer_};
    answer_.reset();
  } else if (!bus_.receive(received)) {
    return false;
  }
  received.time_ns += clock_ns_;
  if (cycles_) most_taken_ = std::max(most_taken_, ++taken_);
  return true;
}

namespace {

/// The buses and times that a device file with this period has.
hal::BusLayout at_period(double period, const hal::BusLayout& usual) {
  hal::BusLayout layout = report::layout_for(usual, period);
  set_usual_times(layout);
  return layout;
}

}  // namespace

CanRun::CanRun(const test::SceneImage& image, const Options& options)
    : scene_(test::open_scene(image)),
      placement_(run_placement()),
      options_(options),
      path_R_(run_path(placement_, options.path)) {
  set_run_gains(options.stiffness, scene_);
  scene_.settings.period = options.period;
  const ArmModel& arm = placement_.device.model;
  hal::BusLayout& layout = placement_.device.bus;
  layout = at_period(options.period, layout);
  layout.drives[1].zero = options.zero;
  layout.boot_timeout = 1.0;
  for (hal::DriveConfig& drive : layout.drives) {
    if (!options.names_drives) drive.identity = {};
    if (options.temperatures) drive.temperature = sim::kUsualTemperature;
    drive.temperature.warn = 70.0;
    drive.temperature.stop = 85.0;
  }
  if (options.quiet) {
    layout.drive_heartbeat = layout.mode_refresh = 3.0;
    layout.heartbeat_timeout = 7.0;
    layout.boot_timeout = 5.0;
  }
  hardware_ = sim::usual_hardware(arm);
  sim::HandParameters hand;
  hand.grip = sim::Grip::kSpring;
  plant_ =
      std::make_unique<sim::Plant>(arm, SimulatedRun::posture(), JointVector::Zero(),
                                   sim::OperatorHand(hand, path_R_, static_cast<std::int64_t>(1e9 * options.begin)));
  device_ = std::make_unique<sim::CanDevice>(
      *plant_, layout, hardware_,
      sim::CanScript{.hold_from_ns = std::llround(1e9 * options.hold_from), .faults = options_.drive_faults},
      options_.bus_faults);
  clock_ = std::make_unique<sim::VirtualClock>(*device_);
  buses_.reserve(hal::kMaxBuses);
  for (int i = 0; i < layout.bus_count; ++i) buses_.emplace_back(device_->bus(i));
  for (int i = 0; options.quiet && i < layout.bus_count; ++i)
    buses_.at(static_cast<std::size_t>(i)).answer_beside_the_wire(device_->nodes(), i);
  std::vector<hal::CanBus*> buses;
  for (DisturbedBus& bus : buses_) buses.push_back(&bus);
  const hal::BusPlan plan = hal::plan_buses(layout);
  if (!plan.fits) throw std::runtime_error("the buses have no room for a cycle");
  drives_.emplace(layout, buses, plan.timing);
  CycleSetup setup = run_setup(scene_, placement_);
  setup.period = setup.passivity.period = setup.supervisor.period = options.period;
  setup.torque.rate *= options.period / 1e-3;
  setup.supervisor.engage_cycles = cycles_in(0.05, options.period);
  setup.supervisor.sign_test = false;
  setup.memory = memory_.span();
  cycle_ = std::make_unique<ControlCycle>(setup, *drives_);
  if (cycle_->start() != Status::kOk) throw std::runtime_error("the scene lacks the solver");
}

void CanRun::run(std::int64_t count, const LoopEvents& events) {
  const std::int64_t period_ns = std::llround(1e9 * options_.period);
  for (std::int64_t i = 0; i < count; ++i) {
    deadline_ns_ = (device_->now_ns() + period_ns - 1) / period_ns * period_ns;
    clock_->sleep_until(deadline_ns_);
    const std::int64_t cycle = deadline_ns_ / period_ns;
    const Options::Flood& flood = options_.flood;
    const bool floods = cycle >= flood.first_cycle && cycle - flood.first_cycle < flood.cycles;
    const bool set = cycle >= options_.clock_set.first_cycle;
    for (std::size_t b = 0; b < buses_.size(); ++b) {
      buses_[b].begin_cycle(floods && static_cast<int>(b) == flood.bus ? flood.frames : 0,
                            set ? options_.clock_set.step_ns : 0);
    }
    cycle_->request();
    clock_->sleep_until(deadline_ns_ + cycle_->collect_ns());
    cycle_->run_once(i == 0 ? events : LoopEvents());
    cycles.push_back({cycle, cycle_->record()});
  }
}

int CanRun::most_taken() const {
  int most = 0;
  for (const DisturbedBus& bus : buses_) most = std::max(most, bus.most_taken());
  return most;
}

int CanRun::cycles_to_stop(std::int64_t number) const {
  for (const Cycle& cycle : cycles) {
    if (cycle.number >= number && cycle.record.share == 0.0) return static_cast<int>(cycle.number - number + 1);
  }
  return 0;
}

}  // namespace godobject::firmware
