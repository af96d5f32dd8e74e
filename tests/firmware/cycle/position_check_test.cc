#include "firmware/cycle/position_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace godobject::firmware {
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

}  // namespace
}  // namespace godobject::firmware
