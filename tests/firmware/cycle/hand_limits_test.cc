#include "firmware/cycle/hand_limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random.h"

namespace godobject::firmware::hand_limits_test {
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

/// The same limits in components: along the motion and across it.
Vector3 limited_in_components(double size, double speed, double stop, const Vector3& force, const Vector3& velocity) {
  const double v = velocity.norm();
  if (v <= speed) return force.norm() <= size ? force : Vector3(size * force.normalized());
  const Vector3 along = velocity.normalized();
  const double share = v >= stop ? 1.0 : (v - speed) / (stop - speed);
  double component = force.dot(along);
  const Vector3 across = force - component * along;
  if (component > 0.0) component *= 1.0 - share;
  const Vector3 damped = across + (component - share * size) * along;
  return damped.norm() <= size ? damped : Vector3(size * damped.normalized());
}

TEST(HandLimits, AgreeWithTheSameLimitsInComponents) {
  test::Random random(9);
  int slowed = 0, clipped = 0, too_fast = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Wrench wrench{random.between(0, 15) * random.direction(), random.between(0, 1.5) * random.direction()};
    const Motion velocity = random.motion(1.2, 4.8);
    const LimitedWrench limited = limit_at_hand(limits(), wrench, velocity);
    const Vector3 force = limited_in_components(10.0, 0.5, 1.0, wrench.force, velocity.translation);
    const Vector3 torque = limited_in_components(1.0, 2.0, 4.0, wrench.torque, velocity.rotation);
    ASSERT_LT((limited.F_G_R.force - force).norm(), 1e-12);
    ASSERT_LT((limited.F_G_R.torque - torque).norm(), 1e-12);
    ASSERT_EQ(limited.slowed, velocity.translation.norm() > 0.5 || velocity.rotation.norm() > 2.0);
    ASSERT_EQ(limited.too_fast, velocity.translation.norm() > 1.0 || velocity.rotation.norm() > 4.0);
    slowed += limited.slowed ? 1 : 0;
    clipped += limited.clipped ? 1 : 0;
    too_fast += limited.too_fast ? 1 : 0;
  }
  EXPECT_GT(slowed, 10'000);
  EXPECT_GT(too_fast, 1'000);
  EXPECT_GT(clipped, 1'000);
  EXPECT_LT(clipped, 19'000);
}

/// Along the axes no number is rounded: at each limit, and one bit beyond it.
TEST(HandLimits, BeginBeyondEachLimitAndNotAtIt) {
  const auto above = [](double limit) { return std::nextafter(limit, 100.0); };
  const auto of = [](double force, double torque, double speed, double turn) {
    return limit_at_hand(limits(), {Vector3(0, force, 0), Vector3(torque, 0, 0)},
                         {Vector3(0, 0, speed), Vector3(0, turn, 0)});
  };
  const LimitedWrench at = of(10.0, 1.0, 0.5, 2.0);
  EXPECT_FALSE(at.clipped || at.slowed || at.too_fast);
  EXPECT_EQ(at.F_G_R.force, Vector3(0, 10, 0));
  EXPECT_EQ(at.F_G_R.torque, Vector3(1, 0, 0));
  EXPECT_TRUE(of(above(10.0), 0.0, 0.0, 0.0).clipped);
  EXPECT_TRUE(of(0.0, above(1.0), 0.0, 0.0).clipped);
  EXPECT_TRUE(of(0.0, 0.0, above(0.5), 0.0).slowed);
  EXPECT_TRUE(of(0.0, 0.0, 0.0, above(2.0)).slowed);
  EXPECT_FALSE(of(0.0, 0.0, 1.0, 4.0).too_fast);
  EXPECT_TRUE(of(0.0, 0.0, above(1.0), 0.0).too_fast);
  EXPECT_TRUE(of(0.0, 0.0, 0.0, above(4.0)).too_fast);
}

/// Far beyond the stop the damping is no larger than the largest force, and a push along the motion is gone.
TEST(HandLimits, DampNoMoreThanTheLargestForceHoweverFastTheHandIs) {
  for (const double factor : {1.0, 2.0, 100.0}) {
    const Motion velocity{Vector3(factor, 0, 0), Vector3(0, 0, -4.0 * factor)};
    for (const double push : {0.0, 8.0}) {
      const LimitedWrench limited =
          limit_at_hand(limits(), {Vector3(push, 0, 0), Vector3(0, 0, -0.1 * push)}, velocity);
      EXPECT_EQ(limited.F_G_R.force, Vector3(-10, 0, 0));
      EXPECT_EQ(limited.F_G_R.torque, Vector3(0, 0, 1));
      EXPECT_FALSE(limited.clipped);
      EXPECT_TRUE(limited.slowed);
    }
  }
}

}  // namespace
}  // namespace godobject::firmware::hand_limits_test
