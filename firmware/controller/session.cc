#include "firmware/controller/session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "firmware/controller/cycle_setup.h"
#include "firmware/controller/drive_choice.h"
#include "firmware/controller/operator_notice.h"
#include "firmware/controller/real_time_thread.h"
#include "firmware/controller/run_facts.h"
#include "firmware/controller/run_summary.h"
#include "firmware/controller/start_checks.h"
#include "firmware/controller/warning.h"
#include "firmware/controller/work_calibration.h"
#include "firmware/machine/rt_setup.h"
#include "firmware/machine/worker_thread.h"
#include "firmware/simulation/simulated_arm.h"
#include "hal/linux/monotonic_clock.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/command_line/in_build.h"

namespace godobject::firmware {
namespace {

using command::ExitCode;
using command::Failure;

/// Time of a cycle outside of the god object, chosen: kinematics, torques, checks and frames take some 5 us [s].
constexpr double kRestOfCycle = 10e-6;
/// Share of what loop.compute leaves that is the default budget, chosen: the rest is for the calls of the buses and for
/// cycles that take longer than those of the test motion.
constexpr double kDefaultShare = 0.7;
constexpr double kLeastBudget = 1e-6;  // by default, where loop.compute leaves less [s]

}  // namespace

Session::Session(const ControllerConfig& config, const std::string& transport)
    : config_(config),
      image_(config.scene.image),
      scene_(configured(image_.scene(), config)),
      placement_(place(config.workspace, config.device, scene_.H_MB.translation)) {
  const std::unique_ptr<DriveFamily> family = choose_drives(config_.device);
  family->require_plan();
  delay_ = family->delay();
  check_gains_at_start(config_, scene_, placement_.device, delay_);
  if (!config_.start.sign_test) {
    warn("start.sign_test = false: wrong polarities of motors and encoders will not be found");
  }
  link_ = family->connect({.transport = transport,
                           .config = &config_,
                           .placement = &placement_,
                           .tap = config_.telemetry.records_frames() ? &bus_ring_ : nullptr});
  for (const std::string& line : link_->warnings()) warn(line);
  start_cycle();
}

void Session::start_cycle() {
  memory_.emplace(GodObject::memory_size(Scene::of(scene_)));
  CycleSetup setup = cycle_setup(config_, scene_, placement_, memory_->span());
  setup.work_budget = work_budget(setup);
  cycle_.emplace(setup, link_->drives());
  const Status status = cycle_->start();
  if (status == Status::kNotInBuild) {
    command::require_in_build(config_.scene.image.string(), scene_, setup.solver, setup.friction);
  }
  if (status == Status::kNotInImage) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: {}; compile it again without --only-solver and with a [friction] "
                              "table, or change scene.solver or scene.friction",
                              config_.scene.image.string(), describe(status)));
  }
  if (status != Status::kOk) {
    throw Failure(ExitCode::kInternal,
                  fmt::format("{}: {}; please report this", config_.scene.image.string(), describe(status)));
  }
}

/// Returns the budget of work of a cycle for loop.cycle_budget [units]. In real time it is found on this machine. In
/// virtual time, where no cycle is late, a unit has its nominal cost and there is no default, so that each run is the
/// same.
std::uint64_t Session::work_budget(const CycleSetup& setup) const {
  const std::optional<double>& wanted = config_.loop.cycle_budget;
  const bool has_budget = wanted ? *wanted > 0.0 : link_->real_time();
  if (!has_budget) return GodObject::kNoBudget;
  if (setup.solver != Solver::kContact) {
    if (wanted) warn("loop.cycle_budget has no effect: only the solver contact has a budget of work");
    return GodObject::kNoBudget;
  }
  const double most = config_.loop.compute - kRestOfCycle;
  const double seconds = wanted.value_or(std::max(kLeastBudget, kDefaultShare * most));
  if (wanted && seconds > most + 1e-9) {
    throw Failure(
        ExitCode::kBadConfig,
        fmt::format("loop.cycle_budget = {:g} exceeds loop.compute = {:g} less {:g} s for the rest of a cycle: "
                    "set it to at most {:g}, or raise loop.compute",
                    seconds, config_.loop.compute, kRestOfCycle, std::max(0.0, most)));
  }
  if (link_->real_time()) return measured_budget(setup, seconds);
  return static_cast<std::uint64_t>(std::max(1.0, seconds / kNominalUnit));
}

/// Finds the budget on a motion through the scene. Warns if it cannot bound the time, or if the god object then lags
/// for good. A budget of the controller file that cannot bound the time is refused.
std::uint64_t Session::measured_budget(const CycleSetup& setup, double seconds) const {
  hal::MonotonicClock clock;
  const std::vector<Pose> path = calibration_path(scene_, config_.workspace.start);
  const WorkBudget found = find_budget(scene_, setup.friction, path, setup.memory, seconds, clock);
  if (found.with.cycles == 0) return GodObject::kNoBudget;  // the cycle's own start tells why
  fmt::print("{}\n", describe(found, seconds));
  const std::string too_long = too_long_for(found, seconds);
  if (!too_long.empty() && config_.loop.cycle_budget) throw Failure(ExitCode::kUnavailable, too_long);
  if (!too_long.empty()) warn(too_long);
  const std::string too_little =
      too_little_for(distance_left(scene_, setup.friction, path, setup.memory, found.units), seconds);
  if (!too_little.empty()) warn(too_little);
  return found.units;
}

std::string Session::run(const std::optional<double>& duration, RunRequests& requests) {
  hal::MonotonicClock stopwatch;
  RunRecords records(records_setup(), ring_, bus_ring_);
  if (run_loop(run_setup(duration, stopwatch), requests, records)) {
    fmt::print("{}",
               run_summary(report_, cycle_->counters(), config_.device.bus.period, link_->statistics(), page_faults_));
    records.write_words(describe_stop());
    fmt::print("{}", records.summary());
    if (link_->real_time() && report_.beyond_plan > 0) {
      warn(fmt::format(
          "{} cycles computed for longer than loop.compute, which bus plan and gain check count on: {:.0f} us in place "
          "of {:.0f} us at most; raise it, set or lower loop.cycle_budget, or run godobject-controller doctor",
          report_.beyond_plan, 1e-3 * static_cast<double>(report_.computing.largest_ns()), 1e6 * config_.loop.compute));
    }
  } else {
    warn("ended before the drives were started; no drive was enabled");
  }
  return describe_stop();
}

RunRecords::Setup Session::records_setup() const {
  const auto now = std::chrono::system_clock::now();
  const ControllerConfig::Telemetry& telemetry = config_.telemetry;
  return {.folder = telemetry.folder,
          .incidents = telemetry.incidents,
          .needs_incidents = telemetry.needs_incidents,
          .start = now,
          .format = {config_.device.model.joint_count, config_.workspace.turn},
          .period = config_.device.bus.period,
          .every = static_cast<std::uint32_t>(telemetry.every),
          .buses = telemetry.bus,
          .bus_names = link_->bus_names(),
          .hand = !link_->real_time(),
          .facts = run_facts(config_, image_, run_name(now), link_->bus_names()),
          .say = warn};
}

RunSetup Session::run_setup(const std::optional<double>& duration, hal::Clock& stopwatch) const {
  std::optional<double> seconds = duration;
  const SimulatedArm* simulated = link_->simulated_arm();
  if (!seconds && simulated != nullptr && !config_.simulation.path.empty()) {
    seconds = config_.simulation.begin + simulated->path_seconds() + 0.5;
  }
  RunSetup setup;
  const double period = config_.device.bus.period;
  setup.period_ns = std::llround(1e9 * period);
  setup.cycles = seconds ? static_cast<std::uint64_t>(*seconds / period + 1e-6) : 0;
  setup.stopwatch = &stopwatch;
  setup.compute_ns = std::llround(1e9 * config_.loop.compute);
  return setup;
}

/// From the start of the drives to their stop. False: the run was asked to end before the drives were started.
bool Session::run_loop(const RunSetup& setup, RunRequests& requests, RunRecords& records) {
  OperatorNotice notice(report_, config_.device.bus.period);
  std::vector<std::jthread> beside;  // started before this thread is a real-time one: threads inherit that
  const auto run_beside = [&beside](const char* name, auto& worker) {
    beside.push_back(start_worker(name, [&worker](const std::stop_token& stop) { worker.run(stop); }));
  };
  if (link_->real_time()) {
    run_beside("godobject-controller: notices for the operator", notice);
    if (records.any()) run_beside("godobject-controller: the records", records);
    set_up_loop_thread(config_.loop, link_->simulated_arm() != nullptr);
  }
  const std::unique_ptr<hal::Clock> clock = link_->make_clock();
  if (!link_->start(*clock, requests.end)) return false;
  if (link_->real_time()) {
    const long before = page_faults();
    const std::int64_t& round_trip_ns = link_->round_trip_ns();
    run_controller(setup, *clock, *cycle_, requests, ring_, report_, [&] {
      if (round_trip_ns > 0) report_.round_trip.add(round_trip_ns);
    });
    page_faults_ = page_faults() - before;
  } else {
    run_in_virtual_time(setup, *clock, requests, records, notice);
  }
  link_->stop();
  return true;
}

/// Notices and logs in the same thread, so that a run in virtual time is the same each time.
void Session::run_in_virtual_time(const RunSetup& setup, hal::Clock& clock, RunRequests& requests, RunRecords& records,
                                  OperatorNotice& notice) {
  HandLog* const hand = records.hand();
  const SimulatedArm* arm = link_->simulated_arm();
  run_controller(setup, clock, *cycle_, requests, ring_, report_, [&] {
    notice.look();
    records.drain();
    if (hand != nullptr) hand->write_row(arm->now_ns(), arm->hand_work());
  });
  if (hand != nullptr) hand->close();
}

std::string Session::describe_stop() const {
  const Supervisor& supervisor = cycle_->supervisor();
  if (supervisor.fault() == Fault::kNone) return "";
  if (supervisor.fault() == Fault::kAlarm) return fmt::format("stopped: {}", link_->alarm());
  const std::string joint =
      supervisor.fault_joint() >= 0 ? fmt::format("joint {}: ", supervisor.fault_joint() + 1) : "";
  return fmt::format("stopped: {}{}", joint, describe(supervisor.fault()));
}

}  // namespace godobject::firmware
