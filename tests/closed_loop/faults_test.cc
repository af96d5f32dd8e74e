// The table of faults, without a wire. Each fault is injected into the simulated device while the ball is pressed on a
// plate and moved along it. The tests count the cycles of the reaction at the device and record both for the report.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tests/closed_loop/seen_fault.h"
#include "tests/closed_loop/simulated_run.h"

namespace godobject::firmware {
namespace {

using sim::DriveFault;
using sim::FaultKind;

constexpr std::int64_t kBegin = 1200;  ///< cycle of the fault
constexpr std::int64_t kEnd = 2600;

/// Returns a path that goes down to the plate, 20 mm into it, and along the plate in circles.
std::vector<Vector3> press_and_rub() {
  std::vector<Waypoint> waypoints{{0.0, {0.0, 0.0, 0.06}}, {0.4, {0.0, 0.0, 0.01}}};
  std::vector<Vector3> path = path_through(waypoints);
  for (int k = 0; k < 2500; ++k) {
    const double angle = 2.0 * M_PI * k / 1200.0;
    path.push_back({0.02 * std::sin(angle), 0.02 - 0.02 * std::cos(angle), 0.01});
  }
  return path;
}

SimulatedRun::Options pressing() {
  SimulatedRun::Options options;
  options.path = press_and_rub();
  return options;
}

double force_before(const SimulatedRun& run) {
  for (const SimulatedCycle& cycle : run.cycles) {
    if (cycle.number == kBegin - 1) return cycle.record.F_G_R.force.norm();
  }
  return 0.0;
}

/// Largest torque on a joint beyond gravity, in share of its limit, once `cycles` have passed since the fault and the
/// drives' delay, until they begin to stop by themselves.
double pushed_after(const SimulatedRun& run, int cycles) {
  double largest = 0.0;
  for (const SimulatedCycle& cycle : run.cycles) {
    if (cycle.number < kBegin + cycles + 1 || cycle.number > kBegin + cycles + 2) continue;
    for (int i = 0; i < 7; ++i) {
      const double limit = run.device().model.joints[static_cast<std::size_t>(i)].torque;
      largest = std::max(largest, std::fabs(cycle.pushed[i]) / limit);
    }
  }
  return largest;
}

/// For the report: what the run shows since `begin`, until it is asked to end in cycle `end`.
void record_stop(SimulatedRun& run, std::int64_t begin, std::int64_t end = kEnd) {
  test::SeenFault seen = seen_since(run.cycles, begin, end);
  seen.after += "; " + rest_of(
                           7, [&](int i) -> auto& { return run.drives().joint(i); });
  test::record(seen);
}

void record_going_on(const SimulatedRun& run) {
  const CycleCounters& counters = run.controller().counters();
  test::SeenFault seen = seen_since(run.cycles, kBegin, kEnd);
  const auto add = [&](const char* what, std::uint64_t count) {
    if (count > 0) seen.found += (seen.found.empty() ? "" : ", ") + std::string(what) + ' ' + std::to_string(count);
  };
  add("positions lost in cycles:", counters.lost);
  add("jumps", counters.jumps);
  add("sends failed", counters.sends_failed);
  add("overruns", counters.overruns);
  add("periods skipped", counters.skipped);
  if (seen.found.empty()) seen.found = "nothing to count";
  test::record(seen);
}

struct Row {
  std::string name;
  DriveFault what;
  std::set<Fault> faults;  ///< any of them
  int most;                ///< cycles, of the table
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

class ClosedLoopFault : public testing::TestWithParam<Row> {};

TEST_P(ClosedLoopFault, StopsInTime) {
  const Row& row = GetParam();
  SimulatedRun::Options options = pressing();
  options.faults = {row.what};
  SimulatedRun run(plate(), options);
  run.run(kEnd);
  ASSERT_GT(force_before(run), 2.0) << "the fault is to meet a contact";
  const int cycles = run.cycles_to_stop(kBegin);
  EXPECT_GT(cycles, 0) << "never";
  EXPECT_LE(cycles, row.most);
  EXPECT_TRUE(row.faults.contains(run.controller().record().fault)) << describe(run.controller().record().fault);
  EXPECT_EQ(run.violation(), "");
  // a torque step of the drive is a permille
  EXPECT_LT(pushed_after(run, cycles), 0.002) << "the arm is held, nothing is rendered";
  for (const SimulatedCycle& cycle : run.cycles) {
    if (cycle.number >= kBegin + cycles) {
      ASSERT_EQ(cycle.record.share, 0.0) << cycle.number;
    }
  }
  const Mode mode = run.cycles.back().record.mode;
  EXPECT_TRUE(mode == Mode::kEnded || mode == Mode::kStopped);
  EXPECT_TRUE(run.plant().velocities().isZero(1e-6)) << "the brakes hold";
  record_stop(run, kBegin);
  std::printf("%-34s %3d cycles of %d\n", row.name.c_str(), cycles, row.most);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, ClosedLoopFault,
    testing::Values(
        Row{"position_lost", {FaultKind::kReadingLost, 2, kBegin, 10'000}, {Fault::kPositionLost}, 8},
        Row{"all_positions_lost",
            {FaultKind::kReadingLost, sim::kAllJoints, kBegin, 10'000},
            {Fault::kPositionLost},
            8},
        Row{"position_lost_three_times", {FaultKind::kReadingLost, 5, kBegin, 3}, {Fault::kPositionLost}, 8},
        Row{"position_always_late", {FaultKind::kReadingLate, 1, kBegin, 10'000, 1.0}, {Fault::kPositionLost}, 8},
        Row{"position_two_cycles_late", {FaultKind::kReadingLate, 1, kBegin, 10'000, 2.0}, {Fault::kPositionLost}, 8},
        Row{"encoder_jumps_twice", {FaultKind::kEncoderJump, 3, kBegin, 2, 0.01}, {Fault::kPositionJump}, 3},
        Row{"encoder_jumps_for_good", {FaultKind::kEncoderJump, 6, kBegin, 10'000, -0.5}, {Fault::kPositionJump}, 3},
        Row{"encoder_not_finite", {FaultKind::kEncoderNotFinite, 0, kBegin, 1}, {Fault::kNotFinite}, 1},
        Row{"encoder_stuck_base", {FaultKind::kEncoderStuck, 0, kBegin, 10'000}, {Fault::kEncoderStuck}, 100},
        Row{"encoder_stuck_shoulder", {FaultKind::kEncoderStuck, 1, kBegin, 10'000}, {Fault::kEncoderStuck}, 100},
        Row{"encoder_stuck_upper_arm", {FaultKind::kEncoderStuck, 2, kBegin, 10'000}, {Fault::kEncoderStuck}, 100},
        Row{"encoder_stuck_elbow", {FaultKind::kEncoderStuck, 3, kBegin, 10'000}, {Fault::kEncoderStuck}, 100},
        Row{"encoder_stuck_forearm", {FaultKind::kEncoderStuck, 4, kBegin, 10'000}, {Fault::kEncoderStuck}, 100},
        Row{"encoder_stuck_flange", {FaultKind::kEncoderStuck, 6, kBegin, 10'000}, {Fault::kEncoderStuck}, 100},
        Row{"encoder_stuck_wrist", {FaultKind::kEncoderStuck, 5, kBegin, 10'000}, {Fault::kEncoderStuck}, 100},
        Row{"drive_trips", {FaultKind::kDriveTrips, 4, kBegin, 1}, {Fault::kDriveLeft}, 2},
        Row{"drive_goes_off", {FaultKind::kDriveDisabled, 1, kBegin, 1}, {Fault::kDriveLeft}, 2},
        Row{"supply_of_a_drive_lost", {FaultKind::kSupplyLost, 3, kBegin, 10'000}, {Fault::kDriveLeft}, 2},
        Row{"sending_fails", {FaultKind::kSendFails, 0, kBegin, 10'000}, {Fault::kSendFailed, Fault::kDriveLeft}, 4},
        // the drive goes without commands for longer than its 4 ms and trips
        Row{"commands_lost_silently", {FaultKind::kCommandLost, 2, kBegin, 10'000}, {Fault::kDriveLeft}, 4 + 2 + 2},
        Row{"emergency_stop", {FaultKind::kEmergencyStop, sim::kAllJoints, kBegin, 1}, {Fault::kEmergencyStop}, 2},
        Row{"enable_switch_released",
            {FaultKind::kEnableReleased, sim::kAllJoints, kBegin, 1},
            {Fault::kEnableReleased},
            2}),
    [](const testing::TestParamInfo<Row>& row) { return row.param.name; });

class ClosedLoopNuisance : public testing::TestWithParam<Row> {};

TEST_P(ClosedLoopNuisance, IsGoneOnWith) {
  SimulatedRun::Options options = pressing();
  constexpr int kTimes = 10;  // within a second: so many jumps are tolerated
  for (int i = 0; i < kTimes; ++i) {
    DriveFault fault = GetParam().what;
    fault.first_cycle = kBegin + 97 * i;
    options.faults.push_back(fault);
  }
  SimulatedRun run(plate(), options);
  run.run(kEnd);
  EXPECT_EQ(run.controller().record().fault, Fault::kNone) << describe(run.controller().record().fault);
  EXPECT_EQ(run.cycles_to_stop(kBegin), kEnd - kBegin + Supervisor::kEndRamp_ms);
  EXPECT_EQ(run.violation(), "");
  EXPECT_EQ(
      run.controller().counters().lost + run.controller().counters().jumps + run.controller().counters().sends_failed,
      static_cast<unsigned>(kTimes * GetParam().what.cycles));
  SimulatedRun plain(plate(), pressing());
  plain.run(kEnd);
  EXPECT_LT(run.report.largest_force, 1.05 * plain.report.largest_force + 0.5);
  record_going_on(run);
}

INSTANTIATE_TEST_SUITE_P(Rows, ClosedLoopNuisance,
                         testing::Values(Row{"position_lost_once", {FaultKind::kReadingLost, 2, 0, 1}, {}, 0},
                                         Row{"position_lost_twice", {FaultKind::kReadingLost, 4, 0, 2}, {}, 0},
                                         Row{"position_late_once", {FaultKind::kReadingLate, 4, 0, 1, 1.0}, {}, 0},
                                         Row{"encoder_jumps_once", {FaultKind::kEncoderJump, 1, 0, 1, 0.05}, {}, 0},
                                         Row{"sending_fails_twice", {FaultKind::kSendFails, 3, 0, 2}, {}, 0}),
                         [](const testing::TestParamInfo<Row>& row) { return row.param.name; });

TEST(ClosedLoop, StopsWhenAnEncoderJumpsMoreThanTenTimesASecond) {
  SimulatedRun::Options options = pressing();
  for (int i = 0; i < 11; ++i) options.faults.push_back({FaultKind::kEncoderJump, 1, kBegin + 80 * i, 1, 0.05});
  SimulatedRun run(plate(), options);
  run.run(kEnd);
  EXPECT_EQ(run.controller().record().fault, Fault::kPositionJump);
  EXPECT_EQ(run.cycles_to_stop(kBegin + 800), 1);
  EXPECT_EQ(run.violation(), "");
  record_stop(run, kBegin + 800);
}

/// Neither three losses nor two jumps in a row: what matters is that for three cycles nothing could be used.
TEST(ClosedLoop, StopsWhenLossesAndJumpsTakeTurns) {
  SimulatedRun::Options options = pressing();
  options.faults = {{FaultKind::kReadingLost, 1, kBegin, 2}, {FaultKind::kEncoderJump, 1, kBegin + 2, 1, 0.05}};
  SimulatedRun run(plate(), options);
  run.run(kEnd);
  EXPECT_EQ(run.controller().record().fault, Fault::kPositionLost);
  EXPECT_LE(run.cycles_to_stop(kBegin), 8);
  EXPECT_EQ(run.violation(), "");
  record_stop(run, kBegin);
}

TEST(ClosedLoop, PowersNothingForAnEnableSwitchThatIsHeldFromTheStart) {
  SimulatedRun::Options options;
  options.path = {{0.0, 0.0, 0.06}};
  options.timing.enable_ns = 0;
  SimulatedRun run(plate(), options);
  run.run(3000);
  EXPECT_EQ(run.report.rendering, 0u);
  for (const SimulatedCycle& cycle : run.cycles) {
    ASSERT_TRUE(cycle.record.torque.isZero(0.0)) << cycle.number;
    ASSERT_LE(cycle.record.mode == Mode::kEnded ? Mode::kIdle : cycle.record.mode, Mode::kIdle) << cycle.number;
  }
  EXPECT_EQ(run.cycles[2990].record.mode, Mode::kIdle);
}

/// The record of what is felt follows the torque that still flows.
TEST(ClosedLoop, TellsWhatIsFeltWhileItFades) {
  SimulatedRun::Options options = pressing();
  options.faults = {{FaultKind::kReadingLost, 2, kBegin, 10'000}};
  SimulatedRun run(plate(), options);
  run.run(kBegin + 20);
  double before = 0.0;
  int fading = 0;
  for (const SimulatedCycle& cycle : run.cycles) {
    if (cycle.record.mode == Mode::kFade) {
      ++fading;
      EXPECT_NEAR(cycle.record.F_G_R.force.norm(), cycle.record.share * before, 1e-9) << cycle.number;
    } else if (cycle.record.mode == Mode::kRunning) {
      before = cycle.record.F_G_R.force.norm();
    }
  }
  EXPECT_EQ(fading, 5);
  EXPECT_GT(before, 2.0);
}

TEST(ClosedLoop, DoesNotFeelACounterThatWraps) {
  SimulatedRun::Options options = pressing();
  SimulatedRun plain(plate(), options);
  plain.run(1500);
  options.counter_at_zero = 2'147'483'647 - 83'000;  // wraps at 0.5 rad, which a joint passes
  SimulatedRun wrapped(plate(), options);
  wrapped.run(1500);
  ASSERT_EQ(plain.cycles.size(), wrapped.cycles.size());
  for (std::size_t i = 0; i < plain.cycles.size(); ++i) {
    ASSERT_EQ(plain.cycles[i].record.torque, wrapped.cycles[i].record.torque) << i;
  }
  test::SeenFault seen = seen_since(wrapped.cycles, kBegin, 1500);
  seen.found = "torques of every cycle as without";
  test::record(seen);
}

/// Wakes that are late by `late_ns` in every `every`-th cycle from kBegin on.
std::vector<sim::LateWake> late_wakes(int count, int every, std::int64_t late_ns) {
  std::vector<sim::LateWake> late;
  for (int i = 0; i < count; ++i) late.push_back({(kBegin + i * every) * 1'000'000, late_ns});
  return late;
}

/// Cycles that compute for `took_ns`, every `every`-th from kBegin on.
std::vector<SlowCycle> slow_cycles(int count, int every, std::int64_t took_ns) {
  std::vector<SlowCycle> slow;
  for (int i = 0; i < count; ++i) slow.push_back({kBegin + i * every, took_ns});
  return slow;
}

TEST(ClosedLoop, SkipsAPeriodWhenItOverrunsOnceAndGoesOn) {
  SimulatedRun::Options options = pressing();
  options.late = late_wakes(1, 1, 1'400'000);
  SimulatedRun run(plate(), options);
  run.run(kEnd);
  EXPECT_EQ(run.controller().record().fault, Fault::kNone);
  EXPECT_EQ(run.controller().counters().overruns, 1u);
  EXPECT_EQ(run.controller().counters().skipped, 1u);
  EXPECT_EQ(run.report.loop.lateness.largest_ns(), 1'400'000);
  for (std::size_t i = 1; i < run.cycles.size(); ++i) {  // no burst: never two cycles in a period
    EXPECT_GE(run.cycles[i].number - run.cycles[i - 1].number, 1);
  }
  EXPECT_EQ(run.violation(), "");
  record_going_on(run);
}

/// Two in a row and ten in a second are allowed, and so is any number of cycles that take as long as planned.
TEST(ClosedLoop, GoesOnWhenFewCyclesComputeForLongerThanPlanned) {
  SimulatedRun::Options options = pressing();
  for (int i = 0; i < 100; ++i) {
    options.slow.push_back({kBegin + i, i % 10 < 1 || i == 1 ? 400'000 : SimulatedRun::kCompute_ns});
  }
  options.slow.erase(options.slow.end() - 10);  // the eleventh
  SimulatedRun run(plate(), options);
  run.run(kEnd);
  EXPECT_EQ(run.controller().record().fault, Fault::kNone);
  EXPECT_EQ(run.controller().counters().overruns, 0u);
  EXPECT_EQ(run.report.loop.compute.largest_ns(), 400'000);
  EXPECT_EQ(run.violation(), "");
  record_going_on(run);
}

struct Overruns {
  std::string name;
  std::vector<sim::LateWake> late;
  std::int64_t cause;  ///< cycle in which the table's condition is met first
  std::int64_t command_deadline_ns = 4'000'000;
  Fault fault = Fault::kOverruns;
  std::vector<SlowCycle> slow = {};
};

void PrintTo(const Overruns& row, std::ostream* out) { *out << row.name; }

class ClosedLoopOverruns : public testing::TestWithParam<Overruns> {};

TEST_P(ClosedLoopOverruns, StopTheArm) {
  SimulatedRun::Options options = pressing();
  options.late = GetParam().late;
  options.slow = GetParam().slow;
  options.command_deadline_ns = GetParam().command_deadline_ns;
  SimulatedRun run(plate(), options);
  run.run(kEnd);
  EXPECT_EQ(run.controller().record().fault, GetParam().fault) << describe(run.controller().record().fault);
  const int cycles = run.cycles_to_stop(GetParam().cause);
  EXPECT_GT(cycles, 0);
  EXPECT_LE(cycles, 8);
  EXPECT_EQ(run.violation(), "");
  record_stop(run, GetParam().cause);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, ClosedLoopOverruns,
    testing::Values(Overruns{"three_in_a_row", late_wakes(3, 2, 1'200'000), kBegin + 4},
                    Overruns{"more_than_one_in_a_hundred", late_wakes(11, 50, 1'200'000), kBegin + 500},
                    Overruns{"one_of_more_than_5_ms", late_wakes(1, 1, 6'200'000), kBegin, 20'000'000},
                    // a drive that hears nothing for longer than 4 ms trips by itself
                    Overruns{"one_that_trips_the_drives", late_wakes(1, 1, 6'200'000), kBegin, 4'000'000,
                             Fault::kDriveLeft},
                    Overruns{"three_in_a_row_computed_late",
                             {},
                             kBegin + 2,
                             4'000'000,
                             Fault::kComputedLate,
                             slow_cycles(3, 1, SimulatedRun::kCompute_ns + 1)},
                    Overruns{"more_than_one_in_a_hundred_computed_late",
                             {},
                             kBegin + 500,
                             4'000'000,
                             Fault::kComputedLate,
                             slow_cycles(11, 50, 900'000)},
                    Overruns{"one_computed_late_by_more_than_5_ms",
                             {},
                             kBegin,
                             20'000'000,
                             Fault::kComputedLate,
                             slow_cycles(1, 1, SimulatedRun::kCompute_ns + 5'000'001)}),
    [](const testing::TestParamInfo<Overruns>& row) { return row.param.name; });

TEST(ClosedLoop, StopsAHandThatIsTooFast) {
  SimulatedRun::Options options;
  const std::vector<Waypoint> dash{{0.0, {0.0, 0.0, 0.06}}, {0.3, {0.0, 0.0, 0.06}}, {0.4, {-0.25, 0.0, 0.06}}};
  options.path = path_through(dash);
  SimulatedRun run(plate(), options);
  run.run(2000);
  EXPECT_EQ(run.controller().record().fault, Fault::kTooFast);
  // from the cycle in which a joint or the hand is first seen beyond its stop
  const ArmModel& arm = run.device().model;
  std::int64_t cause = -1;
  for (const SimulatedCycle& cycle : run.cycles) {
    bool fast = false;
    for (int i = 0; i < 7; ++i) {
      fast = fast || std::fabs(cycle.record.qd[i]) > arm.joints[static_cast<std::size_t>(i)].velocity;
    }
    if (fast && cause < 0 && cycle.record.mode >= Mode::kArmed) cause = cycle.number;
  }
  ASSERT_GT(cause, 0);
  const int cycles = run.cycles_to_stop(cause);
  EXPECT_GT(cycles, 0);
  EXPECT_LE(cycles, 5);
  EXPECT_EQ(run.violation(), "");
  record_stop(run, cause);
}

TEST(ClosedLoop, StopsAHandThatIsTooFastThoughNoJointIs) {
  SimulatedRun::Options options;
  const std::vector<Waypoint> dash{{0.0, {0.0, 0.0, 0.06}}, {0.3, {0.0, 0.0, 0.06}}, {0.8, {-0.15, 0.0, 0.06}}};
  options.path = path_through(dash);
  options.hand.force = 2.0;  // of damping: the hand overcomes it
  options.hand.speed = 0.2;
  options.hand.speed_stop = 0.3;
  SimulatedRun run(plate(), options);
  run.run(2000);
  EXPECT_EQ(run.controller().record().fault, Fault::kTooFast);
  EXPECT_GT(run.controller().counters().slowed, 0u) << "damped first";
  const ArmModel& arm = run.device().model;
  Vector3 last = run.cycles.front().tool_R;
  std::int64_t cause = -1;
  for (const SimulatedCycle& cycle : run.cycles) {
    if (cause < 0 && (cycle.tool_R - last).norm() > 1e-3 * options.hand.speed_stop) cause = cycle.number;
    last = cycle.tool_R;
    for (int i = 0; i < 7; ++i) {
      ASSERT_LT(std::fabs(cycle.record.qd[i]), 0.8 * arm.joints[static_cast<std::size_t>(i)].velocity) << cycle.number;
    }
  }
  ASSERT_GT(cause, 0);
  const int cycles = run.cycles_to_stop(cause);
  EXPECT_GT(cycles, 0);
  EXPECT_LE(cycles, 5);
  EXPECT_EQ(run.violation(), "");
  record_stop(run, cause);
}

TEST(ClosedLoop, EndsWithARampAndBrakesWhenAskedTo) {
  SimulatedRun run(plate(), pressing());
  run.run(kBegin);  // asked to end there, as by SIGTERM
  const SimulatedCycle& last = run.cycles.back();
  EXPECT_EQ(last.record.mode, Mode::kEnded);
  EXPECT_EQ(last.record.fault, Fault::kNone);
  EXPECT_LE(last.number - kBegin, 200);
  Vector3 begun = Vector3::Zero();
  double sag = 0.0;
  for (const SimulatedCycle& cycle : run.cycles) {
    if (cycle.record.mode == Mode::kStopping && begun.isZero()) begun = cycle.tool_R;
    if (!begun.isZero()) sag = std::max(sag, (cycle.tool_R - begun).norm());
  }
  EXPECT_LT(sag, 0.005);
  EXPECT_EQ(run.violation(), "");
  test::SeenFault seen = seen_since(run.cycles, kBegin);
  seen.cycles = static_cast<int>(last.number - kBegin);
  run.drives().advance_to(run.drives().now_ns() + 200'000'000);  // of quick stops that it leaves to the drives
  char text[64];
  std::snprintf(text, sizeof(text), "arm sags by %.2f mm", 1e3 * sag);
  seen.after += "; " +
                rest_of(
                    7, [&](int i) -> auto& { return run.drives().joint(i); }) +
                ", " + text;
  test::record(seen);
}

TEST(ClosedLoop, FindsAnEncoderThatStandsStillBeforeItRenders) {
  SimulatedRun::Options options;
  options.path = {{0.0, 0.0, 0.06}};
  options.sign_test = true;
  SimulatedRun good(plate(), options);
  good.run(9000);
  EXPECT_EQ(good.controller().record().fault, Fault::kNone) << describe(good.controller().record().fault);
  EXPECT_GT(good.report.rendering, 1000u);
  EXPECT_EQ(good.violation(), "");

  options.faults = {{FaultKind::kEncoderStuck, 3, 0, 100'000}};
  SimulatedRun stuck(plate(), options);
  stuck.run(30'000);
  const Fault found = stuck.controller().record().fault;
  EXPECT_TRUE(found == Fault::kSignUndecided || found == Fault::kEncoderStuck) << describe(found);
  EXPECT_TRUE(found != Fault::kSignUndecided || stuck.controller().supervisor().fault_joint() == 3);
  EXPECT_EQ(stuck.report.rendering, 0u);
}

TEST(ClosedLoop, FindsAMotorThatIsConnectedTheWrongWayRoundBeforeItRenders) {
  for (int joint = 0; joint < 7; ++joint) {
    SimulatedRun::Options options;
    options.path = {{0.0, 0.0, 0.06}};
    options.sign_test = true;
    options.reversed_joint = joint;
    SimulatedRun run(plate(), options);
    run.run(12'000);
    EXPECT_EQ(run.controller().record().fault, Fault::kSignWrong)
        << joint << ": " << describe(run.controller().record().fault);
    // where the arm falls the test has not come to that joint
    const int found = run.controller().supervisor().fault_joint();
    EXPECT_TRUE(found == joint || found == -1) << found;
    EXPECT_EQ(run.report.rendering, 0u);
    const JointVector moved = run.cycles.back().record.q - run.cycles.front().record.q;
    EXPECT_LT(moved.cwiseAbs().maxCoeff(), 0.2) << joint;
    std::printf("joint %d the wrong way round: found in cycle %lld, moved %.3f rad\n", joint,
                static_cast<long long>(run.cycles.back().number), moved.cwiseAbs().maxCoeff());
  }
}

}  // namespace
}  // namespace godobject::firmware
