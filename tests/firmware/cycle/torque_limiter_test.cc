#include "firmware/cycle/torque_limiter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace godobject::firmware {
namespace {

Decision running(double share = 1.0) {
  Decision decision;
  decision.power = hal::PowerRequest::kEnable;
  decision.holds_arm = true;
  decision.share = share;
  return decision;
}

/// Two joints of 10 Nm and 2 rad/s.
ArmModel two_joints() {
  ArmModel arm;
  arm.joint_count = 2;
  for (std::size_t i = 0; i < 2; ++i) {
    arm.joints[i].torque = 10.0;
    arm.joints[i].velocity = 2.0;
  }
  return arm;
}

JointVector joints(double a, double b) {
  JointVector v = JointVector::Zero();
  v.head<2>() << a, b;
  return v;
}

TEST(TorqueLimiter, LetsTorquesGrowByNoMoreThanATwentiethACycle) {
  TorqueLimiter limiter(two_joints(), {});
  const ComputedTorque computed{joints(2.0, 0.0), joints(20.0, -1.0)};
  for (int k = 1; k <= 30; ++k) {
    const JointVector torque = limiter.apply(running(), computed, JointVector::Zero());
    EXPECT_NEAR(torque[0], std::min(10.0, 0.5 * k), 1e-12);
    EXPECT_NEAR(torque[1], std::max(-1.0, -0.5 * k), 1e-12);
    EXPECT_EQ(limiter.rate_limited(), k < 20);
  }
}

TEST(TorqueLimiter, SendsOnlyWhatIsGranted) {
  TorqueLimiter limiter(two_joints(), {});
  const ComputedTorque computed{joints(0.2, 0.1), joints(0.4, -0.4)};
  EXPECT_TRUE(limiter.apply(Decision(), computed, JointVector::Zero()).isZero(0.0));
  EXPECT_LT((limiter.apply(running(0.0), computed, JointVector::Zero()) - joints(0.2, 0.1)).norm(), 1e-12);
  EXPECT_LT((limiter.apply(running(0.5), computed, JointVector::Zero()) - joints(0.4, -0.1)).norm(), 1e-12);
  EXPECT_LT((limiter.pushed() - joints(0.2, -0.2)).norm(), 1e-12);
}

TEST(TorqueLimiter, StopsAtOnceAndHoldsTheArm) {
  TorqueLimiter limiter(two_joints(), {});
  for (int k = 0; k < 30; ++k) limiter.apply(running(), {joints(3.0, 0.0), joints(6.0, -8.0)}, JointVector::Zero());
  Decision stop = running(0.0);
  stop.rate_limited = false;
  EXPECT_EQ(limiter.apply(stop, {joints(3.0, 0.0), joints(6.0, -8.0)}, JointVector::Zero()), joints(3.0, 0.0));
}

TEST(TorqueLimiter, FadesWhatWasRenderedLastWhateverIsComputed) {
  TorqueLimiter limiter(two_joints(), {});
  for (int k = 0; k < 30; ++k) limiter.apply(running(), {joints(1.0, 0.0), joints(4.0, -5.0)}, JointVector::Zero());
  for (int k = 1; k <= 5; ++k) {
    Decision fade = running(1.0 - 0.2 * k);
    fade.of_last = true;
    fade.rate_limited = false;
    const JointVector torque = limiter.apply(fade, {joints(1.0, 0.0), joints(9.0, 9.0)}, JointVector::Zero());
    EXPECT_LT((torque - joints(1.0 + 4.0 * fade.share, -5.0 * fade.share)).norm(), 1e-12) << k;
  }
}

TEST(TorqueLimiter, NeverLetsANumberPassThatIsNotFinite) {
  const double bad[] = {std::nan(""), std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity()};
  for (const double value : bad) {
    TorqueLimiter limiter(two_joints(), {});
    limiter.apply(running(), {joints(0.3, 0.0), joints(0.1, 0.0)}, JointVector::Zero());
    const auto is_harmless = [](const JointVector& torque) {
      return torque.allFinite() && torque.cwiseAbs().maxCoeff() < 0.5;
    };
    for (const bool rate_limited : {true, false}) {
      Decision decision = running();
      decision.rate_limited = rate_limited;
      EXPECT_TRUE(is_harmless(limiter.apply(decision, {joints(0.3, 0.0), joints(value, 0.1)}, JointVector::Zero())));
      EXPECT_TRUE(is_harmless(limiter.apply(decision, {joints(value, 0.0), joints(0.1, 0.1)}, JointVector::Zero())));
      decision.test_torque = joints(value, 0.0);
      EXPECT_TRUE(is_harmless(limiter.apply(decision, {joints(0.3, 0.0), joints(0.1, 0.1)}, JointVector::Zero())));
      EXPECT_TRUE(is_harmless(limiter.apply(decision, {joints(0.3, 0.0), joints(0.1, 0.1)}, joints(value, 0))));
    }
  }
}

/// Every pair of inputs and limits, as NaN, infinite, too large or negative: whatever produced the torques, the last
/// step before the drives gives finite ones.
TEST(TorqueLimiter, GivesFiniteTorquesWhateverItsInputsAndLimitsAre) {
  const std::array bad = {std::nan(""), std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::max(), -1.0};
  constexpr int kPlaces = 10;
  for (int pair = 0; pair < kPlaces * kPlaces; ++pair) {
    for (const double value : bad) {
      ArmModel arm = two_joints();
      TorqueLimits limits;
      ComputedTorque computed{joints(0.3, 0.0), joints(0.1, 0.0)};
      Decision decision = running();
      JointVector qd = joints(1.8, 0.0);
      const std::array<double*, kPlaces> places = {&arm.joints[0].torque,
                                                   &arm.joints[0].velocity,
                                                   &limits.rate,
                                                   &limits.joint_speed,
                                                   &limits.joint_speed_stop,
                                                   &computed.holding[0],
                                                   &computed.rendered[0],
                                                   &decision.test_torque[0],
                                                   &decision.share,
                                                   &qd[0]};
      *places.at(static_cast<std::size_t>(pair / kPlaces)) = value;
      *places.at(static_cast<std::size_t>(pair % kPlaces)) = value;
      TorqueLimiter limiter(arm, limits);
      for (int cycle = 0; cycle < 8; ++cycle) {
        decision.rate_limited = cycle % 2 == 0;
        decision.of_last = cycle % 4 >= 2;
        decision.holds_arm = cycle < 6;
        EXPECT_TRUE(limiter.apply(decision, computed, qd).allFinite()) << pair << ' ' << value << ' ' << cycle;
        EXPECT_TRUE(limiter.pushed().allFinite()) << pair << ' ' << value << ' ' << cycle;
      }
    }
  }
}

TEST(TorqueLimiter, HoldsTheArmByTheLastTorqueThatDidWhenANewOneIsNotFinite) {
  TorqueLimiter limiter(two_joints(), {});
  limiter.apply(running(), {joints(0.3, 0.2), joints(0.1, 0.0)}, JointVector::Zero());
  Decision stop = running(0.0);
  stop.rate_limited = false;
  EXPECT_EQ(limiter.apply(stop, {joints(std::nan(""), 0.2), joints(0.0, 0.0)}, JointVector::Zero()), joints(0.3, 0.2));
}

TEST(TorqueLimiter, DoesNotPushAFastJointOn) {
  TorqueLimits limits;
  limits.rate = 1.0;
  TorqueLimiter limiter(two_joints(), limits);
  // joint 0 between 0.8 and 1.0 of its 2 rad/s, half way: half of what pushes along; joint 1 is braked: all of it
  const JointVector torque = limiter.apply(running(), {joints(0.0, 0.0), joints(4.0, -4.0)}, joints(1.8, 1.8));
  EXPECT_LT((torque - joints(2.0, -4.0)).norm(), 1e-12);
  EXPECT_FALSE(limiter.too_fast(joints(1.99, -1.99)));
  EXPECT_TRUE(limiter.too_fast(joints(0.0, -2.01)));
}

}  // namespace
}  // namespace godobject::firmware
