#include "firmware/cycle/torque_limiter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/random.h"

namespace godobject::firmware::torque_limiter_test {
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

/// One joint, number by number.
struct OneJoint {
  double limit, speed;
  double sent = 0.0;
  double pushed = 0.0;
  double faded = 0.0;
  bool at_rate = false;
  bool at_edge = false;  // rounding decides whether the rate limits

  double send(const Decision& decision, const TorqueLimits& limits, int i, const ComputedTorque& computed, double qd) {
    const double holding = decision.holds_arm ? computed.holding[i] : 0.0;
    double wanted = holding;
    if (decision.of_last) {
      wanted += decision.share * faded;
    } else {
      faded = pushed;
      const double begin = limits.joint_speed * speed;
      const double end = limits.joint_speed_stop * speed;
      const bool along = (computed.rendered[i] > 0.0) == (qd > 0.0);
      const double excess = (std::fabs(qd) - begin) / (end - begin);
      const double left = along ? 1.0 - std::clamp(excess, 0.0, 1.0) : 1.0;
      wanted += decision.test_torque[i] + decision.share * left * computed.rendered[i];
    }
    double torque = std::clamp(wanted, -limit, limit);
    const double step = limits.rate * limit;
    at_rate = decision.rate_limited && std::fabs(torque - sent) > step;
    at_edge = decision.rate_limited && std::fabs(std::fabs(torque - sent) - step) < 1e-9;
    if (at_rate) torque = sent + std::copysign(step, torque - sent);
    pushed = torque - holding;
    return sent = torque;
  }
};

/// Random decisions in random order: grant, stop, fade, hold. Joints that the arm lacks get no torque.
TEST(TorqueLimiter, SendsWhatEachJointAloneWouldSend) {
  test::Random random(11);
  int at_rate = 0, faded = 0, slowed = 0;
  for (int run = 0; run < 50; ++run) {
    ArmModel arm;
    arm.joint_count = 5;
    TorqueLimits limits;
    limits.rate = random.between(0.02, 0.5);
    limits.joint_speed = random.between(0.2, 0.9);
    limits.joint_speed_stop = limits.joint_speed + random.between(0.05, 0.5);
    std::vector<OneJoint> joints;
    for (std::size_t i = 0; i < 5; ++i) {
      arm.joints[i].torque = random.between(0.5, 50.0);
      arm.joints[i].velocity = random.between(0.5, 5.0);
      joints.push_back({arm.joints[i].torque, arm.joints[i].velocity});
    }
    TorqueLimiter limiter(arm, limits);
    Decision decision;
    for (int cycle = 0; cycle < 200; ++cycle) {
      const bool fades = decision.of_last ? random.integer(0, 3) > 0 : random.integer(0, 9) == 0;
      decision.of_last = fades;
      decision.holds_arm = random.integer(0, 4) > 0;
      decision.rate_limited = random.integer(0, 3) > 0;
      decision.share = random.integer(0, 3) > 0 ? random.between(0.0, 1.0) : 0.0;
      ComputedTorque computed;
      JointVector qd = JointVector::Zero();
      for (int i = 0; i < kMaxJoints; ++i) {
        computed.holding[i] = random.between(-5.0, 5.0);
        computed.rendered[i] = random.between(-20.0, 20.0);
        decision.test_torque[i] = random.integer(0, 3) > 0 ? 0.0 : random.between(-1.0, 1.0);
        qd[i] = random.between(-6.0, 6.0);
      }
      const JointVector torque = limiter.apply(decision, computed, qd);
      bool any_at_rate = false;
      bool any_at_edge = false;
      for (int i = 0; i < 5; ++i) {
        OneJoint& joint = joints[static_cast<std::size_t>(i)];
        ASSERT_NEAR(torque[i], joint.send(decision, limits, i, computed, qd[i]), 1e-12)
            << run << ' ' << cycle << ' ' << i;
        ASSERT_NEAR(limiter.pushed()[i], joint.pushed, 1e-12);
        any_at_rate |= joint.at_rate;
        any_at_edge |= joint.at_edge;
        slowed += std::fabs(qd[i]) > limits.joint_speed * joint.speed ? 1 : 0;
      }
      ASSERT_TRUE(torque.tail<2>().isZero(0.0));
      if (!any_at_edge) {
        ASSERT_EQ(limiter.rate_limited(), any_at_rate);
      }
      at_rate += any_at_rate ? 1 : 0;
      faded += fades ? 1 : 0;
    }
  }
  EXPECT_GT(at_rate, 1000);
  EXPECT_GT(faded, 1000);
  EXPECT_GT(slowed, 1000);
}

TEST(TorqueLimiter, CallsAJointTooFastBeyondItsStopInEitherDirectionAndNotAtIt) {
  const TorqueLimiter limiter(two_joints(), {});
  const double above = std::nextafter(2.0, 3.0);
  for (const double direction : {1.0, -1.0}) {
    EXPECT_FALSE(limiter.too_fast(joints(direction * 2.0, direction * 2.0)));
    EXPECT_TRUE(limiter.too_fast(joints(direction * above, 0.0)));
    EXPECT_TRUE(limiter.too_fast(joints(0.0, direction * above)));
  }
  EXPECT_FALSE(limiter.too_fast(JointVector::Zero()));
  EXPECT_FALSE(limiter.rate_limited()) << "before the first torque";
  EXPECT_TRUE(limiter.pushed().isZero(0.0));
}

/// A share of zero keeps a rendered torque out, whatever it is: the sign test goes on.
TEST(TorqueLimiter, SendsTheTestTorqueThoughARenderedTorqueThatIsNotGrantedIsNotFinite) {
  TorqueLimiter limiter(two_joints(), {});
  Decision decision = running(0.0);
  decision.test_torque = joints(0.05, 0.0);
  EXPECT_EQ(limiter.apply(decision, {joints(0.1, 0.0), joints(std::nan(""), 1.0)}, JointVector::Zero()),
            joints(0.1 + 0.05, 0.0));
}

/// The arm is held if one joint's rendered torque is not finite; without the rate limit, too.
TEST(TorqueLimiter, HoldsAllJointsIfARenderedTorqueIsNotFinite) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (const bool rate_limited : {true, false}) {
      TorqueLimiter limiter(two_joints(), {});
      Decision decision = running();
      decision.rate_limited = rate_limited;
      EXPECT_EQ(limiter.apply(decision, {joints(0.3, -0.2), joints(bad, 0.1)}, JointVector::Zero()), joints(0.3, -0.2));
      EXPECT_TRUE(limiter.pushed().isZero(0.0));
    }
  }
}

/// A joint whose limit is not a number gives no torque to any joint: nothing is known any more.
TEST(TorqueLimiter, SendsNothingIfALimitIsNotANumber) {
  ArmModel arm = two_joints();
  TorqueLimits limits;
  limits.rate = std::nan("");
  TorqueLimiter limiter(arm, limits);
  const JointVector torque = limiter.apply(running(), {joints(0.3, -0.2), joints(0.1, 0.1)}, JointVector::Zero());
  EXPECT_TRUE(torque.allFinite());
}

}  // namespace
}  // namespace godobject::firmware::torque_limiter_test
