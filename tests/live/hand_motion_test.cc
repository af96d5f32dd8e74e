#include "toolchain/live/hand_motion.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace godobject::live::hand_motion_test {
namespace {

constexpr HandMotion::Limits kLimits{.speed = 0.3, .turn = 2.0, .stretch = 0.1, .twist = 0.5};

double angle(const Pose& a, const Pose& b) { return log_rotation(a.rotation * b.rotation.conjugate()).norm(); }

TEST(HandMotion, ReachesAGoalWithoutOvershoot) {
  const Pose goal{exp_rotation(Vector3(0.0, 0.0, 0.3)), Vector3(0.05, 0.0, 0.0)};
  HandMotion hand(kLimits, {});
  hand.set_goal(goal);
  double farthest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    hand.advance(1e-3, hand.pose());
    farthest = std::max(farthest, hand.pose().translation.x());
  }
  EXPECT_NEAR(hand.pose().translation.x(), 0.05, 1e-6);
  EXPECT_LT(angle(hand.pose(), goal), 1e-6);
  EXPECT_LT(farthest, 0.05 + 1e-6);
  EXPECT_LT(hand.velocity().translation.norm(), 1e-6);
}

/// The velocity belongs to the motion, at any period, and stays below the limits.
TEST(HandMotion, KeepsItsLimitsWhateverTheGoals) {
  test::Random random(5);
  for (const double period : {1.25e-4, 1e-3, 1e-2}) {
    HandMotion hand(kLimits, {});
    for (int i = 0; i < 4000; ++i) {
      if (i % 37 == 0) hand.set_goal({exp_rotation(random.motion(0.0, 3.0).rotation), random.in_cube(2.0)});
      const Pose before = hand.pose();
      hand.advance(period, before);
      ASSERT_TRUE(hand.pose().is_finite());
      EXPECT_LE(hand.velocity().translation.norm(), kLimits.speed * (1.0 + 1e-9));
      EXPECT_LE(hand.velocity().rotation.norm(), kLimits.turn * (1.0 + 1e-9));
      const Vector3 moved = hand.pose().translation - before.translation;
      EXPECT_LT((moved - period * hand.velocity().translation).norm(), 1e-12);
      EXPECT_NEAR(angle(hand.pose(), before), period * hand.velocity().rotation.norm(), 1e-9);
    }
  }
}

/// A mesh that is held back: the hand stops at the stretch, so that its spring stays within its force.
TEST(HandMotion, StaysNearAMeshThatIsHeldBack) {
  HandMotion hand(kLimits, {});
  hand.set_goal({exp_rotation(Vector3(2.0, 0.0, 0.0)), Vector3(5.0, 0.0, 0.0)});
  for (int i = 0; i < 5000; ++i) {
    hand.advance(1e-3, {});
    EXPECT_LE(hand.pose().translation.norm(), kLimits.stretch + 1e-9);
    EXPECT_LE(angle(hand.pose(), {}), kLimits.twist + 1e-9);
  }
  EXPECT_NEAR(hand.pose().translation.x(), kLimits.stretch, 1e-6);
}

/// A weak hand pulls less, at once, and one without strength not at all.
TEST(HandMotion, PullsByItsStrength) {
  HandMotion hand(kLimits, {});
  hand.set_goal({exp_rotation(Vector3(2.0, 0.0, 0.0)), Vector3(5.0, 0.0, 0.0)});
  for (int i = 0; i < 1000; ++i) hand.advance(1e-3, {});
  hand.advance(1e-3, {}, 0.25);
  EXPECT_LE(hand.pose().translation.norm(), 0.25 * kLimits.stretch + 1e-9);
  EXPECT_LE(angle(hand.pose(), {}), 0.25 * kLimits.twist + 1e-9);
  const Pose thrown{Quaternion::Identity(), Vector3(-1.0, 0.0, 0.0)};
  hand.advance(1e-3, thrown, 0.0);
  EXPECT_LT((hand.pose().translation - thrown.translation).norm(), 1e-9);
}

}  // namespace
}  // namespace godobject::live::hand_motion_test
