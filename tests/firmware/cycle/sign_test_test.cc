#include "firmware/cycle/sign_test.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random.h"

namespace godobject::firmware::sign_test_test {
namespace {

/// Joints of 10 Nm with inertia, viscous and dry friction, and a gain of 1 or -1 from torque to motion.
struct Joints {
  ArmModel arm;
  double inertia = 1.0;
  double damping = 0.5;
  double dry = 0.0;
  double spring = 0.0;  ///< to zero, as a hand's
  JointVector gain = JointVector::Ones();
  JointVector q = JointVector::Zero();
  JointVector qd = JointVector::Zero();

  explicit Joints(int count) {
    arm.joint_count = count;
    for (int i = 0; i < count; ++i) arm.joints[static_cast<std::size_t>(i)].torque = 10.0;
  }

  void step(const JointVector& torque) {
    for (int i = 0; i < arm.joint_count; ++i) {
      const double push = gain[i] * torque[i];
      if (qd[i] == 0.0 && dry > 0.0 && std::fabs(push) <= dry) continue;
      const double friction = qd[i] == 0.0 ? std::copysign(dry, push) : std::copysign(dry, qd[i]);
      const double before = qd[i];
      qd[i] += 1e-3 * (push - friction - damping * qd[i] - spring * q[i]) / inertia;
      if (dry > 0.0 && before * qd[i] < 0.0 && std::fabs(push) <= dry) qd[i] = 0.0;
      q[i] += 1e-3 * qd[i];
    }
  }
};

SignTest::Result run(Joints& joints, SignTest& test, double drift = 0.0) {
  JointVector torque;
  for (int i = 0; i < 100'000; ++i) {
    joints.q.head(joints.arm.joint_count).array() += 1e-3 * drift;
    const SignTest::Result result = test.update(joints.q, torque);
    EXPECT_LE(torque.cwiseAbs().maxCoeff(), 0.5 + 1e-12);
    EXPECT_LE((torque.array() != 0.0).count(), 1);
    if (result != SignTest::Result::kRunning) return result;
    joints.step(torque);
  }
  return SignTest::Result::kRunning;
}

TEST(SignTest, PassesJointsThatMoveAsTheyArePushed) {
  for (const double inertia : {1e-3, 0.1, 3.0}) {
    Joints joints(7);
    joints.inertia = inertia;
    SignTest test(joints.arm, {}, 1e-3);
    EXPECT_EQ(run(joints, test), SignTest::Result::kPassed) << inertia;
    EXPECT_LT(joints.q.cwiseAbs().maxCoeff(), 0.2) << "no farther than the supervisor lets them, inertia " << inertia;
  }
}

TEST(SignTest, PassesWithDryFrictionAndAHandThatDrifts) {
  Joints joints(3);
  joints.dry = 0.2;
  SignTest still(joints.arm, {}, 1e-3);
  EXPECT_EQ(run(joints, still), SignTest::Result::kPassed);
  for (const double drift : {-0.05, 0.05}) {
    Joints drifting(3);
    SignTest test(drifting.arm, {}, 1e-3);
    EXPECT_EQ(run(drifting, test, drift), SignTest::Result::kPassed) << drift;
  }
}

TEST(SignTest, PassesWithAHandThatHoldsTheArmAsASpring) {
  for (const double inertia : {0.01, 0.1, 1.0}) {
    Joints joints(3);
    joints.inertia = inertia;
    joints.spring = 50.0;
    joints.damping = 2.0 * std::sqrt(joints.spring * inertia);
    SignTest test(joints.arm, {}, 1e-3);
    EXPECT_EQ(run(joints, test), SignTest::Result::kPassed) << inertia;
    joints.gain[1] = -1.0;
    test.restart();
    EXPECT_EQ(run(joints, test), SignTest::Result::kWrong) << inertia;
  }
}

TEST(SignTest, FindsEachJointThatMovesAgainstItsTorque) {
  for (int wrong = 0; wrong < 3; ++wrong) {
    Joints joints(3);
    joints.gain[wrong] = -1.0;
    SignTest test(joints.arm, {}, 1e-3);
    EXPECT_EQ(run(joints, test), SignTest::Result::kWrong);
    EXPECT_EQ(test.joint(), wrong);
  }
}

TEST(SignTest, DoesNotDecideOnAJointThatDoesNotMove) {
  Joints joints(2);
  joints.gain[1] = 0.0;
  SignTest test(joints.arm, {}, 1e-3);
  EXPECT_EQ(run(joints, test), SignTest::Result::kUndecided);
  EXPECT_EQ(test.joint(), 1);
  test.restart();
  joints.gain[1] = 1.0;
  EXPECT_EQ(run(joints, test), SignTest::Result::kPassed);
}

constexpr int kStill = static_cast<int>(SignTest::kStill_ms);
constexpr int kPush = static_cast<int>(SignTest::kPush_ms);

/// Two joints of 10 and 4 Nm; largest torques are 0.5 and 0.2 Nm.
ArmModel two_unlike_joints() {
  ArmModel arm;
  arm.joint_count = 2;
  arm.joints[0].torque = 10.0;
  arm.joints[1].torque = 4.0;
  return arm;
}

JointVector only(int joint, double value) {
  JointVector v = JointVector::Zero();
  v[joint] = value;
  return v;
}

/// Joints that stand still at 1 rad: each push rises evenly, first in the positive direction, three times both ways.
TEST(SignTest, PushesEvenlyInBothDirectionsThreeTimesAndGivesUp) {
  SignTest test(two_unlike_joints(), {}, 1e-3);
  const JointVector still = JointVector::Constant(1.0);
  JointVector torque = JointVector::Constant(7.0);
  for (int attempt = 0; attempt < SignTest::kAttempts; ++attempt) {
    for (const double direction : {1.0, -1.0}) {
      for (int call = 1; call <= kStill + kPush; ++call) {
        const bool last = attempt + 1 == SignTest::kAttempts && direction < 0.0 && call == kStill + kPush;
        ASSERT_EQ(test.update(still, torque), last ? SignTest::Result::kUndecided : SignTest::Result::kRunning);
        const bool pushes = call > kStill && call < kStill + kPush;
        const JointVector expected = only(0, pushes ? direction * 0.5 * (call - kStill) / kPush : 0.0);
        ASSERT_LT((torque - expected).norm(), 1e-15) << call;
      }
    }
  }
  EXPECT_EQ(test.joint(), 0);
  torque.setConstant(7.0);
  for (int call = 0; call < 2 * kStill; ++call) {
    ASSERT_EQ(test.update(JointVector::Zero(), torque), SignTest::Result::kUndecided) << "it stays decided";
    ASSERT_TRUE(torque.isZero(0.0)) << "and pushes no more";
  }
}

/// Joints that respond by script: in each push the joint under test moves a little more than `motion` along the push
/// (1), against it (-1), or a little less than that (0).
struct Script {
  SignTest test{two_unlike_joints(), {}, 1e-3};
  JointVector q = JointVector::Constant(1.0);
  JointVector torque = JointVector::Zero();
  SignTest::Result result = SignTest::Result::kRunning;

  void respond(double direction, int response) {
    const int joint = test.joint();
    const int last = response == 0 ? kStill + kPush : kStill + 11;  // call that ends the push
    for (int call = 1; call <= last; ++call) {
      result = test.update(q, torque);
      const bool pushes = call > kStill && call < last;
      EXPECT_EQ(torque[joint] != 0.0, pushes) << call;
      EXPECT_GE(direction * torque[joint], 0.0);
      EXPECT_TRUE(only(joint, torque[joint]) == torque) << "one joint at a time";
      if (result != SignTest::Result::kRunning) return;
      if (call == kStill + 10) q[joint] += response == 0 ? 0.99 * 0.002 : response * direction * 1.01 * 0.002;
    }
  }
  void attempt(int first, int second) {
    respond(1.0, first);
    respond(-1.0, second);
  }
};

TEST(SignTest, DecidesByBothResponsesOfAJoint) {
  for (const int first : {-1, 0, 1}) {
    for (const int second : {-1, 0, 1}) {
      SCOPED_TRACE(testing::Message() << first << ' ' << second);
      Script script;
      script.attempt(first, second);
      if (first == 1 && second == 1) {
        EXPECT_EQ(script.result, SignTest::Result::kRunning);
        EXPECT_EQ(script.test.joint(), 1) << "the next one";
        script.attempt(1, 1);
        EXPECT_EQ(script.result, SignTest::Result::kPassed);
        EXPECT_EQ(script.test.joint(), 1);
      } else if (first == -1 && second == -1) {
        EXPECT_EQ(script.result, SignTest::Result::kWrong);
        EXPECT_EQ(script.test.joint(), 0);
      } else {
        EXPECT_EQ(script.result, SignTest::Result::kRunning);
        EXPECT_EQ(script.test.joint(), 0);
        script.attempt(first, second);
        EXPECT_EQ(script.result, SignTest::Result::kRunning);
        script.attempt(first, second);
        EXPECT_EQ(script.result, SignTest::Result::kUndecided);
      }
    }
  }
}

TEST(SignTest, GivesEachJointItsOwnAttempts) {
  Script script;
  for (const int joint : {0, 1}) {
    EXPECT_EQ(script.test.joint(), joint);
    script.attempt(1, 0);
    script.attempt(-1, 1);
    EXPECT_EQ(script.result, SignTest::Result::kRunning);
    script.attempt(1, 1);
  }
  EXPECT_EQ(script.result, SignTest::Result::kPassed);
}

/// A drift of 6e-6 rad a cycle is 0.15 of `motion` in the still cycles: a faster one is waited for seven times. It is
/// no response, however far the joint goes.
TEST(SignTest, WaitsForAJointThatDriftsSevenTimesAndThenTestsIt) {
  for (const double drift : {5.9e-6, -5.9e-6, 6.1e-6, -6.1e-6, 1e-4}) {
    SignTest test(two_unlike_joints(), {}, 1e-3);
    JointVector q = JointVector::Constant(-1.0);
    JointVector torque;
    const int waits = std::fabs(drift) > 6e-6 ? static_cast<int>(SignTest::kWaits) - 1 : 0;
    for (const double direction : {1.0, -1.0, 1.0}) {
      const int first = waits * (kStill + 1) + kStill + 1;  // call with a torque
      const int last = first + kPush - 1;                   // call that ends the push
      for (int call = 1; call <= last; ++call) {
        ASSERT_EQ(test.update(q, torque), SignTest::Result::kRunning);
        const bool pushes = call >= first && call < last;
        ASSERT_NEAR(torque[0], pushes ? direction * 0.5 * (call - first + 1) / kPush : 0.0, 1e-15)
            << drift << ' ' << call;
        q.array() += drift;
      }
    }
  }
}

/// The line goes through the first and the last position of the still cycles; one between them does not bend it.
TEST(SignTest, DrawsTheLineThroughTheEndsOfTheStillCycles) {
  for (const int disturbed : {1, kStill / 2, kStill - 1}) {
    SignTest test(two_unlike_joints(), {}, 1e-3);
    JointVector torque;
    for (int call = 1; call < kStill + kPush; ++call) {
      const JointVector q = only(0, call - 1 == disturbed ? 2.5e-4 : 0.0);
      ASSERT_EQ(test.update(q, torque), SignTest::Result::kRunning);
      ASSERT_EQ(torque[0] > 0.0, call > kStill) << disturbed << ' ' << call;
    }
  }
}

/// Whatever happened before, a restarted test does the same as a new one.
TEST(SignTest, RestartsAsIfItWereNew) {
  test::Random random(5);
  for (int run = 0; run < 60; ++run) {
    SignTest restarted(two_unlike_joints(), {}, 1e-3);
    JointVector torque;
    JointVector other;
    JointVector q = JointVector::Zero();
    const double gain = run % 4 == 0 ? -1e-2 : 1e-2;
    for (int i = random.integer(1, run < 30 ? 400 : 4000); i > 0; --i) {
      restarted.update(q, torque);
      q += gain * torque;
    }
    restarted.restart();
    SignTest fresh(two_unlike_joints(), {}, 1e-3);
    SignTest::Result result = SignTest::Result::kRunning;
    for (int i = 0; i < 6000 && result == SignTest::Result::kRunning; ++i) {
      result = fresh.update(q, torque);
      ASSERT_EQ(restarted.update(q, other), result);
      ASSERT_EQ(torque, other);
      ASSERT_EQ(restarted.joint(), fresh.joint());
      q += 1e-2 * torque;
    }
    EXPECT_EQ(result, SignTest::Result::kPassed);
  }
}

}  // namespace
}  // namespace godobject::firmware::sign_test_test
