// The whole controller over simulated buses at other periods than 1 ms: it renders a wall, notices losses in time, and
// its drives stop by themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/cycle/cycles_in.h"
#include "tests/closed_loop/can_run.h"

namespace godobject::firmware {
namespace {

using hal::Alarm;

struct Rate {
  double period;     ///< [s]
  double stiffness;  ///< of the wall: stable with a margin [N/m]
};

class Rates : public testing::TestWithParam<Rate> {
 protected:
  /// The ball goes down to the plate, 20 mm into it, and rests there. The test begins 3 s after the start.
  static CanRun::Options pressing() {
    const std::vector<Waypoint> waypoints{{0.0, {0.0, 0.0, 0.06}}, {0.4, {0.0, 0.0, 0.01}}};
    CanRun::Options options;
    options.path = path_through(waypoints);
    options.period = GetParam().period;
    options.stiffness = GetParam().stiffness;
    return options;
  }

  static std::int64_t number_at(double seconds) { return std::llround(seconds / GetParam().period); }

  static void start(CanRun& run) {
    const hal::BringUpResult result = run.bring_up();
    ASSERT_EQ(result.status, hal::BringUpStatus::kOk) << describe(result.status) << ' ' << result.node;
    run.run(number_at(kBegin) - static_cast<std::int64_t>(1e-9 * static_cast<double>(run.device().now_ns()) / GetParam().period) - 1);
    ASSERT_EQ(run.cycles.back().record.fault, Fault::kNone) << describe(run.cycles.back().record.fault);
    ASSERT_EQ(run.cycles.back().record.mode, Mode::kRunning);
    ASSERT_GT(run.cycles.back().record.F_G_R.force.norm(), 2.0) << "in contact";
    ASSERT_EQ(run.controller().counters().lost, 0u);
  }

  static sim::BusFault fault(sim::BusFaultKind kind, int bus, double seconds) {
    sim::BusFault fault;
    fault.kind = kind;
    fault.bus = bus;
    fault.first_cycle = number_at(kBegin);
    fault.cycles = number_at(seconds);
    return fault;
  }

  /// Seconds from the fault to the first cycle without rendering.
  static double seconds_to_stop(const CanRun& run) {
    const int cycles = run.cycles_to_stop(number_at(kBegin));
    return cycles > 0 ? cycles * GetParam().period : HUGE_VAL;
  }

  static void expect_at_rest(CanRun& run) {
    for (int i = 0; i < run.layout().joint_count; ++i) {
      EXPECT_EQ(run.device().nodes().drive(i).motor_torque(), 0.0) << i;
      EXPECT_GT(run.device().nodes().drive(i).brake_torque(), 0.0) << i;
    }
  }

  static constexpr double kBegin = 4.0;  // [s]
};

/// The hand has come to rest: the force is the wall's, without a swing.
TEST_P(Rates, RenderAWall) {
  CanRun run(plate(), pressing());
  start(run);
  run.run(number_at(2.0));
  double low = HUGE_VAL, high = 0.0;
  run.cycles.clear();
  run.run(number_at(0.5));
  for (const CanRun::Cycle& cycle : run.cycles) {
    low = std::min(low, cycle.record.F_G_R.force.norm());
    high = std::max(high, cycle.record.F_G_R.force.norm());
  }
  EXPECT_EQ(run.cycles.back().record.fault, Fault::kNone);
  EXPECT_GT(low, 2.0);
  EXPECT_LT(high - low, 0.1 * high);
  EXPECT_EQ(run.controller().counters().lost, 0u);
  EXPECT_EQ(run.controller().counters().jumps, 0u);
}

/// A joint that is not heard any more: three cycles or 10 ms, and a fade of 5 ms or two cycles.
TEST_P(Rates, StopWhereAJointIsLost) {
  CanRun::Options options = pressing();
  sim::BusFault silent = fault(sim::BusFaultKind::kFrameDropped, 0, 100.0);
  silent.id = 0x181;
  options.bus_faults = {silent};
  CanRun run(plate(), options);
  start(run);
  run.run(number_at(1.2));
  const double T = GetParam().period;
  EXPECT_LE(seconds_to_stop(run), std::min(3 * T, 10e-3) + std::max(5e-3, 2 * T) + 1e-9);
  EXPECT_EQ(run.cycles.back().record.fault, Fault::kPositionLost);
  expect_at_rest(run);
}

/// Every second sample of a joint is lost: never two in a row.
TEST_P(Rates, StopWhereEverySecondPositionIsLost) {
  CanRun::Options options = pressing();
  for (std::int64_t k = 0; k < 500; ++k) {
    sim::BusFault silent = fault(sim::BusFaultKind::kFrameDropped, 0, 0.0);
    silent.id = 0x181;
    silent.first_cycle += 2 * k;
    silent.cycles = 1;
    options.bus_faults.push_back(silent);
  }
  CanRun run(plate(), options);
  start(run);
  run.run(450);
  EXPECT_EQ(run.cycles.back().record.fault, Fault::kPositionLost);
}

/// The controller is killed: each drive stops by its own deadline, and closes its brake.
TEST_P(Rates, LetTheDrivesStopByThemselves) {
  CanRun run(plate(), pressing());
  start(run);
  run.go_on_alone(run.layout().command_deadline + 2e-3);
  for (int i = 0; i < run.layout().joint_count; ++i) {
    EXPECT_NE(run.device().nodes().drive(i).state(), sim::PowerState::kEnabled) << i;
  }
  run.go_on_alone(0.6);
  expect_at_rest(run);
}

/// A drive's deadline changes by itself: reading all parameters takes two seconds at most.
TEST_P(Rates, NoticeAParameterThatChanges) {
  CanRun::Options options = pressing();
  sim::BusFault changed = fault(sim::BusFaultKind::kParameterChanged, 0, GetParam().period);
  changed.node = 1;
  changed.index = 0x1400;
  changed.sub = 5;
  changed.value = 100.0;
  options.bus_faults = {changed};
  CanRun run(plate(), options);
  start(run);
  run.run(number_at(2.5));
  EXPECT_EQ(run.cycles.back().record.fault, Fault::kAlarm);
  EXPECT_EQ(run.controller().record().alarm, Alarm::kParameterChanged);
  EXPECT_LT(seconds_to_stop(run), 2.2);
}

/// The panel is not heard any more: the arm stops as by the emergency stop.
TEST_P(Rates, StopWithoutThePanel) {
  CanRun::Options options = pressing();
  const int bus = GetParam().period < 1e-3 ? 7 : 2;
  sim::BusFault silent = fault(sim::BusFaultKind::kFrameDropped, bus, 100.0);
  silent.id = 0x1A0;
  options.bus_faults = {silent};
  CanRun run(plate(), options);
  start(run);
  run.run(number_at(0.1));
  EXPECT_LE(seconds_to_stop(run), std::min(3 * GetParam().period, 10e-3) + 2 * GetParam().period);
}

INSTANTIATE_TEST_SUITE_P(All, Rates,
                         testing::Values(Rate{0.25e-3, 6000.0}, Rate{0.5e-3, 6000.0}, Rate{2e-3, 1500.0},
                                         Rate{5e-3, 500.0}, Rate{10e-3, 200.0}),
                         [](const auto& at) { return std::to_string(std::llround(1e6 * at.param.period)) + "us"; });

}  // namespace
}  // namespace godobject::firmware
