#include "firmware/cycle/hand_limits.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace godobject::firmware {
namespace {

HandLimits limits() { return {10.0, 1.0, 0.5, 1.0, 2.0, 4.0}; }

TEST(HandLimits, LeaveASmallWrenchOfASlowHandAsItIs) {
  const Wrench wrench{Vector3(1, -2, 3), Vector3(0.1, 0.2, -0.3)};
  const LimitedWrench limited = limit_at_hand(limits(), wrench, {Vector3(0.3, 0, 0), Vector3(0, 1, 0)});
  EXPECT_EQ(limited.F_G_R.force, wrench.force);
  EXPECT_EQ(limited.F_G_R.torque, wrench.torque);
  EXPECT_FALSE(limited.clipped || limited.slowed || limited.too_fast);
}

TEST(HandLimits, CutTheLengthAndKeepTheDirection) {
  const LimitedWrench limited = limit_at_hand(limits(), {Vector3(0, 30, 40), Vector3(0, 0, -2)}, {});
  EXPECT_TRUE(limited.clipped);
  EXPECT_LT((limited.F_G_R.force - Vector3(0, 6, 8)).norm(), 1e-12);
  EXPECT_LT((limited.F_G_R.torque - Vector3(0, 0, -1)).norm(), 1e-12);
}

TEST(HandLimits, FadeWhatPushesAlongAndDampFromTheThresholdOn) {
  // half way between 0.5 and 1 m/s: half of the 4 N along x are left, 5 N of damping come, 3 N across stay
  const LimitedWrench limited =
      limit_at_hand(limits(), {Vector3(4, 3, 0), Vector3::Zero()}, {Vector3(0.75, 0, 0), {0, 0, 0}});
  EXPECT_TRUE(limited.slowed);
  EXPECT_FALSE(limited.too_fast);
  EXPECT_LT((limited.F_G_R.force - Vector3(-3, 3, 0)).norm(), 1e-12);
}

TEST(HandLimits, CallABodyTooFastBeyondTheStopOfEither) {
  EXPECT_TRUE(limit_at_hand(limits(), {}, {Vector3(0, 1.01, 0), Vector3::Zero()}).too_fast);
  EXPECT_TRUE(limit_at_hand(limits(), {}, {Vector3::Zero(), Vector3(0, 0, 4.01)}).too_fast);
  EXPECT_FALSE(limit_at_hand(limits(), {}, {Vector3(0, 0.99, 0), Vector3(0, 0, 3.99)}).too_fast);
}

TEST(HandLimits, NeverGiveTheHandMorePowerThanTheWrenchItself) {
  test::Random random(7);
  for (int i = 0; i < 100'000; ++i) {
    const Wrench wrench{random.between(0, 30) * random.direction(), random.between(0, 3) * random.direction()};
    const Motion velocity = random.motion(2.0, 8.0);
    const LimitedWrench limited = limit_at_hand(limits(), wrench, velocity);
    EXPECT_LE(limited.F_G_R.force.norm(), 10.0 + 1e-9);
    EXPECT_LE(limited.F_G_R.torque.norm(), 1.0 + 1e-9);
    EXPECT_LE(limited.F_G_R.force.dot(velocity.translation),
              std::max(0.0, wrench.force.dot(velocity.translation)) + 1e-9);
    EXPECT_LE(limited.F_G_R.torque.dot(velocity.rotation), std::max(0.0, wrench.torque.dot(velocity.rotation)) + 1e-9);
  }
}

TEST(HandLimits, DoNotJump) {
  test::Random random(8);
  for (int i = 0; i < 20'000; ++i) {
    const Wrench wrench{random.between(0, 30) * random.direction(), random.between(0, 3) * random.direction()};
    const Motion velocity = random.motion(1.5, 6.0);
    const Motion near{velocity.translation + 1e-6 * random.direction(), velocity.rotation};
    const Vector3 change =
        limit_at_hand(limits(), wrench, near).F_G_R.force - limit_at_hand(limits(), wrench, velocity).F_G_R.force;
    // steepest: 10 N of damping and 30 N of fading over 0.5 m/s, and the direction's turn at 0.5 m/s
    EXPECT_LT(change.norm(), 3e-4);
  }
}

}  // namespace
}  // namespace godobject::firmware
