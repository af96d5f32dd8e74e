#include "firmware/cycle/sign_test.h"

#include <gtest/gtest.h>

#include <cmath>

namespace godobject::firmware {
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
    SignTest test(joints.arm, {});
    EXPECT_EQ(run(joints, test), SignTest::Result::kPassed) << inertia;
    EXPECT_LT(joints.q.cwiseAbs().maxCoeff(), 0.2) << "no farther than the supervisor lets them, inertia " << inertia;
  }
}

TEST(SignTest, PassesWithDryFrictionAndAHandThatDrifts) {
  Joints joints(3);
  joints.dry = 0.2;
  SignTest still(joints.arm, {});
  EXPECT_EQ(run(joints, still), SignTest::Result::kPassed);
  for (const double drift : {-0.05, 0.05}) {
    Joints drifting(3);
    SignTest test(drifting.arm, {});
    EXPECT_EQ(run(drifting, test, drift), SignTest::Result::kPassed) << drift;
  }
}

TEST(SignTest, PassesWithAHandThatHoldsTheArmAsASpring) {
  for (const double inertia : {0.01, 0.1, 1.0}) {
    Joints joints(3);
    joints.inertia = inertia;
    joints.spring = 50.0;
    joints.damping = 2.0 * std::sqrt(joints.spring * inertia);
    SignTest test(joints.arm, {});
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
    SignTest test(joints.arm, {});
    EXPECT_EQ(run(joints, test), SignTest::Result::kWrong);
    EXPECT_EQ(test.joint(), wrong);
  }
}

TEST(SignTest, DoesNotDecideOnAJointThatDoesNotMove) {
  Joints joints(2);
  joints.gain[1] = 0.0;
  SignTest test(joints.arm, {});
  EXPECT_EQ(run(joints, test), SignTest::Result::kUndecided);
  EXPECT_EQ(test.joint(), 1);
  test.restart();
  joints.gain[1] = 1.0;
  EXPECT_EQ(run(joints, test), SignTest::Result::kPassed);
}

}  // namespace
}  // namespace godobject::firmware
