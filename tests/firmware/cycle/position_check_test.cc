#include "firmware/cycle/position_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/random.h"

namespace godobject::firmware::position_check_test {
namespace {

constexpr double kT = 1e-3;

/// Two joints of 2 rad/s and 10 Nm: a jump is more than 3 mrad a cycle, pushed is more than 0.05 Nm.
class PositionCheckTest : public testing::Test {
 protected:
  PositionCheckTest() : check_(arm(), 0.005, kT) {}

  static ArmModel arm() {
    ArmModel model;
    model.joint_count = 2;
    for (int i = 0; i < 2; ++i) {
      model.joints[static_cast<std::size_t>(i)].velocity = 2.0;
      model.joints[static_cast<std::size_t>(i)].torque = 10.0;
    }
    return model;
  }

  const CheckedPositions& step(std::uint32_t skipped = 0) {
    check_.update(reading_, qd_, pushed_, skipped, checked_);
    return checked_;
  }

  PositionCheck check_;
  hal::JointReading reading_;
  JointVector qd_ = JointVector::Zero();
  JointVector pushed_ = JointVector::Zero();
  CheckedPositions checked_;
};

TEST_F(PositionCheckTest, TakesFreshPositionsAsTheyAre) {
  reading_.position[0] = 1.0;
  for (int i = 0; i < 200; ++i) {
    reading_.position[0] += 0.0029;
    reading_.position[1] -= 0.001;
    const CheckedPositions& checked = step();
    ASSERT_EQ(checked.q, reading_.position);
    ASSERT_EQ(checked.lost + checked.jumps, 0u);
    ASSERT_TRUE(checked.finite);
  }
}

TEST_F(PositionCheckTest, PredictsWhatIsLostWithTheVelocity) {
  reading_.position[0] = 0.5;
  step();
  qd_[0] = 1.0;
  for (std::uint32_t k = 1; k <= 2; ++k) {
    reading_.age[0] = k;
    EXPECT_NEAR(step().q[0], 0.5 + 1e-3 * k, 1e-15);
    EXPECT_EQ(checked_.lost, k);
  }
  reading_.age[0] = 0;
  reading_.position[0] = 0.504;  // 4 mrad in three cycles is possible
  EXPECT_EQ(step().q[0], 0.504);
  EXPECT_EQ(checked_.jumps, 0u);
}

TEST_F(PositionCheckTest, CountsPositionsAsLostThatAreAlwaysLate) {
  step();
  for (std::uint32_t k = 1; k <= 5; ++k) {
    reading_.position[0] += 1e-4;
    reading_.age[0] = 1;
    EXPECT_EQ(step().lost, k);
    EXPECT_EQ(checked_.q[0], 0.0) << "a late position is never taken for a fresh one";
  }
}

TEST_F(PositionCheckTest, PredictsOverAJumpAndTakesWhatIsPossibleAgain) {
  reading_.position[1] = 0.1;
  step();
  qd_[1] = 1.0;
  reading_.position[1] = 0.104;
  EXPECT_NEAR(step().q[1], 0.101, 1e-15);
  EXPECT_EQ(checked_.jumps, 1u);
  reading_.position[1] = 0.102;
  EXPECT_EQ(step().q[1], 0.102);
  EXPECT_EQ(checked_.jumps, 0u);
}

TEST_F(PositionCheckTest, CountsJumpsInARow) {
  step();
  for (std::uint32_t k = 1; k <= 4; ++k) {
    reading_.position[0] = 0.1;
    EXPECT_EQ(step().jumps, k);
    EXPECT_EQ(checked_.q[0], 0.0);
  }
}

/// Lost and jumped by turns: what cannot be used is counted in a row whatever its cause.
TEST_F(PositionCheckTest, CountsCyclesWithoutAPositionWhateverTheCause) {
  step();
  std::uint32_t predicted = 0;
  for (const char cause : {'L', 'L', 'J', 'L', 'L', 'J', 'L'}) {
    reading_.age[0] = cause == 'L' ? reading_.age[0] + 1 : 0;
    reading_.position[0] = cause == 'L' ? 0.0 : 0.1;
    EXPECT_EQ(step().predicted, ++predicted);
  }
  reading_.age[0] = 0;
  reading_.position[0] = 1e-3;
  EXPECT_EQ(step().predicted, 0u);
}

TEST_F(PositionCheckTest, TellsAJointThatRunsAwayFromAnEncoderThatJumps) {
  step();
  reading_.position[0] = 0.004;
  EXPECT_FALSE(step().runs_away);
  reading_.position[0] = 0.010;
  EXPECT_TRUE(step().runs_away);
  EXPECT_EQ(checked_.jumps, 2u);
  for (const double second : {0.004, -0.004, 0.006, 0.0035}) {
    check_.restart();
    reading_.position[0] = 0.0;
    step();
    reading_.position[0] = 0.004;
    step();
    reading_.position[0] = second;
    EXPECT_FALSE(step().runs_away) << second;
  }
}

/// The first position is no jump from zero, nor from a position before the restart.
TEST_F(PositionCheckTest, TakesTheFirstJumpAfterAStartForNoneThatGoesOn) {
  for (const double start : {1.0, -1.0, 2.5}) {
    check_.restart();
    reading_.position[0] = start;
    step();
    for (const double to : {-start, 0.5 * start, 2.0 * start}) {
      reading_.position[0] = to;
      EXPECT_FALSE(step().runs_away) << start << " to " << to;
      reading_.position[0] = start;
      step();
    }
  }
}

TEST_F(PositionCheckTest, AllowsForPeriodsThatWereSkipped) {
  step();
  reading_.position[0] = 0.0085;  // 2.1 mrad a period
  EXPECT_EQ(step(3).jumps, 0u);
  EXPECT_EQ(checked_.q[0], 0.0085);
}

TEST_F(PositionCheckTest, TellsWhatIsNotFinite) {
  step();
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    reading_.position[1] = bad;
    EXPECT_FALSE(step().finite);
    EXPECT_TRUE(checked_.q.allFinite());
    reading_.position[1] = 0.0;
    reading_.torque[0] = bad;
    EXPECT_FALSE(step().finite);
    reading_.torque[0] = 0.0;
    EXPECT_TRUE(step().finite);
  }
}

TEST_F(PositionCheckTest, FindsAStuckEncoderWithinAHundredCyclesWhereverItBegins) {
  for (int begin = 0; begin < 2 * static_cast<int>(PositionCheck::kWindow); ++begin) {
    PositionCheck check(arm(), 0.005, kT);
    pushed_ = JointVector::Zero();
    pushed_[0] = 0.5;
    reading_ = hal::JointReading();
    int found = -1;
    for (int k = 0; k < begin + 101; ++k) {
      reading_.position[1] += 1e-4;
      if (k < begin) reading_.position[0] += 1e-5;
      check.update(reading_, qd_, pushed_, 0, checked_);
      ASSERT_FALSE(checked_.stuck && k < begin);
      if (checked_.stuck && found < 0) found = k - begin;
    }
    EXPECT_GE(found, 0) << begin;
    EXPECT_LT(found, 100) << begin;
  }
}

TEST_F(PositionCheckTest, FindsAnEncoderThatStopsInMidMotionThoughNothingPushesIt) {
  for (int i = 0; i < 20; ++i) {
    reading_.position[0] += 3e-5;
    ASSERT_FALSE(step().stuck);
  }
  int cycles = 1;
  while (!step().stuck && cycles < 200) ++cycles;
  EXPECT_EQ(cycles, static_cast<int>(PositionCheck::kStill));
}

/// At 4 kHz a slow joint does not change its counter in every cycle. Rest is looked for in samples of a millisecond.
TEST_F(PositionCheckTest, LooksForRestInMillisecondsAlsoAtHigherRates) {
  for (const double period : {0.125e-3, 0.25e-3, 0.5e-3}) {
    const int cycles_a_sample = static_cast<int>(std::lround(1e-3 / period));
    PositionCheck check(arm(), 0.005, period);
    hal::JointReading reading;
    CheckedPositions checked;
    const auto step = [&] {
      check.update(reading, qd_, pushed_, 0, checked);
      return checked.stuck;
    };
    // 0.04 rad/s on an encoder of 2e-5 rad: a change in every millisecond
    int k = 0;
    for (; k < 50 * cycles_a_sample; ++k) {
      reading.position[0] = 2e-5 * std::floor(0.04 * period * k / 2e-5);
      ASSERT_FALSE(step()) << period;
    }
    int cycles = 1;
    while (!step() && cycles < 1000) ++cycles;
    EXPECT_GE(cycles, static_cast<int>(PositionCheck::kStill - 1) * cycles_a_sample) << period;
    EXPECT_LE(cycles, static_cast<int>(PositionCheck::kStill + 1) * cycles_a_sample) << period;
  }
}

TEST_F(PositionCheckTest, JumpsByTheSpeedOfItsPeriod) {
  for (const double period : {0.25e-3, 10e-3}) {
    for (const double share : {0.99, 1.01}) {
      PositionCheck check(arm(), 0.005, period);
      hal::JointReading reading;
      CheckedPositions checked;
      check.update(reading, qd_, pushed_, 0, checked);
      reading.position[0] = share * 1.5 * 2.0 * period;
      check.update(reading, qd_, pushed_, 0, checked);
      EXPECT_EQ(checked.jumps, share > 1.0 ? 1u : 0u) << period;
    }
  }
}

TEST_F(PositionCheckTest, LetsAJointComeToRestByItselfAndCountsBeSlow) {
  // decelerated by 5 rad/s^2 on an encoder of 1e-5 rad, then at rest; then slow motion, a count in three cycles
  double q = 0.0;
  for (double v = 0.1; v > 0.0; v -= 5e-3) {
    q += 1e-3 * v;
    reading_.position[0] = 1e-5 * std::round(q / 1e-5);
    ASSERT_FALSE(step().stuck);
  }
  for (int i = 0; i < 200; ++i) ASSERT_FALSE(step().stuck);
  for (int i = 0; i < 300; ++i) {
    reading_.position[0] = 1e-5 * std::round((q + 3.3e-6 * i) / 1e-5);
    ASSERT_FALSE(step().stuck);
  }
  for (int i = 0; i < 200; ++i) ASSERT_FALSE(step().stuck);
}

TEST_F(PositionCheckTest, DoesNotCallAHandStuckThatHoldsStillOrMovesInAPlane) {
  pushed_[0] = 5.0;  // pressed against a wall: nothing moves
  for (int i = 0; i < 1000; ++i) ASSERT_FALSE(step().stuck);
  pushed_[0] = 0.04;  // hardly pushed, the other joint moves
  for (int i = 0; i < 1000; ++i) {
    reading_.position[1] += 1e-3;
    ASSERT_FALSE(step().stuck);
  }
}

TEST_F(PositionCheckTest, LetsAPushedJointTurnRoundInASlowMotion) {
  pushed_[0] =
      5.0;  // a parabola of 0.01 rad/s^2 about its top, on an encoder of 6e-6 rad, while the other joint creeps
  for (int i = -1000; i < 1000; ++i) {
    reading_.position[0] = 6e-6 * std::round(-0.5 * 0.01 * 1e-6 * i * i / 6e-6);
    reading_.position[1] += 3e-5;
    ASSERT_FALSE(step().stuck) << i;
  }
}

TEST_F(PositionCheckTest, StartsAnewFromWhatItReads) {
  step();
  check_.restart();
  reading_.position[0] = 2.0;
  EXPECT_EQ(step().q[0], 2.0);
  EXPECT_EQ(checked_.jumps, 0u);
}

/// One joint, judged from the whole list of its readings.
struct History {
  struct Cycle {
    double position, q;
    std::uint32_t age, periods;
    bool accepted;
  };
  double largest_step;  // in a period [rad]
  std::vector<Cycle> cycles;
  std::uint32_t lost = 0, jumps = 0, predicted = 0;
  bool runs_away = false;

  void add(double position, std::uint32_t age, std::uint32_t periods, double qd) {
    lost = jumps = predicted = 0;
    runs_away = false;
    if (cycles.empty()) {
      cycles.push_back({position, position, age, periods, true});
      lost = std::max(age, age > 0 ? 1u : 0u);
      return;
    }
    const double last_q = cycles.back().q;
    double last_fresh = cycles.front().position;
    for (const Cycle& cycle : cycles) last_fresh = cycle.age == 0 ? cycle.position : last_fresh;
    cycles.push_back({position, 0.0, age, periods, false});
    std::size_t from = cycles.size() - 1;
    std::uint32_t elapsed = 0;
    while (!cycles[from].accepted) {
      elapsed += cycles[from].periods;
      jumps += cycles[from].age == 0 ? 1u : 0u;
      ++predicted;
      --from;
    }
    const double accepted = cycles[from].position;
    for (std::size_t k = cycles.size(); k > 0 && cycles[k - 1].age > 0; --k) ++lost;
    lost = std::max(lost, age);
    Cycle& now = cycles.back();
    now.accepted = age == 0 && std::fabs(position - accepted) <= largest_step * elapsed;
    now.q = now.accepted ? position : last_q + qd * kT * periods;
    const double far = largest_step * periods;
    const double first = last_fresh - accepted;
    const double second = position - last_fresh;
    const bool far_on = (first > far && second > far) || (first < -far && second < -far);
    runs_away = !now.accepted && age == 0 && jumps > 1 && far_on;
    if (now.accepted) jumps = predicted = 0;
  }
};

/// Random readings, some lost, late or impossible, with periods skipped between.
TEST_F(PositionCheckTest, AgreesWithAJudgementFromTheWholeHistory) {
  test::Random random(2);
  int runaways = 0, jumps = 0, lost = 0;
  for (int run = 0; run < 60; ++run) {
    check_.restart();
    std::vector<History> joints(2, History{1.5 * 2.0 * kT, {}});
    reading_ = hal::JointReading();
    // a restart forgets everything but the lost positions in a row
    step();
    check_.restart();
    for (int cycle = 0; cycle < 200; ++cycle) {
      const std::uint32_t skipped = random.integer(0, 7) == 0 ? static_cast<std::uint32_t>(random.integer(1, 3)) : 0;
      for (int i = 0; i < 2; ++i) {
        const int kind = cycle == 0 ? 9 : random.integer(0, 9);
        const auto joint = static_cast<std::size_t>(i);
        reading_.age[joint] = kind < 2 ? reading_.age[joint] + 1 + skipped : kind == 2 ? 1 : 0;
        reading_.position[i] += kind == 3   ? random.between(-0.02, 0.02)
                                : kind == 4 ? random.between(0.002, 0.008)
                                            : random.between(-0.0025, 0.0025);
        qd_[i] = random.between(-2.0, 2.0);
      }
      const CheckedPositions& checked = step(skipped);
      CheckedPositions expected;
      for (int i = 0; i < 2; ++i) {
        const auto joint = static_cast<std::size_t>(i);
        History& history = joints[joint];
        history.add(reading_.position[i], reading_.age[joint], 1 + skipped, qd_[i]);
        ASSERT_NEAR(checked.q[i], history.cycles.back().q, 1e-12) << run << ' ' << cycle;
        expected.lost = std::max(expected.lost, history.lost);
        expected.jumps = std::max(expected.jumps, history.jumps);
        expected.predicted = std::max(expected.predicted, history.predicted);
        expected.runs_away |= history.runs_away;
      }
      expected.predicted = std::max(expected.predicted, expected.lost);
      ASSERT_EQ(checked.lost, expected.lost) << run << ' ' << cycle;
      ASSERT_EQ(checked.jumps, expected.jumps) << run << ' ' << cycle;
      ASSERT_EQ(checked.predicted, expected.predicted) << run << ' ' << cycle;
      ASSERT_EQ(checked.runs_away, expected.runs_away) << run << ' ' << cycle;
      ASSERT_TRUE(checked.finite);
      runaways += checked.runs_away ? 1 : 0;
      jumps += checked.jumps > 0 ? 1 : 0;
      lost += checked.lost > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(runaways, 20);
  EXPECT_GT(jumps, 1000);
  EXPECT_GT(lost, 1000);
}

/// A start takes the reading as it is, even an old one, and predicts nothing.
TEST_F(PositionCheckTest, StartsWithAnOldReadingAsItIs) {
  qd_.setConstant(1.0);
  reading_.position[0] = 2.0;
  reading_.age[0] = 1;
  EXPECT_EQ(step().q[0], 2.0);
  EXPECT_EQ(checked_.lost, 1u);
  EXPECT_EQ(checked_.predicted, 1u);
  EXPECT_EQ(checked_.jumps, 0u);
}

/// Wherever the joints were before a restart: one jump after it is one jump.
TEST_F(PositionCheckTest, ForgetsPositionsOfBeforeARestart) {
  for (const double before : {-1.0, 1.0}) {
    reading_.position[0] = before;
    step();
    step();
    check_.restart();
    reading_.position[0] = 0.0;
    step();
    reading_.position[0] = before > 0.0 ? -0.1 : 0.1;
    EXPECT_FALSE(step().runs_away);
    EXPECT_EQ(checked_.jumps, 1u);
    check_.restart();
  }
}

/// Each number of each joint of the arm, and none of the others.
TEST_F(PositionCheckTest, LooksForNumbersThatAreNotFiniteInTheJointsOfTheArm) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (int joint = 0; joint < kMaxJoints; ++joint) {
      for (const bool torque : {false, true}) {
        reading_ = hal::JointReading();
        step();
        (torque ? reading_.torque : reading_.position)[joint] = bad;
        EXPECT_EQ(step().finite, joint >= 2) << joint;
      }
    }
  }
}

/// A reading that is not finite starts nothing: the next finite one is taken as it is.
TEST_F(PositionCheckTest, StartsWithTheFirstFiniteReading) {
  reading_.position[0] = std::nan("");
  EXPECT_FALSE(step().finite);
  reading_.position[0] = 1.5;
  EXPECT_EQ(step().q[0], 1.5);
  EXPECT_EQ(checked_.jumps, 0u);
  reading_.position[0] = 1.6;
  EXPECT_EQ(step().jumps, 1u);
}

/// A joint moves for `moving` cycles at `speed` and then reads the same; the cycle of this rest in which it is found to
/// stick, 0: it is not. `missing`: a cycle of the rest without a fresh reading.
int stuck_after(PositionCheck check, int joint, int moving, double speed, int missing = 0) {
  hal::JointReading reading;
  CheckedPositions checked;
  const auto step = [&] { check.update(reading, JointVector::Zero(), JointVector::Zero(), 0, checked); };
  for (int i = 0; i < 10; ++i) step();
  for (int i = 0; i < moving; ++i) {
    reading.position[joint] += speed * kT;
    step();
    if (checked.stuck) return -1;
  }
  for (int rest = 1; rest < 200; ++rest) {
    reading.age[static_cast<std::size_t>(joint)] = rest == missing ? 1 : 0;
    step();
    if (checked.stuck) return rest;
  }
  return 0;
}

/// Four cycles at 0.007 of 2 rad/s, then 40 without a change.
TEST_F(PositionCheckTest, FindsAnAbruptRestBeyondEachThreshold) {
  const int still = static_cast<int>(PositionCheck::kStill);
  const int moving = static_cast<int>(PositionCheck::kMoving);
  const double slow = PositionCheck::kMotion * 2.0;
  for (const int joint : {0, 1}) {
    for (const double direction : {1.0, -1.0}) {
      EXPECT_EQ(stuck_after(check_, joint, moving, direction * 1.01 * slow), still);
      EXPECT_EQ(stuck_after(check_, joint, moving, direction * 0.99 * slow), 0);
      EXPECT_EQ(stuck_after(check_, joint, moving - 1, direction * 2.0 * slow), 0) << "too short";
      EXPECT_EQ(stuck_after(check_, joint, 50, direction * 1.01 * slow), still);
      EXPECT_EQ(stuck_after(check_, joint, 50, direction * 1.01 * slow, 20), still + 1) << "without one reading";
    }
  }
}

/// A motion begins with the first change that is read, also where the reading at the start is an old one.
TEST_F(PositionCheckTest, CountsNoMotionBeforeTheFirstReading) {
  const int kMoving = static_cast<int>(PositionCheck::kMoving);
  for (const std::uint32_t age : {0u, 1u}) {
    for (const int moving : {kMoving - 1, kMoving}) {
      PositionCheck check(arm(), 0.005, kT);
      hal::JointReading reading;
      reading.age[0] = age;
      check.update(reading, qd_, pushed_, 0, checked_);
      reading.age[0] = 0;
      for (int i = 0; i < moving; ++i) {
        reading.position[0] += 1e-3;
        check.update(reading, qd_, pushed_, 0, checked_);
      }
      bool stuck = false;
      for (std::uint32_t i = 0; i < PositionCheck::kStill; ++i) {
        check.update(reading, qd_, pushed_, 0, checked_);
        stuck = stuck || checked_.stuck;
      }
      EXPECT_EQ(stuck, moving == kMoving) << age;
    }
  }
}

/// A start is no motion from zero: a joint that reads a little more in the first cycles, and then rests, is not stuck.
TEST_F(PositionCheckTest, TakesTheFirstReadingForNoMotion) {
  for (const int moving : {1, 2, 3}) {
    check_.restart();
    reading_.position[0] = 1.0;
    step();
    for (int i = 0; i < moving; ++i) {
      reading_.position[0] += 1e-6;
      step();
    }
    for (int i = 0; i < 200; ++i) ASSERT_FALSE(step().stuck) << moving;
  }
}

/// Motion in bursts, with a rest in between, is no steady motion that could end abruptly.
TEST_F(PositionCheckTest, TakesMotionInBurstsForNoAbruptRest) {
  const auto move = [&](int cycles) {
    for (int i = 0; i < cycles; ++i) {
      reading_.position[0] += 1e-3;
      ASSERT_FALSE(step().stuck);
    }
  };
  for (int i = 0; i < 10; ++i) step();
  for (int burst = 0; burst < 5; ++burst) {
    move(static_cast<int>(PositionCheck::kMoving) - 1);
    ASSERT_FALSE(step().stuck);
  }
  move(1);
  for (int i = 0; i < 200; ++i) ASSERT_FALSE(step().stuck);
}

/// The other joint must move in the same window: one that came to rest before does not count.
TEST_F(PositionCheckTest, ForgetsMotionsOfEarlierWindows) {
  std::vector<int> found;
  pushed_[0] = 1.0;
  for (int cycle = 1; cycle <= 200; ++cycle) {
    reading_.position[1] += cycle < 90 ? 1e-4 : cycle < 100 ? 1e-5 : 0.0;  // comes to rest gently
    if (step().stuck) found.push_back(cycle);
  }
  EXPECT_EQ(found, (std::vector<int>{48, 96}));
}

/// The joint stays stuck until its position changes, and is found again only after another motion.
TEST_F(PositionCheckTest, EndsAnAbruptRestWithTheNextChange) {
  for (int i = 0; i < 10; ++i) {
    reading_.position[0] += 1e-3;
    ASSERT_FALSE(step().stuck);
  }
  for (std::uint32_t i = 1; i < PositionCheck::kStill; ++i) ASSERT_FALSE(step().stuck);
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(step().stuck);
  reading_.position[0] += 1e-5;
  EXPECT_FALSE(step().stuck);
  for (int i = 0; i < 200; ++i) ASSERT_FALSE(step().stuck);
  // a restart forgets a motion
  for (int i = 0; i < 10; ++i) {
    reading_.position[0] += 1e-3;
    step();
  }
  check_.restart();
  for (int i = 0; i < 200; ++i) ASSERT_FALSE(step().stuck);
}

/// Windows of 48 cycles in which joint `stuck` is pushed and rests while the other one moves.
struct Window {
  double pushed = 0.06;   ///< of the limit of 10 Nm, 0.05 Nm is 0.005
  double moves = 1e-4;    ///< by the other joint in a cycle [rad]
  double creeps = 0.0;    ///< by the stuck joint, in one cycle of each window [rad]
  bool missing = false;   ///< one reading of the stuck joint in each window
  bool released = false;  ///< not pushed in one cycle of each window
};

/// The cycles, from 1, of 200 in which a joint is found to stick.
std::vector<int> found_in(PositionCheck check, int stuck, const Window& window) {
  hal::JointReading reading;
  CheckedPositions checked;
  std::vector<int> found;
  const int period = static_cast<int>(PositionCheck::kWindow);
  for (int cycle = 1; cycle <= 200; ++cycle) {
    JointVector pushed = JointVector::Zero();
    const bool chosen = cycle % period == 20;
    pushed[stuck] = window.released && chosen ? 0.0 : window.pushed;
    reading.position[1 - stuck] += window.moves;
    if (chosen) reading.position[stuck] += window.creeps;
    reading.age[static_cast<std::size_t>(stuck)] = window.missing && chosen ? 1 : 0;
    check.update(reading, JointVector::Zero(), pushed, 0, checked);
    if (checked.stuck) found.push_back(cycle);
  }
  return found;
}

TEST_F(PositionCheckTest, FindsAPushedJointThatRestsBeyondEachThreshold) {
  const std::vector<int> each{48, 96, 144, 192};
  const std::vector<int> none;
  const double least = PositionCheck::kOtherMotion * 48 * 2.0 * kT / 47;  // a cycle: 47 steps in a window
  for (const int stuck : {0, 1}) {
    for (const double sign : {1.0, -1.0}) {
      EXPECT_EQ(found_in(check_, stuck, {.pushed = sign * 0.0501}), each);
      EXPECT_EQ(found_in(check_, stuck, {.pushed = sign * 0.0499}), none);
      EXPECT_EQ(found_in(check_, stuck, {.moves = sign * 1.01 * least}), each);
      EXPECT_EQ(found_in(check_, stuck, {.moves = sign * 0.99 * least}), none);
      EXPECT_EQ(found_in(check_, stuck, {.creeps = sign * 1e-9}), none);
    }
    EXPECT_EQ(found_in(check_, stuck, {.missing = true}), none);
    EXPECT_EQ(found_in(check_, stuck, {.released = true}), none);
  }
}

/// A joint that the arm lacks does not stick, and its motion is no other joint's.
TEST_F(PositionCheckTest, IgnoresJointsThatTheArmLacks) {
  pushed_.setConstant(1.0);
  for (int i = 0; i < 200; ++i) {
    reading_.position[2] += 1e-3;
    ASSERT_FALSE(step().stuck) << "no joint of the arm moves";
  }
  for (int i = 0; i < 200; ++i) {
    reading_.position.head<2>().array() += 1e-4;
    ASSERT_FALSE(step().stuck) << "both joints move";
    ASSERT_EQ(checked_.q[2], 0.0);
  }
}

}  // namespace
}  // namespace godobject::firmware::position_check_test
