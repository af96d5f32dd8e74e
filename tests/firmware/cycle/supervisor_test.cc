#include "firmware/cycle/supervisor.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/firmware/cycle/supervisor_bench.h"

namespace godobject::firmware::supervisor_test {
namespace {

using hal::PowerRequest;

TEST(Supervisor, RunsFromBootToRunningWhenAllIsWell) {
  Bench bench;
  std::vector<Mode> modes{bench.supervisor.mode()};
  bool powered_before_zero_check = false;
  for (int i = 0; i < 400; ++i) {
    const Decision& decision = bench.step();
    if (i < static_cast<int>(Supervisor::kZero_ms)) powered_before_zero_check |= decision.power != PowerRequest::kOff;
    if (bench.supervisor.mode() != modes.back()) modes.push_back(bench.supervisor.mode());
  }
  EXPECT_FALSE(powered_before_zero_check);
  EXPECT_EQ(modes, (std::vector<Mode>{Mode::kBoot, Mode::kZeroCheck, Mode::kIdle, Mode::kEnabling, Mode::kArmed,
                                      Mode::kEngaging, Mode::kRunning}));
  EXPECT_EQ(bench.decision.share, 1.0);
  EXPECT_TRUE(bench.decision.holds_arm);
  EXPECT_TRUE(bench.decision.rate_limited);
  EXPECT_EQ(bench.supervisor.fault(), Fault::kNone);
}

TEST(Supervisor, RampsUpEvenly) {
  Bench bench;
  bench.run_to(Mode::kEngaging);
  double before = 0.0;
  while (bench.supervisor.mode() == Mode::kEngaging) {
    const double share = bench.step().share;
    EXPECT_NEAR(share - before, 0.1, 1e-12);
    before = share;
  }
  EXPECT_NEAR(before, 1.0, 1e-12);
}

TEST(Supervisor, RendersNothingUntilTheContactForceIsSmall) {
  Bench bench;
  bench.seen.contact_force = 5.0;
  bench.run_to(Mode::kArmed);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(bench.step().share, 0.0);
  bench.seen.contact_force = 0.0;
  bench.seen.inside = true;
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(bench.step().share, 0.0);
  EXPECT_EQ(bench.supervisor.mode(), Mode::kArmed);
  bench.seen.inside = false;
  bench.step();
  EXPECT_EQ(bench.supervisor.mode(), Mode::kEngaging);
}

TEST(Supervisor, GivesNoPowerWithoutTheEnableSwitchOrInAnEmergencyStop) {
  for (const bool pressed : {false, true}) {
    Bench bench;
    bench.seen.enable_switch = pressed;
    bench.seen.emergency_stop = pressed;
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(bench.step().power, PowerRequest::kOff);
    EXPECT_EQ(bench.supervisor.mode(), Mode::kIdle);
  }
}

/// Rows of the table of faults: from the first cycle in which the cause is seen, how many it takes until nothing is
/// rendered and until the quick stop is asked for.
struct Row {
  std::string what;
  std::function<void(Observation&, int)> cause;  ///< sets the observation of cycle 1, 2, .. of the fault
  Fault fault;
  int most_cycles;  ///< of the table, from the cause to the STOP
  bool fades = false;
};

class FaultTable : public testing::TestWithParam<Row> {};

TEST_P(FaultTable, IsReactedToInTime) {
  const Row& row = GetParam();
  Bench bench;
  ASSERT_GE(bench.run_to(Mode::kRunning), 0);
  for (int i = 0; i < 20; ++i) bench.step();
  ASSERT_EQ(bench.decision.share, 1.0);
  double before = 1.0;
  int stopped = 0;
  for (int k = 1; k <= row.most_cycles && stopped == 0; ++k) {
    row.cause(bench.seen, k);
    const Decision& decision = bench.step();
    if (is_stop(decision)) stopped = k;
    if (row.fades) {
      EXPECT_LE(decision.share, before);
      EXPECT_TRUE(decision.share == 1.0 || decision.of_last || stopped > 0);
    } else {
      EXPECT_TRUE(stopped > 0 || decision.share == 1.0);
    }
    before = decision.share;
  }
  ASSERT_GT(stopped, 0) << "not within " << row.most_cycles << " cycles";
  EXPECT_EQ(bench.supervisor.fault(), row.fault);
  EXPECT_TRUE(bench.decision.holds_arm);

  // the quick stop follows, then no power; whatever the cause does, it stays so
  std::vector<PowerRequest> requests{bench.decision.power};
  for (int i = 0; i < 2000; ++i) {
    row.cause(bench.seen, row.most_cycles + 1 + i);
    EXPECT_EQ(bench.step().share, 0.0);
    if (bench.decision.power != requests.back()) requests.push_back(bench.decision.power);
  }
  std::vector<PowerRequest> expected = {PowerRequest::kEnable, PowerRequest::kQuickStop, PowerRequest::kOff};
  // a drive that has lost its power must not get it back
  if (row.fault == Fault::kDriveLeft) expected.erase(expected.begin());
  EXPECT_EQ(requests, expected);
  EXPECT_EQ(bench.supervisor.mode(), Mode::kStopped);
  EXPECT_EQ(bench.supervisor.fault(), row.fault) << "the first fault is latched";
}

INSTANTIATE_TEST_SUITE_P(
    Rows, FaultTable,
    testing::Values(
        Row{"position lost three times", [](Observation& o, int k) { o.lost = static_cast<std::uint32_t>(k); },
            Fault::kPositionLost, 8, true},
        Row{"encoder jumps twice", [](Observation& o, int k) { o.jumps = static_cast<std::uint32_t>(k); },
            Fault::kPositionJump, 3},
        Row{"not finite", [](Observation& o, int) { o.finite = false; }, Fault::kNotFinite, 1},
        Row{"cycle not computed", [](Observation& o, int) { o.status = Status::kNotFinite; }, Fault::kComputation, 1},
        Row{"encoder stuck", [](Observation& o, int) { o.stuck = true; }, Fault::kEncoderStuck, 1},
        Row{"three overruns in a row", [](Observation& o, int) { o.overrun_ns = 1; }, Fault::kOverruns, 8},
        Row{"one long overrun", [](Observation& o, int k) { o.overrun_ns = k == 1 ? 5'000'001 : 0; }, Fault::kOverruns,
            8},
        Row{"three cycles in a row computed late", [](Observation& o, int) { o.computed_late_ns = 1; },
            Fault::kComputedLate, 8},
        Row{"one computed very late", [](Observation& o, int k) { o.computed_late_ns = k == 1 ? 5'000'001 : 0; },
            Fault::kComputedLate, 8},
        Row{"computed late and so overran",
            [](Observation& o, int) {
              o.overrun_ns = 400'000;
              o.computed_late_ns = 1'300'000;
            },
            Fault::kComputedLate, 8},
        Row{"woke late and computed late",
            [](Observation& o, int) {
              o.overrun_ns = 1'300'000;
              o.computed_late_ns = 400'000;
            },
            Fault::kOverruns, 8},
        Row{"late in turn", [](Observation& o, int k) { (k % 2 == 1 ? o.overrun_ns : o.computed_late_ns) = 1; },
            Fault::kOverruns, 8},
        Row{"drive limits its torque", [](Observation& o, int) { o.limited[1] = true; }, Fault::kDriveLimited, 51},
        Row{"drive leaves enabled", [](Observation& o, int) { o.drives.all_enabled = false; }, Fault::kDriveLeft, 2},
        Row{"sending fails three times",
            [](Observation& o, int k) { o.sends_failed = static_cast<std::uint32_t>(k - 1); }, Fault::kSendFailed, 4},
        Row{"emergency stop", [](Observation& o, int) { o.emergency_stop = true; }, Fault::kEmergencyStop, 2},
        Row{"enable switch released", [](Observation& o, int) { o.enable_switch = false; }, Fault::kEnableReleased, 2},
        Row{"joint limit", [](Observation& o, int) { o.joint_beyond_limit = 1; }, Fault::kJointLimit, 5},
        Row{"too fast", [](Observation& o, int) { o.too_fast = true; }, Fault::kTooFast, 5}),
    [](const testing::TestParamInfo<Row>& row) {
      std::string name = row.param.what;
      for (char& c : name) c = c == ' ' ? '_' : c;
      return name;
    });

/// From the first cycle after 50 with the limit on, at the joint with the lowest number.
TEST(Supervisor, StopsAtTheDriveThatLimitsItsTorqueForTooLong) {
  for (const std::uint32_t most : {1u, 50u, 200u}) {
    Supervisor::Parameters p = short_start();
    p.limited_cycles = most;
    Bench bench(p);
    bench.run_to(Mode::kRunning);
    bench.seen.limited[1] = bench.seen.limited[2] = true;
    for (std::uint32_t k = 1; k <= most; ++k) ASSERT_EQ(bench.step().share, 1.0) << most << ' ' << k;
    EXPECT_TRUE(is_stop(bench.step()));
    EXPECT_EQ(bench.supervisor.fault(), Fault::kDriveLimited);
    EXPECT_EQ(bench.supervisor.fault_joint(), 1);
  }
}

/// A bit that flickers in half of the cycles changes nothing, nor do two drives that take turns.
TEST(Supervisor, GoesOnWithALimitThatFlickers) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  for (int k = 0; k < 5000; ++k) {
    bench.seen.limited[0] = k % 2 == 0;
    bench.seen.limited[1] = k % 80 < 40;
    bench.seen.limited[2] = k % 80 >= 40;
    ASSERT_EQ(bench.step().share, 1.0) << k;
  }
  bench.seen.limited.fill(false);
  bench.seen.limited[0] = true;
  int k = 0;
  while (bench.supervisor.fault() == Fault::kNone && k < 100) {
    bench.step();
    ++k;
  }
  EXPECT_LE(k, 51) << "a flicker before does not make it later";
}

/// Without power, and while brakes open, the bit of a drive may mean anything. A reset begins again.
TEST(Supervisor, WatchesTheLimitOfADriveOnlyWhileItHasToFollow) {
  Bench bench;
  bench.seen.limited.fill(true);
  bench.seen.enable_switch = false;
  for (int k = 0; k < 500; ++k) bench.step();
  EXPECT_EQ(bench.supervisor.mode(), Mode::kIdle);
  bench.seen.enable_switch = true;
  bench.obeys = false;
  ASSERT_GE(bench.run_to(Mode::kEnabling), 0);
  for (int k = 0; k < 500; ++k) bench.step();
  EXPECT_EQ(bench.supervisor.mode(), Mode::kEnabling);
  bench.obeys = true;
  ASSERT_GE(bench.run_to(Mode::kArmed), 0);
  bench.seen.contact_force = 10.0;  // it stays armed: the limit counts without rendering, too
  int with_power = 0;
  while (bench.supervisor.mode() == Mode::kArmed && with_power < 200) {
    bench.step();
    ++with_power;
  }
  EXPECT_EQ(bench.supervisor.fault(), Fault::kDriveLimited);
  EXPECT_NEAR(with_power, 51, 1);
  bench.seen.limited.fill(false);
  bench.seen.contact_force = 0.0;
  for (int k = 0; k < 20; ++k) bench.step();
  ASSERT_EQ(bench.supervisor.mode(), Mode::kStopped);
  bench.seen.enable_switch = false;
  bench.seen.reset_requested = true;
  bench.step();
  bench.seen.reset_requested = false;
  bench.seen.enable_switch = true;
  ASSERT_GE(bench.run_to(Mode::kRunning), 0);
  bench.seen.limited[0] = true;
  for (int k = 0; k < 50; ++k) ASSERT_EQ(bench.step().share, 1.0) << k;
}

/// The first frames still find room in the queue: positions are lost a cycle or two before sending fails.
TEST(Supervisor, ABusThatTakesNoFramesIsTheFaultNotThePositionsThatItDoesNotBring) {
  for (std::uint32_t taken : {1u, 2u}) {
    Bench bench;
    bench.run_to(Mode::kRunning);
    for (std::uint32_t k = 1; k <= 3; ++k) {
      bench.seen.lost = k;
      bench.seen.sends_failed = k > taken ? k - taken : 0;
      bench.step();
    }
    EXPECT_EQ(bench.supervisor.fault(), Fault::kSendFailed) << taken;
    EXPECT_EQ(bench.supervisor.mode(), Mode::kStopping) << taken;
  }
}

TEST(Supervisor, FadingGoesOnWhenAFrameIsNotTaken) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  for (std::uint32_t k = 1; k <= 5; ++k) {
    bench.seen.lost = k;
    bench.seen.sends_failed = k == 4 ? 1 : 0;
    bench.step();
  }
  EXPECT_EQ(bench.supervisor.fault(), Fault::kPositionLost);
  EXPECT_EQ(bench.supervisor.mode(), Mode::kFade);
}

TEST(Supervisor, GoesOnWhenAPositionIsLostOnceOrTwice) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  for (int i = 0; i < 3000; ++i) {
    bench.seen.lost = i % 12 < 3 ? static_cast<std::uint32_t>(i % 12) : 0;  // one position in six
    ASSERT_EQ(bench.step().share, 1.0);
  }
}

TEST(Supervisor, FadesInFiveCyclesFromTheThirdLoss) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  std::vector<double> shares;
  for (std::uint32_t k = 1; k <= 8; ++k) {
    bench.seen.lost = k;
    shares.push_back(bench.step().share);
    EXPECT_TRUE(bench.decision.holds_arm);
    if (k < 8) {
      EXPECT_EQ(bench.decision.power, PowerRequest::kEnable);
    }
  }
  const std::vector<double> expected{1.0, 1.0, 0.8, 0.6, 0.4, 0.2, 0.0, 0.0};
  ASSERT_EQ(shares.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(shares[i], expected[i], 1e-12) << i;
  EXPECT_EQ(bench.supervisor.mode(), Mode::kStopping);
}

TEST(Supervisor, FadesAndStopsThoughThePositionComesBack) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  for (std::uint32_t k = 1; k <= 3; ++k) {
    bench.seen.lost = k;
    bench.step();
  }
  bench.seen.lost = 0;
  for (int i = 0; i < 10; ++i) bench.step();
  EXPECT_EQ(bench.decision.share, 0.0);
  EXPECT_EQ(bench.supervisor.fault(), Fault::kPositionLost);
}

TEST(Supervisor, StopsAtOnceWhenADriveGoesWhileItFades) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  for (std::uint32_t k = 1; k <= 4; ++k) {
    bench.seen.lost = k;
    bench.step();
  }
  bench.seen.drives.all_enabled = false;
  EXPECT_TRUE(is_stop(bench.step()));
  EXPECT_EQ(bench.supervisor.fault(), Fault::kPositionLost) << "the first fault is latched";
}

TEST(Supervisor, ToleratesTenLateCyclesASecondAndNotEleven) {
  const std::pair<std::int64_t Observation::*, Fault> kinds[] = {
      {&Observation::overrun_ns, Fault::kOverruns}, {&Observation::computed_late_ns, Fault::kComputedLate}};
  for (const auto& [late_ns, fault] : kinds) {
    for (const int count : {10, 11}) {
      Bench bench;
      bench.run_to(Mode::kRunning);
      for (int i = 0; i < 2000; ++i) {
        bench.seen.*late_ns = i % 1000 >= 2 * count || i % 2 == 0 ? 0 : 100'000;
        bench.step();
      }
      EXPECT_EQ(bench.supervisor.fault(), count == 10 ? Fault::kNone : fault) << count;
    }
  }
}

/// The two are parts of one delay.
TEST(Supervisor, AddsNoComputingTimeToTheOverrunThatItCauses) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  bench.seen.overrun_ns = bench.seen.computed_late_ns = 3'000'000;
  bench.step();
  bench.seen.overrun_ns = bench.seen.computed_late_ns = 0;
  for (int i = 0; i < 5; ++i) bench.step();
  EXPECT_EQ(bench.supervisor.fault(), Fault::kNone);
}

TEST(Supervisor, IgnoresLateCyclesWithoutPower) {
  Bench bench;
  bench.seen.enable_switch = false;
  bench.seen.overrun_ns = bench.seen.computed_late_ns = 9'000'000;
  for (int i = 0; i < 1000; ++i) bench.step();
  EXPECT_EQ(bench.supervisor.mode(), Mode::kIdle);
  EXPECT_EQ(bench.supervisor.fault(), Fault::kNone);
}

TEST(Supervisor, RefusesDrivesThatDoNotAnswer) {
  Bench bench;
  bench.seen.drives.all_answer = false;
  for (int i = 0; i < 299; ++i) bench.step();
  EXPECT_EQ(bench.supervisor.mode(), Mode::kBoot);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(bench.step().power, PowerRequest::kOff);
  EXPECT_EQ(bench.supervisor.fault(), Fault::kDrivesAbsent);
  EXPECT_EQ(bench.supervisor.mode(), Mode::kStopped);
}

TEST(Supervisor, RefusesJointsThatMoveOrStandBeyondTheirLimitsWithBrakesClosed) {
  for (const bool moves : {false, true}) {
    Bench bench;
    bench.run_to(Mode::kZeroCheck);
    if (moves) {
      bench.seen.q[2] = 0.006;
    } else {
      bench.seen.joint_beyond_limit = 2;
    }
    EXPECT_EQ(bench.step().power, PowerRequest::kOff);
    EXPECT_EQ(bench.supervisor.fault(), moves ? Fault::kNotAtRest : Fault::kOutsideLimits);
    EXPECT_EQ(bench.supervisor.fault_joint(), moves ? -1 : 2);
  }
}

TEST(Supervisor, GivesNoPowerForASwitchThatIsHeldSinceBeforeItWasAskedFor) {
  Bench bench;
  bench.lets_go = false;
  for (int i = 0; i < 5000; ++i) ASSERT_EQ(bench.step().power, PowerRequest::kOff);
  EXPECT_EQ(bench.supervisor.mode(), Mode::kIdle);
  EXPECT_EQ(bench.supervisor.fault(), Fault::kNone);
  bench.seen.enable_switch = false;
  bench.step();
  bench.seen.enable_switch = true;
  bench.step();
  EXPECT_EQ(bench.supervisor.mode(), Mode::kEnabling);
}

TEST(Supervisor, GivesNoPowerWhenTheEmergencyStopIsReleasedWhileTheSwitchIsHeld) {
  Bench bench;
  bench.seen.enable_switch = false;
  bench.run_to(Mode::kIdle);
  for (int i = 0; i < 10; ++i) bench.step();
  bench.seen.emergency_stop = true;
  bench.step();
  bench.seen.enable_switch = true;
  bench.step();
  bench.seen.emergency_stop = false;
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(bench.step().power, PowerRequest::kOff);
  EXPECT_EQ(bench.supervisor.mode(), Mode::kIdle);
}

TEST(Supervisor, WantsTheSwitchReleasedAgainAfterAReset) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  bench.seen.emergency_stop = true;
  bench.run_to(Mode::kStopped);
  bench.seen.emergency_stop = bench.seen.enable_switch = false;
  bench.seen.reset_requested = true;
  bench.step();
  bench.seen.reset_requested = false;
  bench.seen.enable_switch = true;  // while it boots
  bench.lets_go = false;
  for (int i = 0; i < 2000; ++i) ASSERT_NE(bench.step().power, PowerRequest::kEnable);
  EXPECT_EQ(bench.supervisor.mode(), Mode::kIdle);
}

TEST(Supervisor, CallsAJointThatRunsAwayTooFastThoughItsPositionsJump) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  bench.seen.too_fast = true;
  bench.seen.jumps = 2;
  EXPECT_TRUE(is_stop(bench.step()));
  EXPECT_EQ(bench.supervisor.fault(), Fault::kTooFast);
}

TEST(Supervisor, ToleratesTenJumpsASecondAndNotEleven) {
  for (const int count : {10, 11}) {
    Bench bench;
    bench.run_to(Mode::kRunning);
    for (int i = 0; i < 2000; ++i) {
      bench.seen.jumps = i % 1000 < 20 * count && i % 20 == 0 ? 1 : 0;
      bench.step();
    }
    EXPECT_EQ(bench.supervisor.fault(), count == 10 ? Fault::kNone : Fault::kPositionJump) << count;
  }
}

/// The brakes of a heavy arm have the time that they have, whoever ends the program meanwhile.
TEST(Supervisor, IsNotHurriedByARequestToEndWhileItStopsForAFault) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  bench.obeys = false;
  bench.seen.emergency_stop = true;
  bench.step();
  ASSERT_EQ(bench.supervisor.mode(), Mode::kStopping);
  bench.seen.end_requested = true;
  int cycles = 1;
  while (bench.supervisor.mode() == Mode::kStopping && cycles < 3000) {
    bench.step();
    ++cycles;
  }
  EXPECT_EQ(cycles, static_cast<int>(Supervisor::kFaultStop_ms) + 1) << "the last one is that of the end";
  EXPECT_EQ(bench.supervisor.mode(), Mode::kEnded);
}

/// Drives as a reading tells them: `silent` at joint 1, all others at rest and fresh.
DriveSummary drives_with(hal::DriveState silent, std::uint32_t age) {
  hal::JointReading reading;
  reading.state[1] = silent;
  reading.age[1] = age;
  return summarize(reading, 3);
}

TEST(Supervisor, TakesADriveThatDoesNotAnswerForOneThatMayMove) {
  EXPECT_TRUE(drives_with(hal::DriveState::kOff, 0).none_moves);
  EXPECT_TRUE(drives_with(hal::DriveState::kFault, 0).none_moves);
  for (const auto state : {hal::DriveState::kEnabled, hal::DriveState::kQuickStop, hal::DriveState::kUnavailable}) {
    EXPECT_FALSE(drives_with(state, 0).none_moves);
  }
  EXPECT_TRUE(drives_with(hal::DriveState::kOff, 0).all_fresh);
  EXPECT_FALSE(drives_with(hal::DriveState::kOff, 1).all_fresh);
}

/// Silent in each way that leaves open whether it moves.
const std::vector<DriveSummary> kSilentDrives = {drives_with(hal::DriveState::kUnavailable, 60),
                                                 drives_with(hal::DriveState::kEnabled, 20),
                                                 drives_with(hal::DriveState::kOff, 1)};

/// A quick stop is broken off by taking power away: it is asked for until all drives have been seen at rest.
TEST(Supervisor, LeavesTheQuickStopToADriveThatFellSilentUntilItIsSeenAtRest) {
  for (const DriveSummary& silent : kSilentDrives) {
    Bench bench;
    ASSERT_GE(bench.run_to(Mode::kRunning), 0);
    for (std::uint32_t k = 1; k <= 3; ++k) {
      bench.seen.lost = k;
      bench.step();
    }
    bench.obeys = false;
    bench.seen.drives = silent;
    std::uint32_t stopping = 0;
    while (bench.supervisor.mode() != Mode::kStopped && stopping < 3000) {
      ASSERT_EQ(bench.step().power, PowerRequest::kQuickStop) << stopping;
      if (bench.supervisor.mode() == Mode::kStopping) ++stopping;
    }
    EXPECT_EQ(stopping, Supervisor::kFaultStop_ms);
    for (int i = 0; i < 3000; ++i) ASSERT_EQ(bench.step().power, PowerRequest::kQuickStop) << i;

    bench.seen.drives = drives_with(hal::DriveState::kOff, 0);
    EXPECT_EQ(bench.step().power, PowerRequest::kOff);
    bench.seen.drives = silent;
    for (int i = 0; i < 100; ++i) ASSERT_EQ(bench.step().power, PowerRequest::kOff) << "it has been seen at rest";
    EXPECT_EQ(bench.supervisor.mode(), Mode::kStopped);
    EXPECT_EQ(bench.supervisor.fault(), Fault::kPositionLost);
  }
}

TEST(Supervisor, EndsInTheQuickStopWhereADriveWasNotSeenAtRest) {
  for (const DriveSummary& silent : kSilentDrives) {
    Bench bench;
    ASSERT_GE(bench.run_to(Mode::kRunning), 0);
    bench.seen.end_requested = true;
    ASSERT_GE(bench.run_to(Mode::kStopping), 0);
    for (std::uint32_t i = 0; i < Supervisor::kHold_ms; ++i) bench.step();
    bench.obeys = false;
    bench.seen.drives = silent;
    ASSERT_GE(bench.run_to(Mode::kEnded), 0);
    EXPECT_EQ(bench.decision.power, PowerRequest::kQuickStop);
    EXPECT_EQ(bench.step().power, PowerRequest::kQuickStop);
    bench.seen.drives = drives_with(hal::DriveState::kOff, 0);
    EXPECT_EQ(bench.step().power, PowerRequest::kOff);
  }
}

TEST(Supervisor, StopsForAFaultAsSoonAsAllDrivesAreSeenAtRest) {
  Bench bench;
  ASSERT_GE(bench.run_to(Mode::kRunning), 0);
  bench.seen.emergency_stop = true;
  bench.step();
  bench.obeys = false;
  bench.seen.drives = drives_with(hal::DriveState::kUnavailable, 60);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(bench.step().power, PowerRequest::kQuickStop);
  bench.seen.drives = drives_with(hal::DriveState::kOff, 0);
  EXPECT_EQ(bench.step().power, PowerRequest::kOff);
  EXPECT_EQ(bench.supervisor.mode(), Mode::kStopped);
}

/// The operator's reset and the end come through although the stop still goes on.
TEST(Supervisor, IsResetAndEndedThoughADriveWasNotSeenAtRest) {
  for (const bool resets : {true, false}) {
    Bench bench;
    ASSERT_GE(bench.run_to(Mode::kRunning), 0);
    bench.seen.emergency_stop = true;
    bench.step();
    bench.obeys = false;
    bench.seen.drives = drives_with(hal::DriveState::kUnavailable, 60);
    ASSERT_GE(bench.run_to(Mode::kStopped), 0);
    bench.seen.emergency_stop = bench.seen.enable_switch = false;
    (resets ? bench.seen.reset_requested : bench.seen.end_requested) = true;
    EXPECT_EQ(bench.step().power, PowerRequest::kQuickStop);
    EXPECT_EQ(bench.supervisor.mode(), resets ? Mode::kResetting : Mode::kEnded);
  }
}

/// Who had no power is asked for no quick stop.
TEST(Supervisor, AsksForNothingWhereADriveFallsSilentBeforeThereIsPower) {
  for (const Mode mode : {Mode::kZeroCheck, Mode::kIdle, Mode::kEnabling}) {
    Bench bench;
    ASSERT_GE(bench.run_to(mode), 0);
    bench.seen.drives = drives_with(hal::DriveState::kUnavailable, 60);
    bench.obeys = false;
    for (int i = 0; i < 1500; ++i) ASSERT_EQ(bench.step().power, PowerRequest::kOff) << name(mode);
    EXPECT_EQ(bench.supervisor.fault(), Fault::kDriveLeft);
    EXPECT_EQ(bench.supervisor.mode(), Mode::kStopped);
  }
}

TEST(Supervisor, HoldsTheArmBeforeItAsksForPower) {
  Bench bench;
  bench.run_to(Mode::kEnabling);
  for (std::uint32_t i = 1; i < short_start().prepare_cycles; ++i) {
    EXPECT_TRUE(bench.step().holds_arm);
    EXPECT_EQ(bench.decision.power, PowerRequest::kOff);
  }
  EXPECT_EQ(bench.step().power, PowerRequest::kEnable);
}

TEST(Supervisor, StopsWhenADriveDoesNotBecomeEnabled) {
  Bench bench;
  bench.obeys = false;
  bench.run_to(Mode::kEnabling);
  int cycles = 0;
  while (bench.supervisor.mode() == Mode::kEnabling && cycles < 3000) {
    bench.step();
    ++cycles;
  }
  EXPECT_EQ(cycles, static_cast<int>(short_start().prepare_cycles + Supervisor::kEnable_ms));
  EXPECT_EQ(bench.supervisor.fault(), Fault::kDriveLeft);
}

/// Whatever happens, in whichever cycle since the start: no stop asks for power that the drives have not got.
TEST(Supervisor, NeverGivesPowerByStopping) {
  const std::vector<std::function<void(Observation&)>> causes = {
      [](Observation& o) { o.emergency_stop = true; },
      [](Observation& o) { o.enable_switch = false; },
      [](Observation& o) { o.end_requested = true; },
      [](Observation& o) { o.lost = 3; },
      [](Observation& o) { o.drives.all_enabled = false; },
      [](Observation& o) { o.drives.any_fault = true; },
      [](Observation& o) { o.end_requested = o.drives.any_fault = true; },
      [](Observation& o) { o.finite = false; }};
  for (int start = 0; start < 200; ++start) {
    for (std::size_t c = 0; c < causes.size(); ++c) {
      Bench bench;
      for (int i = 0; i < start; ++i) bench.step();
      PowerRequest before = bench.decision.power;
      for (int i = 0; i < 40; ++i) {
        causes[c](bench.seen);
        const bool had_power = bench.seen.drives.all_enabled;
        bench.step();
        const Mode mode = bench.supervisor.mode();
        if (mode == Mode::kFade || mode == Mode::kStopping) {
          ASSERT_TRUE(bench.decision.power != PowerRequest::kEnable || (before == PowerRequest::kEnable && had_power))
              << "cause " << c << " after " << start << " cycles";
        }
        before = bench.decision.power;
      }
    }
  }
}

/// systemctl stop of a process that hung: both come at once.
TEST(Supervisor, EndsThoughAFaultComesInTheSameCycle) {
  for (int start = 0; start < 460; ++start) {
    Bench bench;
    for (int i = 0; i < start; ++i) bench.step();
    const bool powered = bench.decision.power == PowerRequest::kEnable;
    bench.seen.end_requested = bench.seen.drives.any_fault = true;
    bench.step();
    if (powered) {
      EXPECT_EQ(bench.decision.power, PowerRequest::kEnable) << "the arm is held, then stopped; after " << start;
      EXPECT_TRUE(bench.decision.holds_arm);
    }
    for (int i = 0; i < 200; ++i) bench.step();
    EXPECT_EQ(bench.supervisor.mode(), Mode::kEnded) << start;
    bench.seen.reset_requested = true;
    bench.seen.enable_switch = false;
    for (int i = 0; i < 10; ++i) ASSERT_EQ(bench.step().power, PowerRequest::kOff);
  }
}

TEST(Supervisor, LeavesADriveThatHasTrippedToTheOperator) {
  Bench bench;
  bench.seen.drives.any_fault = true;
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(bench.step().power, PowerRequest::kOff);
  EXPECT_EQ(bench.supervisor.mode(), Mode::kStopped);
  EXPECT_EQ(bench.supervisor.fault(), Fault::kDriveLeft);
}

TEST(Supervisor, DoesNotWaitBesideADriveThatHasPowerUnasked) {
  Bench bench;
  bench.seen.enable_switch = false;
  ASSERT_GE(bench.run_to(Mode::kIdle), 0);
  bench.obeys = false;
  bench.seen.drives.none_moves = false;
  bench.step();
  EXPECT_EQ(bench.supervisor.fault(), Fault::kDriveLeft);
}

TEST(Supervisor, EndsFromRunningWithARampAndAQuickStopWithinTwoHundredCycles) {
  for (const bool obeys : {true, false}) {
    Bench bench;
    bench.run_to(Mode::kRunning);
    bench.seen.end_requested = true;
    bench.obeys = obeys;
    double before = 1.0;
    std::vector<PowerRequest> requests;
    int cycles = 0;
    for (; cycles < 300 && bench.supervisor.mode() != Mode::kEnded; ++cycles) {
      bench.step();
      EXPECT_LE(before - bench.decision.share, 1.0 / Supervisor::kEndRamp_ms + 1e-12);
      EXPECT_LE(bench.decision.share, before);
      before = bench.decision.share;
      if (requests.empty() || requests.back() != bench.decision.power) requests.push_back(bench.decision.power);
    }
    EXPECT_LE(cycles, 200);
    std::vector<PowerRequest> expected{PowerRequest::kEnable, PowerRequest::kQuickStop};
    if (obeys) expected.push_back(PowerRequest::kOff);
    EXPECT_EQ(requests, expected);
    EXPECT_EQ(bench.supervisor.fault(), Fault::kNone);
  }
}

TEST(Supervisor, EndsWithinTwoHundredCyclesFromEveryMode) {
  for (int start = 0; start < 460; start += 3) {
    Bench bench;
    for (int i = 0; i < start; ++i) {
      if (i == 350) bench.seen.lost = 3;  // the last of them in FADE, STOP and stopped
      bench.step();
    }
    bench.seen.end_requested = true;
    const int cycles = bench.run_to(Mode::kEnded);
    EXPECT_GE(cycles, 0) << start;
    EXPECT_LE(cycles, 200) << start;
    EXPECT_EQ(bench.step().power, PowerRequest::kOff);
  }
}

TEST(Supervisor, StopsForAFaultWhileItEnds) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  bench.seen.end_requested = true;
  for (int i = 0; i < 10; ++i) bench.step();
  bench.seen.emergency_stop = true;
  EXPECT_TRUE(is_stop(bench.step()));
  EXPECT_LE(bench.run_to(Mode::kEnded), 190);
  EXPECT_EQ(bench.supervisor.fault(), Fault::kEmergencyStop);
}

TEST(Supervisor, IsResetByTheOperatorOnlyWithTheSwitchReleased) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  bench.seen.emergency_stop = true;
  bench.run_to(Mode::kStopped);
  bench.seen.drives.any_fault = true;
  bench.seen.reset_requested = true;
  bench.step();
  EXPECT_EQ(bench.supervisor.mode(), Mode::kStopped) << "emergency stop pressed";
  bench.seen.emergency_stop = false;
  bench.step();
  EXPECT_EQ(bench.supervisor.mode(), Mode::kStopped) << "enable switch held";
  bench.seen.enable_switch = false;
  bench.step();
  EXPECT_EQ(bench.supervisor.mode(), Mode::kResetting);
  EXPECT_EQ(bench.decision.power, PowerRequest::kReset);
  bench.seen.reset_requested = false;
  EXPECT_GE(bench.run_to(Mode::kIdle), 0);
  EXPECT_EQ(bench.supervisor.fault(), Fault::kNone);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(bench.step().power, PowerRequest::kOff);
  bench.seen.enable_switch = true;
  EXPECT_GE(bench.run_to(Mode::kRunning), 0);
  EXPECT_EQ(bench.decision.share, 1.0);
}

TEST(Supervisor, AResetTakesNoPowerFromADriveOnItsRamp) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  bench.obeys = false;
  bench.seen.emergency_stop = true;
  ASSERT_GE(bench.run_to(Mode::kStopped), 0);  // not seen at rest in all this time
  bench.seen.emergency_stop = bench.seen.enable_switch = false;
  bench.seen.reset_requested = true;
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(bench.step().power, PowerRequest::kQuickStop) << "disabled, a drive would break its ramp off";
    ASSERT_EQ(bench.supervisor.mode(), Mode::kResetting);
    bench.seen.reset_requested = false;
  }
  bench.seen.drives = drives_with(hal::DriveState::kOff, 0);
  EXPECT_EQ(bench.step().power, PowerRequest::kReset);
  bench.step();
  EXPECT_EQ(bench.supervisor.mode(), Mode::kBoot);
  EXPECT_EQ(bench.supervisor.fault(), Fault::kNone);
}

TEST(Supervisor, StaysStoppedWithoutAReset) {
  Bench bench;
  bench.run_to(Mode::kRunning);
  bench.seen.enable_switch = false;
  bench.run_to(Mode::kStopped);
  bench.seen.enable_switch = true;
  for (int i = 0; i < 3000; ++i) ASSERT_EQ(bench.step().power, PowerRequest::kOff);
}

TEST(Supervisor, StopsWhenAJointMovesAwayInTheSignTest) {
  Bench bench(short_start(/*sign_test=*/true));
  ASSERT_GE(bench.run_to(Mode::kSignTest), 0);
  bench.step();
  bench.seen.q[1] = 0.21;
  EXPECT_TRUE(is_stop(bench.step()));
  EXPECT_EQ(bench.supervisor.fault(), Fault::kSignWrong);
}

/// A bench with joints that follow their torque, armed after a sign test that passed.
Bench tested_bench() {
  Bench bench(short_start(/*sign_test=*/true));
  bench.run_to(Mode::kSignTest);
  for (int i = 0; i < 5000 && bench.supervisor.mode() == Mode::kSignTest; ++i) {
    bench.seen.q += 1e-2 * bench.step().test_torque;
  }
  EXPECT_EQ(bench.supervisor.mode(), Mode::kArmed);
  EXPECT_TRUE(bench.decision.test_torque.isZero(0.0));
  return bench;
}

/// The mode that follows kEnabling once the operator has reset it and holds the switch again.
Mode mode_after_reset(Bench& bench) {
  bench.run_to(Mode::kStopped);
  bench.seen.emergency_stop = bench.seen.enable_switch = bench.seen.drive_restarted = false;
  bench.seen.drives.all_answer = true;
  bench.seen.reset_requested = true;
  bench.run_to(Mode::kIdle);
  bench.seen.reset_requested = false;
  bench.seen.enable_switch = true;
  bench.run_to(Mode::kEnabling);
  while (bench.supervisor.mode() == Mode::kEnabling) bench.step();
  return bench.supervisor.mode();
}

TEST(Supervisor, ArmsOnlyAfterASignTestThatPassedAndTestsOnce) {
  Bench bench = tested_bench();
  bench.seen.emergency_stop = true;
  EXPECT_EQ(mode_after_reset(bench), Mode::kArmed);
}

TEST(Supervisor, RepeatsTheSignTestOnceADriveHasBeenWithoutSupply) {
  Bench lost = tested_bench();
  lost.seen.drives.all_answer = false;
  lost.step();
  EXPECT_EQ(mode_after_reset(lost), Mode::kSignTest);
  Bench later = tested_bench();  // only while it was stopped for another reason
  later.seen.emergency_stop = true;
  later.run_to(Mode::kStopped);
  later.seen.drives.all_answer = false;
  later.step();
  EXPECT_EQ(mode_after_reset(later), Mode::kSignTest);
  Bench restarted = tested_bench();
  restarted.seen.emergency_stop = restarted.seen.drive_restarted = true;
  restarted.step();
  EXPECT_EQ(mode_after_reset(restarted), Mode::kSignTest);
}

TEST(Supervisor, NamesEveryModeAndFault) {
  for (int i = 0; i <= static_cast<int>(Mode::kEnded); ++i) EXPECT_STRNE(name(static_cast<Mode>(i)), "unknown");
  for (int i = 0; i <= static_cast<int>(kLastFault); ++i) {
    EXPECT_STRNE(describe(static_cast<Fault>(i)), "unknown fault");
  }
}

}  // namespace
}  // namespace godobject::firmware::supervisor_test
