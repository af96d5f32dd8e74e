#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "firmware/bus_log_writer.h"
#include "firmware/bus_messages.h"
#include "firmware/bus_plan_table.h"
#include "firmware/can_buses.h"
#include "firmware/can_interfaces.h"
#include "firmware/commissioning.h"
#include "firmware/configuration/controller_file.h"
#include "firmware/control_cycle.h"
#include "firmware/controller_run.h"
#include "firmware/doctor.h"
#include "firmware/gain_check.h"
#include "firmware/rt_setup.h"
#include "firmware/scene_file.h"
#include "firmware/simulated_arm.h"
#include "firmware/telemetry_ring.h"
#include "firmware/telemetry_writer.h"
#include "firmware/worker_thread.h"
#include "hal/can_log_ring.h"
#include "hal/cia402/bus_plan.h"
#include "hal/cia402/can_drives.h"
#include "hal/linux/monotonic_clock.h"
#include "sim/can_device.h"
#include "sim/virtual_clock.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/command_line/in_build.h"
#include "toolchain/command_line/run.h"
#include "toolchain/files/aligned_bytes.h"

namespace {

using namespace godobject;
using command::ExitCode;
using command::Failure;
using firmware::ControllerConfig;

const char* const kFooter = R"(Examples:
  godobject-controller firmware/controllers/lwr.toml --scene bt.scene --duration 20 --log logs
  godobject-controller doctor firmware/controllers/lwr.toml

The loop begins once all drives answer, their joints rest within their limits and the enable switch, seen released, is held. It
pushes each joint a little, to see that it moves the right way, and renders once the contact force is small. A fault takes the
torque away and is latched: SIGUSR1 resets it once emergency stop and enable switch are released. SIGTERM, SIGINT and SIGHUP end
the run in order: exit 0.

--bus sim, the default, is a simulated device with a hand on it, in virtual time: as fast as the machine can. With
--real-time (loop.real_time) it keeps to the clock, on a thread with real-time priority as far as that is permitted.

CONTROLLER.toml, units SI; firmware/README.md explains each key:
  [scene]      image, solver, friction
  [device]     file
  [workspace]  posture, start, turn, scale
  [loop]       real_time, cpu, priority, velocity_window, compute
  [gains]      stiffness, damping, rotational, margin
  [passivity]  damping
  [limits]     force, torque, speed, speed_stop, turn, turn_stop, joint_speed, joint_speed_stop, torque_rate,
               stuck_torque
  [engage]     force, ramp
  [start]      wait, sign_test, push, motion
  [telemetry]  folder, every, bus
  [simulation] path, slower, begin

--log DIR writes DIR/telemetry.csv, a row a cycle: times, mode, fault, joint positions q, velocities qd and torques, device pose
d and god object g of the moving mesh in the scene, force f and torque t rendered at the hand in the room's directions, depth, energy
absorbed from arm and hand, damping injected. In virtual time DIR/hand.csv has the work that the simulated hand has done on the tool until then.

Exit codes: 0 done, 64 usage, 65 bad scene image or path, or an image without the solver or friction asked for, 66 an input is
missing or a file of the configuration may not be read, 69 drives or bus not available, or stopped by a fault, 74 cannot write,
77 no right to read the scene image, to a CAN interface or to real-time work, 78 bad configuration.)";

const char* const kDoctorFooter = R"(Example:
  godobject-controller doctor firmware/controllers/lwr.toml --bus can0,can1,can2

A line each: ok, or LACK with its cure. CONTROLLER.toml is looked at for loop.cpu, loop.priority and the device's buses: their bit
rates, and what each carries in a cycle.

Exit codes: 0 done, 64 usage, 66 CONTROLLER.toml is missing or may not be read, 69 something is lacking without which there is no
real-time work: kernel, rtprio, memlock or a working CAN interface, 78 bad configuration.)";

const char* const kCommissionFooter = R"(Examples:
  godobject-controller commission firmware/controllers/lwr.toml --bus can0,can1,can2
  godobject-controller commission firmware/controllers/lwr.toml          # on the simulated drives

Starts the drives and gives none of them power. Each is set to no mode and back, which its TPDO2 must tell at once. Then the torque
frames (RPDO) of one joint after the other are left out: the drive must say, by emergency message 8250 or by a fault, that its
deadline has run out. Prints a line a joint: what its drive says of itself,
its sign and zero as the device file has them and the position that follows, and what was seen.

A drive that watches its deadline in operation enabled only shows nothing here; firmware/README.md says how it is tried then.

Exit codes: 0 modes and deadlines of all joints were seen in time, 64 usage, 66 CONTROLLER.toml is missing or may not be read, 69 drives or
bus not available, or a mode or deadline that was not seen, 77 not permitted, 78 bad configuration.)";

struct Options {
  std::string controller;
  std::string scene;
  std::string bus = "sim";
  std::string log;
  bool log_bus = false;
  bool real_time = false;
  std::optional<double> duration;
};

firmware::RunRequests requests;  // of the signals

void on_signal(int signal) {
  (signal == SIGUSR1 ? requests.reset : requests.end).store(true, std::memory_order_relaxed);
}

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  // a terminal that is closed ends the run, it resets nothing
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1}) ::sigaction(signal, &action, nullptr);
  action.sa_handler = SIG_IGN;  // of a telemetry that cannot be written: that costs records
  for (const int signal : {SIGPIPE, SIGXFSZ}) ::sigaction(signal, &action, nullptr);
}

void warn(const std::string& what) {
  std::fflush(stdout);  // what led to it comes before it, also where both go to one file
  fmt::print(stderr, "godobject-controller: {}\n", what);
}

/// FOLDER/hand.csv, a row a cycle: by how much the simulated hand has worked on the tool. Not real-time safe.
class HandLog {
 public:
  /// Throws Failure (kIo) if it cannot be written.
  HandLog(const std::filesystem::path& folder, const firmware::SimulatedArm& arm)
      : file_(folder / "hand.csv"), arm_(arm), stream_(file_) {
    stream_ << "t_s,hand_J\n";
    check();
  }

  void write_row() {
    stream_ << fmt::format("{:.6f},{:.9g}\n", 1e-9 * static_cast<double>(arm_.now_ns()), arm_.hand_work());
  }

  /// The last rows to the disk. Throws as above.
  void close() {
    stream_.close();
    check();
  }

 private:
  void check() const {
    if (!stream_) throw Failure(ExitCode::kIo, fmt::format("{}: cannot be written; check the folder", file_.string()));
  }

  std::filesystem::path file_;
  const firmware::SimulatedArm& arm_;
  std::ofstream stream_;
};

/// The machine's clock, with the simulated world kept beside it: it runs up to a deadline before that is waited for, so
/// that its own computing does not show as lateness.
class PacedClock final : public hal::Clock {
 public:
  explicit PacedClock(sim::World& world) noexcept : world_(world), offset_ns_(clock_.now_ns() - world.now_ns()) {}

  std::int64_t now_ns() noexcept override { return clock_.now_ns() - offset_ns_; }
  void sleep_until(std::int64_t ns) noexcept override {
    world_.advance_to(ns);
    clock_.sleep_until(ns + offset_ns_);
  }

 private:
  sim::World& world_;
  hal::MonotonicClock clock_;
  std::int64_t offset_ns_;
};

firmware::CycleSetup cycle_setup(const ControllerConfig& config, const Scene& scene,
                                 const firmware::Placement& placement, std::span<std::byte> memory) {
  firmware::CycleSetup setup;
  setup.scene = &scene;
  setup.memory = memory;
  setup.solver = config.scene.solver.value_or(scene.default_solver());
  setup.friction = config.scene.friction.value_or(scene.settings.friction != 0);
  setup.arm = &placement.device.model;
  setup.joint_torque = &placement.device.torque;
  setup.mapping = placement.mapping;
  setup.velocity_window = config.loop.velocity_window;
  setup.passivity = {config.passivity.damping, firmware::ControlCycle::kPeriod,
                     placement.device.torque.rotation_length};
  const ControllerConfig::Limits& limits = config.limits;
  setup.hand = {limits.force, limits.torque, limits.speed, limits.speed_stop, limits.turn, limits.turn_stop};
  setup.stuck_torque = limits.stuck_torque;
  setup.torque = {limits.torque_rate, limits.joint_speed, limits.joint_speed_stop};
  const auto cycles = [](double seconds) {
    return static_cast<std::uint32_t>(seconds / firmware::ControlCycle::kPeriod + 0.5);
  };
  setup.supervisor.boot_cycles = cycles(config.start.wait);
  setup.supervisor.prepare_cycles = static_cast<std::uint32_t>(1.0 / limits.torque_rate) + 5;
  setup.supervisor.engage_cycles = cycles(config.engage.ramp);
  setup.supervisor.engage_force = config.engage.force;
  setup.supervisor.sign_test = config.start.sign_test;
  setup.supervisor.sign = {config.start.push, config.start.motion};
  return setup;
}

/// Refuses what is beyond the stability boundary, says what is near to it.
void check_gains(const ControllerConfig& config, const Scene& scene, const firmware::Device& device, double delay) {
  const double scale = config.workspace.scale;
  const LoopTiming timing{firmware::ControlCycle::kPeriod, delay, config.loop.velocity_window};
  firmware::require_stable_joints(device.model, device.torque, config.workspace.posture, timing);
  const firmware::GainReport report =
      firmware::check_gains(scene, device.model, config.workspace.posture, scale, timing);
  const auto felt = firmware::FeltCoupling::of(scene, scale);
  for (const std::string& line : firmware::judge_gains(report, felt, config.gains.margin)) warn(line);
  firmware::require_stable_injection(scene, device.model, config.workspace.posture, scale, timing,
                                     {config.passivity.damping, device.torque.rotation_length}, config.gains.margin);
  fmt::print(
      "{}: {:.4g} N/m and {:.4g} Nm/rad at the hand, stable up to {:.3g} times as much with {:.3g} ms of delay\n",
      device.name, felt.stiffness, felt.rotation_stiffness, report.margin, 1e3 * delay);
}

std::string quantiles(const firmware::DurationHistogram& times) {
  const auto us = [](std::int64_t ns) { return 1e-3 * static_cast<double>(ns); };
  return fmt::format("p50 {:.1f} us, p99.9 {:.1f} us, largest {:.1f} us of {} cycles", us(times.quantile_ns(0.5)),
                     us(times.quantile_ns(0.999)), us(times.largest_ns()), times.count());
}

std::string seconds_in_modes(const firmware::RunReport& report) {
  std::string text;
  for (std::size_t mode = 0; mode < report.in_mode.size(); ++mode) {
    if (report.in_mode[mode] == 0) continue;
    text += fmt::format("{} {} {:.3f} s", text.empty() ? "" : ",", name(static_cast<firmware::Mode>(mode)),
                        firmware::ControlCycle::kPeriod * static_cast<double>(report.in_mode[mode]));
  }
  return text;
}

void print_report(const firmware::RunReport& report, const firmware::CycleCounters& counters,
                  const hal::CanDrives& drives, bool real_time, long faults_of_pages) {
  fmt::print("rendered in {} of {} cycles, in contact in {}: at most {:.2f} N, {:.3f} Nm, {:.3f} mm deep\n",
             report.rendering, counters.cycles, report.in_contact, report.largest_force, report.largest_torque,
             1e3 * report.deepest);
  fmt::print("modes:{}\n", seconds_in_modes(report));
  fmt::print("positions lost in {} cycles, jumps in {}, sends failed {}, overruns {}, periods skipped {}\n",
             counters.lost, counters.jumps, counters.sends_failed, counters.overruns, counters.skipped);
  fmt::print("{}", firmware::bus_summary(drives.statistics(), drives.joint_count()));
  fmt::print("limits: force in {} cycles, speed {}, joint torque {}, torque rate {}; friction not found in {}\n",
             counters.clipped, counters.slowed, counters.scaled, counters.rate_limited, counters.unconverged);
  fmt::print("computing: {}; longer than loop.compute in {}\n", quantiles(report.computing), report.beyond_plan);
  if (real_time) {
    fmt::print("round trip: {}\n", quantiles(report.round_trip));
    fmt::print("waking late: {}\n", quantiles(report.loop.lateness));
    fmt::print("waking late for the samples: {}\n", quantiles(report.loop.collect_lateness));
    fmt::print("page faults in the loop: {}\n", faults_of_pages);
  }
  fmt::print("on {}\n", firmware::describe_machine());
}

firmware::TelemetryRing ring;
hal::CanLogRing bus_ring;
firmware::RunReport run_report;
std::optional<hal::CanDrives> drives;
std::optional<firmware::ControlCycle> cycle;

/// The simulated operator holds the enable switch from then on.
constexpr std::int64_t kHoldFrom_ns = 1'500'000'000;

/// How the arm of a run is reached: it is simulated in this process, or behind this machine's CAN interfaces.
struct ArmLink {
  std::unique_ptr<firmware::SimulatedArm> simulated;  // with the wires to it
  std::unique_ptr<sim::CanDevice> device;
  std::unique_ptr<firmware::CanBuses> interfaces;
  std::vector<std::string> names;  // of the buses
  std::vector<hal::CanBus*> buses;
  bool real_time = false;

  std::unique_ptr<hal::Clock> make_clock() const {
    if (!device) return std::make_unique<hal::MonotonicClock>();
    if (real_time) return std::make_unique<PacedClock>(*device);
    return std::make_unique<sim::VirtualClock>(*device);
  }
};

ArmLink link_arm(const Options& options, const ControllerConfig& config, const firmware::Placement& placement) {
  const hal::BusLayout& layout = config.device.bus;
  ArmLink link;
  if (options.bus == "sim") {
    link.real_time = config.loop.real_time;
    link.simulated = std::make_unique<firmware::SimulatedArm>(config, placement);
    link.device = std::make_unique<sim::CanDevice>(link.simulated->plant(), layout, link.simulated->hardware(),
                                                   sim::CanScript{.hold_from_ns = kHoldFrom_ns, .faults = {}});
    for (int i = 0; i < layout.bus_count; ++i) {
      link.names.push_back(fmt::format("sim{}", i));
      link.buses.push_back(&link.device->bus(i));
    }
    return link;
  }
  if (layout.panel.bus < 0) {
    throw Failure(ExitCode::kBadConfig, fmt::format("{}: bus.panel_bus is missing; without a panel there is no "
                                                    "emergency stop, and only --bus sim may be driven",
                                                    config.device.name));
  }
  link.real_time = true;
  link.names = firmware::split_names(options.bus);
  link.interfaces = std::make_unique<firmware::CanBuses>(link.names, layout);
  link.buses = link.interfaces->buses();
  for (const std::string& line : link.interfaces->warnings()) warn(line);
  if (!(layout.drive_delay > 0.0)) {
    warn(
        "bus.drive_delay = 0: what the drives take to act on a torque is not in the delay that gains are checked with; "
        "take it from their manual");
  }
  return link;
}

/// Refuses a layout whose frames do not fit in a cycle, with the table.
hal::BusPlan require_bus_plan(const hal::BusLayout& layout) {
  const hal::BusPlan plan = hal::plan_buses(layout);
  if (plan.fits) return plan;
  fmt::print(stderr, "{}", firmware::bus_plan_table(layout, plan));
  throw Failure(ExitCode::kBadConfig, firmware::bus_plan_objection(layout, plan));
}

/// Says once, each time, what the operator is to do: that it waits for longer than a moment, and why it has stopped.
class OperatorNotice {
 public:
  void look() {
    const firmware::Standing standing = run_report.standing.load(std::memory_order_relaxed);
    const bool waits = run_report.waiting.load(std::memory_order_relaxed) > kMoment;
    if (waits && !said_waiting_) {
      warn(standing.mode == firmware::Mode::kIdle
               ? "waits for the enable switch: release it, then hold it"
               : "waits with the arm held: the moving body is in the still one, or leans on it; move the tool away");
    }
    said_waiting_ = waits;
    const bool stopped = standing.mode == firmware::Mode::kStopped && !refuses_to_start(standing.fault);
    if (stopped && !said_stopped_) {
      warn(fmt::format("stopped: {}; to go on, release enable switch and emergency stop, then kill -USR1 {}",
                       why(standing), ::getpid()));
    }
    said_stopped_ = stopped;
  }

  /// A few times a second, until it is asked to stop: the thread beside the loop.
  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      look();
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
  }

 private:
  static constexpr std::uint32_t kMoment = 3000;  // cycles
  bool said_waiting_ = false;
  bool said_stopped_ = false;

  static std::string why(const firmware::Standing& standing) {
    if (standing.fault != firmware::Fault::kAlarm) return describe(standing.fault);
    const std::string joint = standing.alarm_joint >= 0 ? fmt::format("joint {}: ", standing.alarm_joint + 1) : "";
    return joint + firmware::describe(standing.alarm);
  }
};

/// Files that are written beside the loop.
struct Records {
  std::unique_ptr<firmware::TelemetryWriter> telemetry;
  std::unique_ptr<firmware::BusLogWriter> buses;

  Records(const ControllerConfig& config, const std::vector<std::string>& names) {
    const std::filesystem::path& folder = config.telemetry.folder;
    if (folder.empty()) return;
    telemetry = std::make_unique<firmware::TelemetryWriter>(folder, config.device.model.joint_count, ring);
    if (config.telemetry.bus) buses = std::make_unique<firmware::BusLogWriter>(folder, names, bus_ring);
  }

  void drain() const {
    if (telemetry) telemetry->drain();
    if (buses) buses->drain();
  }

  void print() const {
    if (telemetry) {
      fmt::print("{}: {} rows, {} lost\n", telemetry->file().string(), telemetry->written(),
                 telemetry->lost() + ring.lost());
    }
    if (buses) {
      fmt::print("{}: {} frames, {} lost\n", buses->file().string(), buses->written(), buses->lost() + bus_ring.lost());
    }
  }
};

/// A real bus is driven with all rights that a real-time thread needs, a simulated one with what there is.
void set_up_thread(const ControllerConfig& config, bool simulated) {
  for (const std::string& missing :
       firmware::set_up_real_time({.cpu = config.loop.cpu, .priority = config.loop.priority})) {
    if (!simulated) throw Failure(ExitCode::kNoPermission, missing);
    warn(missing + "; going on, since the bus is simulated");
  }
}

/// False: a signal has ended the start.
bool start_nodes(hal::Clock& clock, const std::vector<std::string>& names) {
  const hal::BringUpResult result = drives->bring_up(clock, &requests.end);
  if (result.status == hal::BringUpStatus::kOk) return true;
  drives->stop_nodes();
  if (result.status == hal::BringUpStatus::kEnded) return false;
  throw Failure(ExitCode::kUnavailable, firmware::explain(result, names));
}

/// Whether each drive notices that its torques stay away, tried without power.
void commission(const Options& options) {
  ControllerConfig config = firmware::read_controller_file(options.controller);
  config.simulation.path.clear();
  const hal::BusLayout& layout = config.device.bus;
  const firmware::Placement placement = firmware::place(config.workspace, config.device, Vector3::Zero());
  const hal::BusPlan plan = require_bus_plan(layout);
  const ArmLink link = link_arm(options, config, placement);
  drives.emplace(layout, link.buses, plan.timing);
  catch_signals();
  if (link.real_time) set_up_thread(config, link.device != nullptr);
  const std::unique_ptr<hal::Clock> clock = link.make_clock();
  if (!start_nodes(*clock, link.names)) throw Failure(ExitCode::kUnavailable, "ended before the drives were started");
  std::vector<firmware::JointTrial> trials;
  try {
    trials = firmware::try_drives(*drives, layout, link.buses, *clock, link.names, requests.end);
  } catch (const Failure&) {
    drives->stop_nodes();
    throw;
  }
  drives->stop_nodes();
  fmt::print("{}", firmware::trial_table(layout, trials));
  const std::string objection = firmware::trial_objection(trials);
  if (!objection.empty()) throw Failure(ExitCode::kUnavailable, objection);
}

/// From the nodes' start to their stop.
void run_loop(const firmware::RunSetup& setup, const ControllerConfig& config, const ArmLink& link) {
  Records records(config, link.names);
  OperatorNotice notice;
  long faults_of_pages = 0;
  {
    std::vector<std::jthread> beside;  // before this thread is a real-time one, which they would become too
    const auto run_beside = [&beside](const char* name, auto& worker) {
      beside.push_back(firmware::start_worker(name, [&worker](const std::stop_token& stop) { worker.run(stop); }));
    };
    if (link.real_time) {
      run_beside("godobject-controller: notices for the operator", notice);
      if (records.telemetry) run_beside("godobject-controller: telemetry", *records.telemetry);
      if (records.buses) run_beside("godobject-controller: the log of the buses", *records.buses);
      set_up_thread(config, link.device != nullptr);
    }
    const std::unique_ptr<hal::Clock> clock = link.make_clock();
    if (!start_nodes(*clock, link.names)) return warn("ended before the drives were started; none was enabled");
    const long before = firmware::page_faults();
    if (link.real_time) {
      firmware::run_controller(setup, *clock, *cycle, requests, ring, run_report, [] {
        if (drives->statistics().round_trip_ns > 0) run_report.round_trip.add(drives->statistics().round_trip_ns);
      });
    } else {
      std::optional<HandLog> hand;
      if (records.telemetry) hand.emplace(config.telemetry.folder, *link.simulated);
      firmware::run_controller(setup, *clock, *cycle, requests, ring, run_report, [&] {
        notice.look();
        records.drain();
        if (hand) hand->write_row();
      });
      if (hand) hand->close();
    }
    faults_of_pages = firmware::page_faults() - before;
    drives->stop_nodes();
  }
  print_report(run_report, cycle->counters(), *drives, link.real_time, faults_of_pages);
  records.print();
}

/// What stopped the run, with its place; empty if nothing did.
std::string describe_stop(const std::vector<std::string>& names) {
  const firmware::Supervisor& supervisor = cycle->supervisor();
  if (supervisor.fault() == firmware::Fault::kNone) return "";
  if (supervisor.fault() == firmware::Fault::kAlarm) {
    return fmt::format("stopped: {}", firmware::explain(drives->alarm_detail(), names));
  }
  const std::string joint =
      supervisor.fault_joint() >= 0 ? fmt::format("joint {}: ", supervisor.fault_joint() + 1) : "";
  return fmt::format("stopped: {}{}", joint, describe(supervisor.fault()));
}

void control(const Options& options) {
  ControllerConfig config = firmware::read_controller_file(options.controller);
  if (!options.scene.empty()) config.scene.image = options.scene;
  if (!options.log.empty()) config.telemetry.folder = options.log;
  if (options.log_bus) config.telemetry.bus = true;
  if (config.telemetry.bus && config.telemetry.folder.empty()) {
    throw Failure(ExitCode::kUsage,
                  "what goes over the buses has no folder to be written to; give --log or telemetry.folder");
  }
  if (options.real_time) config.loop.real_time = true;
  if (config.scene.image.empty()) {
    throw Failure(ExitCode::kBadConfig,
                  fmt::format("{}: scene.image is missing; add it or give --scene", options.controller));
  }
  const firmware::SceneFile image(config.scene.image);
  Scene scene = image.scene();
  firmware::set_gains(config.gains, scene);
  const firmware::Placement placement = firmware::place(config.workspace, config.device, scene.H_MB.translation);
  const hal::BusPlan plan = require_bus_plan(config.device.bus);
  check_gains(config, scene, placement.device, plan.timing.delay_s);
  if (!config.start.sign_test) {
    warn("start.sign_test = false: a motor or encoder that is connected the wrong way round will not be found");
  }
  const ArmLink link = link_arm(options, config, placement);
  drives.emplace(config.device.bus, link.buses, plan.timing, config.telemetry.bus ? &bus_ring : nullptr);
  files::AlignedBytes memory(GodObject::memory_size(CompiledScene::of(scene)));
  const firmware::CycleSetup pipeline = cycle_setup(config, scene, placement, memory.span());
  cycle.emplace(pipeline, *drives);
  const Status status = cycle->start();
  if (status == Status::kNotInBuild) {
    command::require_in_build(config.scene.image.string(), scene, pipeline.solver, pipeline.friction);
  }
  if (status != Status::kOk) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: {}; compile it again without --only-solver and with a [friction] "
                              "table, or change scene.solver, scene.friction",
                              config.scene.image.string(), describe(status)));
  }
  std::optional<double> duration = options.duration;
  if (!duration && link.simulated && !config.simulation.path.empty()) {
    duration = config.simulation.begin + link.simulated->path_seconds() + 0.5;
  }
  hal::MonotonicClock stopwatch;
  firmware::RunSetup setup;
  setup.cycles = duration ? static_cast<std::uint64_t>(1e3 * *duration) : 0;
  setup.every = static_cast<std::uint32_t>(config.telemetry.every);
  setup.stopwatch = &stopwatch;
  setup.compute_ns = static_cast<std::int64_t>(1e9 * config.loop.compute);
  catch_signals();
  run_loop(setup, config, link);

  const std::string stop = describe_stop(link.names);
  if (stop.empty()) return;
  if (!requests.end) throw Failure(ExitCode::kUnavailable, stop);
  warn(stop);
}

void examine(const std::string& controller, const std::string& bus) {
  ControllerConfig config;
  if (!controller.empty()) config = firmware::read_controller_file(controller);
  const hal::BusLayout& layout = config.device.bus;
  std::vector<firmware::Finding> findings = firmware::examine_machine(config.loop.cpu, config.loop.priority);
  if (bus != "sim") {
    for (const firmware::Finding& finding : firmware::examine_can_interfaces(firmware::split_names(bus), layout)) {
      findings.push_back(finding);
    }
  }
  std::vector<std::string> missing;
  for (const firmware::Finding& finding : findings) {
    fmt::print("{} {}{}{}\n", finding.good ? "ok  " : "LACK", finding.what, finding.good ? "" : " -> ", finding.cure);
    if (!finding.good && finding.needed) missing.push_back(finding.what);
  }
  if (!controller.empty()) fmt::print("{}", firmware::bus_plan_table(layout, require_bus_plan(layout)));
  if (!missing.empty()) {
    throw Failure(ExitCode::kUnavailable,
                  fmt::format("no real-time work on this machine ({}); see the cures above", fmt::join(missing, "; ")));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("The haptic controller: from the drives' positions to their torques, once a millisecond.",
               "godobject-controller");
  app.footer(kFooter);
  Options options;
  std::string examined;
  auto* controller = app.add_option("CONTROLLER.toml", options.controller, "controller file")->type_name("");
  app.add_option("--scene", options.scene, "scene image, in place of scene.image")->type_name("X.scene");
  app.add_option("--bus", options.bus, "sim, or CAN interfaces such as can0,can1; default: sim")->type_name("BUS");
  app.add_option("--duration", options.duration,
                 "seconds after which it ends; default: with simulation.path half a second after it, else never")
      ->check(CLI::Range(0.001, 1e7))
      ->option_text("SECONDS");
  app.add_option("--log", options.log, "folder for the telemetry, in place of telemetry.folder")->type_name("DIR");
  app.add_flag("--real-time", options.real_time,
               "simulated bus: keep to the clock, on a real-time thread, as loop.real_time");
  app.add_flag("--log-bus", options.log_bus, "writes what goes over the buses to the same folder, as telemetry.bus");
  CLI::App* doctor =
      app.add_subcommand("doctor", "says what this machine lacks for real-time work, each with its cure");
  doctor->add_option("CONTROLLER.toml", examined, "controller file, for loop and buses")->type_name("");
  doctor->add_option("--bus", options.bus, "CAN interfaces to look at, such as can0,can1")->type_name("BUS");
  doctor->footer(kDoctorFooter);
  CLI::App* commissioning = app.add_subcommand(
      "commission",
      "tries, without power, whether each drive tells of its mode and notices that its torques stay away");
  commissioning->add_option("CONTROLLER.toml", options.controller, "controller file")->required()->type_name("");
  commissioning->add_option("--bus", options.bus, "sim, or CAN interfaces such as can0,can1; default: sim")
      ->type_name("BUS");
  commissioning->footer(kCommissionFooter);
  return command::run(app, argc, argv, [&] {
    if (commissioning->parsed()) return commission(options);
    if (doctor->parsed()) return examine(examined, options.bus);
    if (controller->count() == 0) throw CLI::RequiredError("CONTROLLER.toml");
    control(options);
  });
}
