#include "firmware/cycle/supervisor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/firmware/cycle/supervisor_bench.h"

namespace godobject::firmware::supervisor_modes_test {
namespace {

using hal::PowerRequest;

/// A bench that has just entered the mode, by the ordinary way into it.
Bench bench_in(Mode mode) {
  Bench bench(short_start(/*sign_test=*/true));
  bench.joints_follow = true;
  const Mode before = mode == Mode::kResetting                                               ? Mode::kStopped
                      : mode == Mode::kFade || mode == Mode::kEnding || mode == Mode::kEnded ? Mode::kRunning
                      : mode == Mode::kStopping || mode == Mode::kStopped                    ? Mode::kRunning
                                                                                             : mode;
  if (before == Mode::kStopped) bench = bench_in(Mode::kStopped);
  EXPECT_GE(bench.run_to(before), 0);
  if (mode == Mode::kFade) {
    for (std::uint32_t k = 1; k <= 3; ++k) {
      bench.seen.lost = k;
      bench.step();
    }
    bench.seen.lost = 0;
  } else if (mode == Mode::kStopping || mode == Mode::kStopped) {
    bench.seen.emergency_stop = true;
    bench.step();
    bench.seen.emergency_stop = false;
  } else if (mode == Mode::kResetting) {
    bench.seen.enable_switch = false;
    bench.seen.reset_requested = true;
    bench.step();
    bench.seen.reset_requested = false;
  } else if (mode == Mode::kEnding || mode == Mode::kEnded) {
    bench.seen.end_requested = true;
    bench.step();
  }
  EXPECT_GE(bench.run_to(mode), 0) << name(mode);
  return bench;
}

bool has_power(Mode mode) { return (mode >= Mode::kEnabling && mode <= Mode::kFade) || mode == Mode::kEnding; }

bool is_same(const Bench& a, const Bench& b) {
  return a.supervisor.mode() == b.supervisor.mode() && a.supervisor.fault() == b.supervisor.fault() &&
         a.supervisor.fault_joint() == b.supervisor.fault_joint() && a.decision.power == b.decision.power &&
         a.decision.holds_arm == b.decision.holds_arm && a.decision.share == b.decision.share &&
         a.decision.of_last == b.decision.of_last && a.decision.rate_limited == b.decision.rate_limited &&
         a.decision.test_torque == b.decision.test_torque;
}

/// One cause, seen in one cycle of each mode. The letters say what follows, in the order of `Mode`:
///
///     boot zero_check idle enabling sign_test armed engaging running fade stopping stopped resetting ending ended
///
///     .  the same as without the cause          h  the mode stays as it is
///     x  a stop with the fault of this row      k  a stop; the earlier fault stays
///     w  a stop, sign wrong                     o  a stop, outside the limits before the start
///     l  a stop, position lost                  f  a fade with the fault of this row
///     q  the quick stop begins now              r  a reset
///     G  the share begins to fall (ending)      S  a stop without a fault     D  the end
struct ModeRow {
  const char* what;
  const char* follows;
  Fault fault;
  std::function<void(Observation&)> cause;
};

const std::vector<ModeRow> kRows = {
    {"reading not finite", "xxxxxxxxk...x.", Fault::kNotFinite, [](Observation& o) { o.finite = false; }},
    {"not finite, no answer", "hxxxxxxxk..hx.", Fault::kNotFinite,
     [](Observation& o) {
       o.finite = false;
       o.drives.all_answer = false;
     }},
    {"alarm", ".xxxxxxxk...x.", Fault::kAlarm, [](Observation& o) { o.alarm = true; }},
    {"emergency stop", "...xxxxxk...x.", Fault::kEmergencyStop, [](Observation& o) { o.emergency_stop = true; }},
    {"enable switch released", "...xxxxxk...x.", Fault::kEnableReleased,
     [](Observation& o) { o.enable_switch = false; }},
    {"cycle not computed", "...xxxxxk...x.", Fault::kComputation,
     [](Observation& o) { o.status = Status::kNotFinite; }},
    {"drive silent", "hxxxxxxxkq.hx.", Fault::kDriveLeft,
     [](Observation& o) {
       o.drives = {false, false, false, false, true};
     }},
    {"drive does not answer", "hxxxxxxxkq.hx.", Fault::kDriveLeft,
     [](Observation& o) { o.drives.all_answer = o.drives.all_enabled = false; }},
    {"drive trips", "xxxxxxxxkq.hx.", Fault::kDriveLeft,
     [](Observation& o) {
       o.drives = {true, false, true, true, true};
     }},
    {"drive has tripped, another is silent", "hxxxxxxxkq.hx.", Fault::kDriveLeft,
     [](Observation& o) {
       o.drives = {false, false, false, true, true};
     }},
    {"drive stops by itself", "hxx.xxxxkq..x.", Fault::kDriveLeft,
     [](Observation& o) {
       o.drives = {true, false, false, false, true};
     }},
    {"too fast", "...wwxxxk...x.", Fault::kTooFast, [](Observation& o) { o.too_fast = true; }},
    {"one jump", "..............", Fault::kNone, [](Observation& o) { o.jumps = 1; }},
    {"two jumps", ".xxxxxxxk...x.", Fault::kPositionJump, [](Observation& o) { o.jumps = 2; }},
    {"encoder stuck", "...xxxxxk...x.", Fault::kEncoderStuck, [](Observation& o) { o.stuck = true; }},
    {"joint 0 beyond", ".o.xxxxxk...x.", Fault::kJointLimit, [](Observation& o) { o.joint_beyond_limit = 0; }},
    {"joint 2 beyond", ".o.xxxxxk...x.", Fault::kJointLimit, [](Observation& o) { o.joint_beyond_limit = 2; }},
    {"overrun of 5 ms", "..............", Fault::kNone, [](Observation& o) { o.overrun_ns = 5'000'000; }},
    {"overrun above 5 ms", "...xxxxxk...x.", Fault::kOverruns, [](Observation& o) { o.overrun_ns = 5'000'001; }},
    {"computed 5 ms too long", "..............", Fault::kNone, [](Observation& o) { o.computed_late_ns = 5'000'000; }},
    {"computed longer than that", "...xxxxxk...x.", Fault::kComputedLate,
     [](Observation& o) { o.computed_late_ns = 5'000'001; }},
    {"a drive's torque is wrong", "...xxxxxk...x.", Fault::kTorqueWrong,
     [](Observation& o) { o.wrong_torque_joint = 3; }},
    {"it drifts early", "....xxx.......", Fault::kNotBalanced, [](Observation& o) { o.drifts_early = true; }},
    {"it drifts", ".......x......", Fault::kDrifts, [](Observation& o) { o.drifts = true; }},
    {"second failed send", "..............", Fault::kNone, [](Observation& o) { o.sends_failed = 2; }},
    {"third failed send", "...xxxxxk...x.", Fault::kSendFailed, [](Observation& o) { o.sends_failed = 3; }},
    {"lost twice", "h.............", Fault::kNone, [](Observation& o) { o.lost = 2; }},
    {"lost once", "h.............", Fault::kNone, [](Observation& o) { o.lost = 1; }},
    {"lost three times", "hxxfffff....f.", Fault::kPositionLost, [](Observation& o) { o.lost = 3; }},
    {"lost, one failed send", "hllxxxxx....x.", Fault::kSendFailed,
     [](Observation& o) {
       o.lost = 3;
       o.sends_failed = 1;
     }},
    {"lost, third failed send", "hllxxxxxk...x.", Fault::kSendFailed,
     [](Observation& o) {
       o.lost = 3;
       o.sends_failed = 3;
     }},
    {"lost twice, one failed send", "h.............", Fault::kNone,
     [](Observation& o) {
       o.lost = 2;
       o.sends_failed = 1;
     }},
    {"end requested", "DDDSSSGG..DD..", Fault::kNone, [](Observation& o) { o.end_requested = true; }},
    {"reset, switch held", "..............", Fault::kNone, [](Observation& o) { o.reset_requested = true; }},
    {"reset, switch released", "...xxxxxk.r.x.", Fault::kEnableReleased,
     [](Observation& o) {
       o.reset_requested = true;
       o.enable_switch = false;
     }},
    {"reset, emergency stop", "...xxxxxk...x.", Fault::kEmergencyStop,
     [](Observation& o) {
       o.reset_requested = o.emergency_stop = true;
       o.enable_switch = false;
     }},
    {"contact force too large", ".....h........", Fault::kNone, [](Observation& o) { o.contact_force = 0.5; }},
    {"contact force just small", "..............", Fault::kNone,
     [](Observation& o) { o.contact_force = std::nextafter(0.5, 0.0); }},
    {"god object inside", ".....h........", Fault::kNone, [](Observation& o) { o.inside = true; }},
};

/// A stop: nothing is rendered; the arm is held while drives have power, and who has no power gets none.
void expect_stop(const Bench& bench, const Bench& before, const DriveSummary& drives) {
  const bool powered = has_power(before.supervisor.mode());
  EXPECT_EQ(bench.supervisor.mode(), powered ? Mode::kStopping : Mode::kStopped);
  EXPECT_TRUE(is_stop(bench.decision));
  EXPECT_EQ(bench.decision.holds_arm, powered);
  const bool had_power = before.decision.power == PowerRequest::kEnable;
  EXPECT_EQ(bench.decision.power, !had_power           ? PowerRequest::kOff
                                  : drives.all_enabled ? PowerRequest::kEnable
                                                       : PowerRequest::kQuickStop);
}

/// Whatever happened, in the next cycles nothing is rendered and the fault is latched.
void expect_latched(Bench bench, Fault fault, int joint) {
  for (int i = 0; i < 40; ++i) {
    bench.seen.reset_requested = false;
    bench.step();
    ASSERT_NE(bench.supervisor.mode(), Mode::kRunning);
    EXPECT_TRUE(bench.decision.share == 0.0 || bench.decision.of_last);
    EXPECT_TRUE(bench.decision.test_torque.isZero(0.0));
    EXPECT_EQ(bench.supervisor.fault(), fault);
    EXPECT_EQ(bench.supervisor.fault_joint(), joint);
  }
  EXPECT_EQ(bench.decision.share, 0.0);
  EXPECT_EQ(bench.decision.power, PowerRequest::kOff);
}

void expect_row(const ModeRow& row, Mode mode, char follows) {
  SCOPED_TRACE(std::string(row.what) + " in " + name(mode));
  const Bench before = bench_in(mode);
  Bench without = before;
  without.step();
  Bench with = before;
  row.cause(with.seen);
  const Observation shown = with.seen;
  with.step();
  with.seen.lost = with.seen.jumps = with.seen.sends_failed = 0;
  const Supervisor& supervisor = with.supervisor;
  const Fault earlier = before.supervisor.fault();
  const int culprit = std::max(shown.joint_beyond_limit, shown.wrong_torque_joint);  // one of them
  const auto expect_stopped_by = [&](Fault fault, int joint) {
    expect_stop(with, before, shown.drives);
    EXPECT_EQ(supervisor.fault(), fault);
    EXPECT_EQ(supervisor.fault_joint(), joint);
    Bench later = with;
    later.seen = before.seen;
    expect_latched(later, fault, joint);
  };
  switch (follows) {
    case '.': EXPECT_TRUE(is_same(with, without)); return;
    case 'x': return expect_stopped_by(row.fault, culprit);
    case 'k': return expect_stopped_by(earlier, -1);
    case 'w': return expect_stopped_by(Fault::kSignWrong, -1);
    case 'o': return expect_stopped_by(Fault::kOutsideLimits, culprit);
    case 'l': return expect_stopped_by(Fault::kPositionLost, -1);
    case 'h':
      EXPECT_EQ(supervisor.mode(), mode);
      EXPECT_EQ(supervisor.fault(), earlier);
      EXPECT_EQ(with.decision.share, 0.0);
      return;
    case 'f':
      EXPECT_EQ(supervisor.mode(), Mode::kFade);
      EXPECT_EQ(supervisor.fault(), row.fault);
      EXPECT_EQ(with.decision.power, before.decision.power);
      EXPECT_NEAR(with.decision.share, 0.8, 1e-12);
      EXPECT_TRUE(with.decision.of_last && with.decision.holds_arm && !with.decision.rate_limited);
      return expect_latched(with, row.fault, -1);
    case 'q':
      EXPECT_EQ(supervisor.mode(), mode);
      EXPECT_EQ(with.decision.power, PowerRequest::kQuickStop);
      EXPECT_TRUE(is_stop(with.decision) && with.decision.holds_arm);
      return;
    case 'r':
      EXPECT_EQ(supervisor.mode(), Mode::kResetting);
      EXPECT_EQ(supervisor.fault(), earlier);
      EXPECT_EQ(with.decision.power, PowerRequest::kReset);
      return;
    case 'G':
      EXPECT_EQ(supervisor.mode(), Mode::kEnding);
      EXPECT_EQ(supervisor.fault(), Fault::kNone);
      EXPECT_EQ(with.decision.power, PowerRequest::kEnable);
      return;
    case 'S': return expect_stopped_by(Fault::kNone, -1);
    case 'D':
      EXPECT_EQ(supervisor.mode(), Mode::kEnded);
      EXPECT_EQ(supervisor.fault(), earlier);
      return expect_latched(with, earlier, -1);
    default: FAIL() << "no such letter";
  }
}

TEST(SupervisorModes, ReactToEachCauseAsTheTableSays) {
  for (const ModeRow& row : kRows) {
    ASSERT_EQ(std::string(row.follows).size(), kModeCount) << row.what;
    for (std::size_t mode = 0; mode < kModeCount; ++mode) expect_row(row, static_cast<Mode>(mode), row.follows[mode]);
  }
}

/// Of several causes in one cycle the one nearer to the root is named: the operator and the drives before what they
/// bring about.
TEST(SupervisorModes, NameTheFirstOfTwoCausesInTheSameCycle) {
  const std::vector<std::pair<Fault, std::function<void(Observation&)>>> causes = {
      {Fault::kNotFinite, [](Observation& o) { o.finite = false; }},
      {Fault::kAlarm, [](Observation& o) { o.alarm = true; }},
      {Fault::kEmergencyStop, [](Observation& o) { o.emergency_stop = true; }},
      {Fault::kEnableReleased, [](Observation& o) { o.enable_switch = false; }},
      {Fault::kComputation, [](Observation& o) { o.status = Status::kArmShape; }},
      {Fault::kDriveLeft, [](Observation& o) { o.drives.all_enabled = false; }},
      {Fault::kTooFast, [](Observation& o) { o.too_fast = true; }},
      {Fault::kPositionJump, [](Observation& o) { o.jumps = 2; }},
      {Fault::kEncoderStuck, [](Observation& o) { o.stuck = true; }},
      {Fault::kJointLimit, [](Observation& o) { o.joint_beyond_limit = 1; }},
      {Fault::kTorqueWrong, [](Observation& o) { o.wrong_torque_joint = 1; }},
      {Fault::kDrifts, [](Observation& o) { o.drifts = true; }},
      {Fault::kOverruns, [](Observation& o) { o.overrun_ns = 6'000'000; }},
      {Fault::kComputedLate, [](Observation& o) { o.computed_late_ns = 6'000'000; }},
      {Fault::kSendFailed, [](Observation& o) { o.sends_failed = 3; }},
      {Fault::kPositionLost, [](Observation& o) { o.lost = 3; }}};
  const Bench running = bench_in(Mode::kRunning);
  for (std::size_t i = 0; i < causes.size(); ++i) {
    for (std::size_t j = i; j < causes.size(); ++j) {
      Bench bench = running;
      causes[j].second(bench.seen);
      causes[i].second(bench.seen);
      bench.step();
      EXPECT_EQ(bench.supervisor.fault(), causes[i].first) << i << ' ' << j;
      const bool has_joint = causes[i].first == Fault::kJointLimit || causes[i].first == Fault::kTorqueWrong;
      EXPECT_EQ(bench.supervisor.fault_joint(), has_joint ? 1 : -1) << i << ' ' << j;
      // a later cause does not replace the first one
      Bench later = running;
      causes[i].second(later.seen);
      later.step();
      later.seen = running.seen;
      causes[j].second(later.seen);
      for (int k = 0; k < 3; ++k) later.step();
      EXPECT_EQ(later.supervisor.fault(), causes[i].first) << i << ' ' << j;
      EXPECT_EQ(later.supervisor.fault_joint(), has_joint ? 1 : -1) << i << ' ' << j;
    }
  }
}

/// Power, torque and rendering of each mode, at rest in it.
TEST(SupervisorModes, GrantPowerAndTorqueAsTheTableSays) {
  struct Granted {
    Mode mode;
    PowerRequest power;
    bool holds_arm, rate_limited, follows_positions, renders;
    double share;
  };
  using P = PowerRequest;
  for (const Granted& granted : {Granted{Mode::kBoot, P::kOff, false, false, false, false, 0.0},
                                 {Mode::kZeroCheck, P::kOff, false, false, true, false, 0.0},
                                 {Mode::kIdle, P::kOff, false, false, true, false, 0.0},
                                 {Mode::kEnabling, P::kOff, true, true, true, false, 0.0},
                                 {Mode::kSignTest, P::kEnable, true, true, true, false, 0.0},
                                 {Mode::kArmed, P::kEnable, true, true, true, true, 0.0},
                                 {Mode::kEngaging, P::kEnable, true, true, true, true, 0.0},
                                 {Mode::kRunning, P::kEnable, true, true, true, true, 1.0},
                                 {Mode::kFade, P::kEnable, true, false, true, false, 0.8},
                                 {Mode::kStopping, P::kEnable, true, false, true, false, 0.0},
                                 {Mode::kStopped, P::kOff, false, false, false, false, 0.0},
                                 {Mode::kResetting, P::kReset, false, true, false, false, 0.0},
                                 {Mode::kEnding, P::kEnable, true, true, true, true, 0.98},
                                 {Mode::kEnded, P::kOff, false, false, true, false, 0.0}}) {
    SCOPED_TRACE(name(granted.mode));
    Bench bench = bench_in(granted.mode);
    if (granted.mode == Mode::kBoot) {
      bench.seen.drives.all_answer = false;
      bench.step();
    }
    ASSERT_EQ(bench.supervisor.mode(), granted.mode);
    EXPECT_EQ(bench.decision.power, granted.power);
    EXPECT_EQ(bench.decision.holds_arm, granted.holds_arm);
    EXPECT_EQ(bench.decision.rate_limited, granted.rate_limited);
    EXPECT_EQ(bench.decision.of_last, granted.mode == Mode::kFade);
    EXPECT_NEAR(bench.decision.share, granted.share, 1e-12);
    EXPECT_TRUE(bench.decision.test_torque.isZero(0.0));
    EXPECT_EQ(bench.supervisor.follows_positions(), granted.follows_positions);
    EXPECT_EQ(bench.supervisor.renders(), granted.renders);
  }
}

TEST(SupervisorModes, LastAsLongAsTheyAreDocumented) {
  EXPECT_EQ(bench_in(Mode::kZeroCheck).stay() + 1, static_cast<int>(Supervisor::kZero_ms));
  EXPECT_EQ(bench_in(Mode::kFade).stay() + 1, static_cast<int>(Supervisor::kFade_ms));
  EXPECT_EQ(bench_in(Mode::kEngaging).stay() + 1, 10);
  EXPECT_EQ(bench_in(Mode::kEnding).stay() + 1, static_cast<int>(Supervisor::kEndRamp_ms));
  EXPECT_EQ(bench_in(Mode::kStopping).stay() + 1, static_cast<int>(Supervisor::kHold_ms) + 1);
  EXPECT_EQ(bench_in(Mode::kResetting).stay() + 1, 1);
  for (const Mode mode : {Mode::kIdle, Mode::kArmed, Mode::kRunning, Mode::kStopped, Mode::kEnded}) {
    Bench bench = bench_in(mode);
    bench.seen.inside = mode == Mode::kArmed;
    bench.lets_go = false;
    EXPECT_EQ(bench.stay(), -1) << name(mode);
  }
}

/// The same times at other periods; a fade takes two cycles at least, a hold one.
TEST(SupervisorModes, LastForATimeAndNotForACount) {
  for (const auto& [period, a_millisecond] : {std::pair{0.125e-3, 8.0}, {0.25e-3, 4.0}, {2e-3, 0.5}, {10e-3, 0.1}}) {
    Supervisor::Parameters parameters = short_start();
    parameters.period = period;
    const auto cycles = [share = a_millisecond](std::uint32_t ms, int least = 1) {
      return std::max(least, static_cast<int>(std::lround(ms * share)));
    };
    Bench zero(parameters);
    ASSERT_GE(zero.run_to(Mode::kZeroCheck), 0);
    EXPECT_EQ(zero.stay() + 1, cycles(Supervisor::kZero_ms)) << period;
    Bench fade(parameters);
    fade.joints_follow = true;
    ASSERT_GE(fade.run_to(Mode::kRunning), 0) << period;
    for (std::uint32_t k = 1; k <= static_cast<std::uint32_t>(hal::cycles_to_loss(period)); ++k) {
      fade.seen.lost = k;
      fade.step();
    }
    fade.seen.lost = 0;
    ASSERT_EQ(fade.supervisor.mode(), Mode::kFade);
    EXPECT_GT(fade.decision.share, 0.0) << "not at once";
    EXPECT_EQ(fade.stay() + 1, cycles(Supervisor::kFade_ms, 2)) << period;
    ASSERT_EQ(fade.supervisor.mode(), Mode::kStopping);
    EXPECT_EQ(fade.stay() + 1, cycles(Supervisor::kHold_ms) + 1) << period;
    Bench ends(parameters);
    ends.joints_follow = true;
    ASSERT_GE(ends.run_to(Mode::kRunning), 0) << period;
    ends.seen.end_requested = true;
    ends.obeys = false;
    ends.step();
    ASSERT_EQ(ends.supervisor.mode(), Mode::kEnding);
    EXPECT_EQ(ends.stay() + 1, cycles(Supervisor::kEndRamp_ms)) << period;
    EXPECT_EQ(ends.stay() + 1, cycles(Supervisor::kEndStop_ms)) << period;
    EXPECT_EQ(ends.supervisor.mode(), Mode::kEnded);
  }
}

/// Three lost positions in a row, or those of 10 ms if they are fewer: the last torque is not held for longer.
TEST(SupervisorModes, FadeAfterThreeLostPositionsOrTenMilliseconds) {
  for (const auto& [period, losses] : {std::pair{0.125e-3, 3u}, {2e-3, 3u}, {4e-3, 2u}, {5e-3, 2u}, {10e-3, 1u}}) {
    Supervisor::Parameters parameters = short_start();
    parameters.period = period;
    Bench bench(parameters);
    bench.joints_follow = true;
    ASSERT_GE(bench.run_to(Mode::kRunning), 0) << period;
    for (std::uint32_t k = 1; k <= losses; ++k) {
      EXPECT_EQ(bench.supervisor.mode(), Mode::kRunning) << period;
      bench.seen.lost = k;
      bench.step();
    }
    EXPECT_EQ(bench.supervisor.mode(), Mode::kFade) << period;
  }
}

/// A drive that answers only every second SYNC never loses two positions in a row, but half of all.
TEST(SupervisorModes, FadeWhereMoreThanAFifthOfThePositionsAreLost) {
  for (const int every : {2, 3, 4, 5, 6}) {
    Bench bench(short_start());
    bench.joints_follow = true;
    ASSERT_GE(bench.run_to(Mode::kRunning), 0);
    int cycles = 0;
    for (; cycles < 3000 && bench.supervisor.mode() == Mode::kRunning; ++cycles) {
      bench.seen.lost = cycles % every == 0 ? 1 : 0;
      bench.step();
    }
    EXPECT_EQ(bench.supervisor.mode(), every < 5 ? Mode::kFade : Mode::kRunning) << every;
    if (every < 5) {
      EXPECT_EQ(cycles, 200 * every + 1) << "at the 201st";
      EXPECT_EQ(bench.supervisor.fault(), Fault::kPositionLost);
    }
  }
}

TEST(SupervisorModes, WaitForDrivesAndResetsNoLongerThanDocumented) {
  Bench boot;
  boot.seen.drives.all_answer = false;
  EXPECT_EQ(boot.stay(), 300);
  EXPECT_EQ(boot.supervisor.fault(), Fault::kDrivesAbsent);
  Bench late;
  late.seen.drives.all_answer = false;
  for (int i = 0; i < 300; ++i) late.step();
  late.seen.drives.all_answer = true;
  late.step();
  EXPECT_EQ(late.supervisor.mode(), Mode::kZeroCheck) << "in the last cycle";

  Bench resetting = bench_in(Mode::kResetting);
  resetting.obeys = false;
  resetting.seen.drives.any_fault = true;
  EXPECT_EQ(resetting.stay() + 1, static_cast<int>(Supervisor::kFaultStop_ms));
  EXPECT_EQ(resetting.supervisor.mode(), Mode::kStopped);
  EXPECT_EQ(resetting.supervisor.fault(), Fault::kEmergencyStop) << "still latched";
  EXPECT_EQ(resetting.step().power, PowerRequest::kOff);
}

TEST(SupervisorModes, EndWithinTheirTimeThoughNoDriveObeys) {
  for (const Mode mode : {Mode::kSignTest, Mode::kArmed, Mode::kRunning}) {
    Bench bench = bench_in(mode);
    bench.obeys = false;
    bench.seen.end_requested = true;
    ASSERT_GE(bench.run_to(Mode::kStopping), 0);
    for (std::uint32_t i = 2; i <= Supervisor::kHold_ms; ++i) {
      EXPECT_EQ(bench.step().power, PowerRequest::kEnable) << name(mode);
    }
    EXPECT_EQ(bench.stay() + static_cast<int>(Supervisor::kHold_ms), static_cast<int>(Supervisor::kEndStop_ms))
        << name(mode);
    EXPECT_EQ(bench.supervisor.mode(), Mode::kEnded);
    EXPECT_EQ(bench.decision.power, PowerRequest::kQuickStop) << "not seen at rest";
  }
}

/// From any share, in kEndRamp_ms equal steps to zero.
TEST(SupervisorModes, EndingLowersTheShareEvenly) {
  for (int engaged = 1; engaged <= 10; ++engaged) {
    Bench bench = bench_in(Mode::kEngaging);
    for (int i = 0; i < engaged; ++i) bench.step();
    const double share = 0.1 * engaged;
    ASSERT_NEAR(bench.decision.share, share, 1e-12);
    bench.seen.end_requested = true;
    for (std::uint32_t k = 1; k <= Supervisor::kEndRamp_ms; ++k) {
      EXPECT_NEAR(bench.step().share, share * (1.0 - static_cast<double>(k) / Supervisor::kEndRamp_ms), 1e-12);
      EXPECT_GE(bench.decision.share, 0.0);
      ASSERT_EQ(bench.supervisor.mode(), Mode::kEnding);
    }
    bench.step();
    EXPECT_EQ(bench.supervisor.mode(), Mode::kStopping);
    EXPECT_TRUE(is_stop(bench.decision));
  }
}

TEST(SupervisorModes, EngageAtOnceWithoutARamp) {
  Supervisor::Parameters p = short_start();
  p.engage_cycles = 0;
  Bench bench(p);
  ASSERT_GE(bench.run_to(Mode::kRunning), 0);
  EXPECT_EQ(bench.decision.share, 1.0);
}

/// Motion counts from the position at which the mode began, in both directions, of each joint of the arm.
TEST(SupervisorModes, AllowAsMuchMotionAsIsDocumented) {
  struct Allowed {
    Mode mode;
    double motion;
    Fault fault;
  };
  for (const Allowed& allowed : {Allowed{Mode::kZeroCheck, Supervisor::kAtRest, Fault::kNotAtRest},
                                 {Mode::kEnabling, Supervisor::kMovesAway, Fault::kSignWrong},
                                 {Mode::kSignTest, Supervisor::kMovesAway, Fault::kSignWrong}}) {
    for (int joint = 0; joint < 3; ++joint) {
      for (const double direction : {1.0, -1.0}) {
        SCOPED_TRACE(std::string(name(allowed.mode)) + " joint " + std::to_string(joint));
        Bench bench(short_start(/*sign_test=*/true));
        bench.seen.q << 0.7, -0.4, 1.1, 0.0, 0.0, 0.0, 0.0;
        ASSERT_GE(bench.run_to(allowed.mode), 0);
        const double begin = bench.seen.q[joint];
        bench.seen.q[joint] = begin + direction * 0.999 * allowed.motion;
        bench.seen.q[5] = 3.0;  // no joint of this arm
        bench.step();
        EXPECT_EQ(bench.supervisor.fault(), Fault::kNone);
        bench.seen.q[joint] = begin + direction * 1.001 * allowed.motion;
        const bool powered = bench.decision.power == PowerRequest::kEnable;
        bench.step();
        EXPECT_EQ(bench.supervisor.fault(), allowed.fault);
        EXPECT_EQ(bench.supervisor.fault_joint(), -1);
        EXPECT_TRUE(is_stop(bench.decision));
        EXPECT_EQ(bench.decision.power, powered ? PowerRequest::kEnable : PowerRequest::kOff);
      }
    }
  }
}

TEST(SupervisorModes, RenderNothingAgainUntilTheContactForceIsSmallAfterAReset) {
  Bench bench;
  ASSERT_GE(bench.run_to(Mode::kRunning), 0);
  bench.seen.joint_beyond_limit = 1;
  ASSERT_GE(bench.run_to(Mode::kStopped), 0);
  EXPECT_EQ(bench.supervisor.fault_joint(), 1);
  bench.seen.joint_beyond_limit = -1;
  bench.seen.enable_switch = false;
  bench.seen.reset_requested = true;
  ASSERT_GE(bench.run_to(Mode::kIdle), 0);
  EXPECT_EQ(bench.supervisor.fault(), Fault::kNone);
  EXPECT_EQ(bench.supervisor.fault_joint(), -1);
  bench.seen.reset_requested = false;
  bench.seen.enable_switch = true;
  bench.seen.contact_force = 10.0;
  ASSERT_GE(bench.run_to(Mode::kArmed), 0);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(bench.step().share, 0.0);
  bench.seen.contact_force = 0.0;
  EXPECT_EQ(bench.step().share, 0.0);
  EXPECT_NEAR(bench.step().share, 0.1, 1e-12) << "from zero again";
}

/// Who leads the tool out of an object pushes it before it engages; only a long way is then a drift.
TEST(SupervisorModes, LetTheOperatorLeadTheToolOut) {
  for (const bool far : {false, true}) {
    for (const bool engaging : {false, true}) {
      Bench bench = bench_in(Mode::kArmed);
      const bool presses = far == engaging;  // or is inside
      bench.seen.inside = !presses;
      bench.seen.contact_force = presses ? 5.0 : 0.0;
      bench.step();
      if (engaging) bench.seen.inside = false;
      if (engaging) bench.seen.contact_force = 0.0;
      bench.step();
      ASSERT_EQ(bench.supervisor.mode(), engaging ? Mode::kEngaging : Mode::kArmed);
      bench.seen.drifts_early = true;
      bench.seen.drifts = far;
      bench.step();
      EXPECT_EQ(bench.supervisor.fault(), far ? Fault::kDrifts : Fault::kNone) << engaging;
    }
  }
}

/// The next time that it gets power the arm is not led out.
TEST(SupervisorModes, ForgetThatTheOperatorLedTheToolOut) {
  Bench bench = bench_in(Mode::kArmed);
  bench.seen.inside = true;
  bench.step();
  bench.seen.emergency_stop = true;
  ASSERT_GE(bench.run_to(Mode::kStopped), 0);
  bench.seen.emergency_stop = bench.seen.enable_switch = bench.seen.inside = false;
  bench.seen.reset_requested = true;
  ASSERT_GE(bench.run_to(Mode::kIdle), 0);
  bench.seen.reset_requested = false;
  bench.seen.enable_switch = true;
  ASSERT_GE(bench.run_to(Mode::kEngaging), 0);
  bench.seen.drifts_early = true;
  bench.step();
  EXPECT_EQ(bench.supervisor.fault(), Fault::kNotBalanced);
}

/// While it waits for the switch somebody may move a joint; motion counts from the moment at which power is asked for.
TEST(SupervisorModes, CountMotionOfAPoweredJointFromTheRequestForPower) {
  Bench bench(short_start(/*sign_test=*/true));
  bench.seen.enable_switch = false;
  ASSERT_GE(bench.run_to(Mode::kIdle), 0);
  bench.seen.q.head<3>() << 0.3, -0.3, 1.0;
  bench.step();
  bench.seen.enable_switch = true;
  ASSERT_GE(bench.run_to(Mode::kSignTest), 0);
  bench.step();
  EXPECT_EQ(bench.supervisor.fault(), Fault::kNone);
}

/// A drive that shows itself enabled again does not take a quick stop back.
TEST(SupervisorModes, ContinueAQuickStopOnceItHasBegun) {
  Bench bench = bench_in(Mode::kRunning);
  bench.obeys = false;
  const DriveSummary enabled = bench.seen.drives;
  bench.seen.drives.all_enabled = false;
  EXPECT_EQ(bench.step().power, PowerRequest::kQuickStop);
  bench.seen.drives = enabled;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(bench.step().power, PowerRequest::kQuickStop) << i;
}

TEST(SupervisorModes, BeginTheSignTestAnewAfterAReset) {
  Bench bench(short_start(/*sign_test=*/true));
  bench.joints_follow = true;
  ASSERT_GE(bench.run_to(Mode::kSignTest), 0);
  while (bench.step().test_torque[1] == 0.0) ASSERT_LT(bench.cycles, 5000);  // joint 0 has passed
  bench.seen.emergency_stop = true;
  ASSERT_GE(bench.run_to(Mode::kStopped), 0);
  bench.seen.emergency_stop = bench.seen.enable_switch = false;
  bench.seen.reset_requested = true;
  ASSERT_GE(bench.run_to(Mode::kIdle), 0);
  bench.seen.reset_requested = false;
  bench.seen.enable_switch = true;
  ASSERT_GE(bench.run_to(Mode::kSignTest), 0);
  EXPECT_TRUE(bench.decision.test_torque.isZero(0.0)) << "not the torque at which it was broken off";
  while (bench.step().test_torque.isZero(0.0)) ASSERT_EQ(bench.supervisor.mode(), Mode::kSignTest);
  EXPECT_GT(bench.decision.test_torque[0], 0.0);
  ASSERT_GE(bench.run_to(Mode::kArmed), 0);
}

/// Joint 2 is tested last; a sign that is wrong, or a joint that does not move, is named.
TEST(SupervisorModes, NameTheJointWhoseSignIsWrongOrUndecided) {
  for (const double gain : {-1e-2, 0.0}) {
    for (int joint = 0; joint < 3; ++joint) {
      Bench bench(short_start(/*sign_test=*/true));
      ASSERT_GE(bench.run_to(Mode::kSignTest), 0);
      for (int i = 0; i < 10'000 && bench.supervisor.mode() == Mode::kSignTest; ++i) {
        JointVector motion = 1e-2 * bench.step().test_torque;
        if (motion[joint] != 0.0) motion[joint] *= gain / 1e-2;
        bench.seen.q += motion;
      }
      EXPECT_EQ(bench.supervisor.fault(), gain < 0.0 ? Fault::kSignWrong : Fault::kSignUndecided) << joint;
      EXPECT_EQ(bench.supervisor.fault_joint(), joint);
      EXPECT_EQ(bench.supervisor.mode(), Mode::kStopping);
    }
  }
}

TEST(SupervisorModes, StopsAtRestOnlyAfterTheHoldThoughTheDrivesRestAtOnce) {
  Bench bench = bench_in(Mode::kRunning);
  bench.obeys = false;
  bench.seen.drives = {true, false, true, true, true};  // all have tripped
  std::vector<Mode> modes;
  for (std::uint32_t i = 0; i <= Supervisor::kHold_ms; ++i) {
    bench.step();
    modes.push_back(bench.supervisor.mode());
  }
  std::vector<Mode> expected(Supervisor::kHold_ms, Mode::kStopping);
  expected.push_back(Mode::kStopped);
  EXPECT_EQ(modes, expected);
}

}  // namespace
}  // namespace godobject::firmware::supervisor_modes_test
