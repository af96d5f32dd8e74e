#include "core/device/passivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/random.h"

namespace godobject {
namespace {

constexpr double kPeriod = 1e-3;
constexpr double kDelay = 1.0;  // in periods

JointVector joint(double value) {
  JointVector all = JointVector::Zero();
  all[0] = value;
  return all;
}

/// Returns the absorbed energy. The torque is 2 Nm from sample 0 on; the joint moves by 0.1 rad a sample after it.
double after(PassivityObserver& observer, int samples) {
  for (int k = 0; k <= samples; ++k) {
    observer.observe(joint(0.1 * k));
    observer.send(joint(2.0));
  }
  return observer.absorbed();
}

TEST(PassivityObserver, CountsWhatActsAndNotWhatIsSent) {
  // by hand: the torque gives 0.2 J a sample once it acts; for d = 1.25 it acts 1.25 periods after the first sample
  PassivityObserver at_once(0.0);
  EXPECT_NEAR(after(at_once, 3), -0.6, 1e-15);
  PassivityObserver later(1.0);
  EXPECT_NEAR(after(later, 3), -0.4, 1e-15);
  PassivityObserver between(1.25);
  EXPECT_NEAR(after(between, 3), -0.35, 1e-15);
  between.reset();
  EXPECT_EQ(between.absorbed(), 0.0);
  EXPECT_NEAR(after(between, 3), -0.35, 1e-15);
}

/// A torque of one period acts from the delay on for one period, and the joint moves evenly: the energy is that of the
/// part of this period that is over.
TEST(PassivityObserver, CountsATorqueExactlyWhileItActs) {
  for (const double delay : {0.0, 0.25, 1.0, 1.25, 2.9, 13.5, 14.0}) {
    PassivityObserver observer(delay);
    for (int k = 0; k <= 40; ++k) {
      observer.observe(joint(0.1 * k));
      EXPECT_NEAR(observer.absorbed(), -0.2 * std::clamp(k - delay, 0.0, 1.0), 1e-14) << delay << ", sample " << k;
      observer.send(joint(k == 0 ? 2.0 : 0.0));
    }
  }
}

/// The observer does not know where the joint was before its first position, so no energy counts up to there. A torque
/// that acts already changes nothing.
TEST(PassivityObserver, AddsNoEnergyUpToItsFirstPosition) {
  PassivityObserver observer(0.0);
  for (int session = 0; session < 2; ++session) {
    observer.send(joint(2.0));
    observer.observe(joint(5.0));
    EXPECT_EQ(observer.absorbed(), 0.0) << session;
    observer.observe(joint(5.1));
    EXPECT_NEAR(observer.absorbed(), -0.2, 1e-14) << session;
    observer.reset();
  }
}

TEST(PassivityObserver, BringsTheDelayIntoItsRange) {
  PassivityObserver farthest(PassivityObserver::kMostDelay);
  PassivityObserver beyond(1e3);
  EXPECT_NEAR(after(farthest, 60), -0.2 * (60 - PassivityObserver::kMostDelay), 1e-12);
  EXPECT_EQ(after(beyond, 60), farthest.absorbed());
  PassivityObserver before(-1.0);
  EXPECT_NEAR(after(before, 3), -0.6, 1e-15);
}

TEST(PassivityObserver, SumsOverJoints) {
  PassivityObserver observer(0.0);
  test::Random random(3);
  JointVector q = JointVector::Zero();
  double given = 0.0;
  JointVector torque = JointVector::Zero();
  observer.observe(q);
  for (int k = 0; k < 100; ++k) {
    for (int i = 0; i < kMaxJoints; ++i) torque[i] = random.between(-1.0, 1.0);
    observer.send(torque);
    JointVector next = q;
    for (int i = 0; i < kMaxJoints; ++i) next[i] += random.between(-0.1, 0.1);
    for (int i = 0; i < kMaxJoints; ++i) given += torque[i] * (next[i] - q[i]);
    q = next;
    observer.observe(q);
  }
  EXPECT_NEAR(observer.absorbed(), -given, 1e-12);
}

/// Rule A9: a slow sine on a spring gains pi w A^2 K (T/2 + t_d) a cycle. Here it acts on joint 1, K in Nm/rad.
TEST(PassivityObserver, SeesWhatHoldAndDelayGive) {
  constexpr double kStiffness = 1000.0;
  constexpr int kSamples = 1000;
  const double w = 2.0 * M_PI / (kSamples * kPeriod);
  for (const double delay : {0.0, 0.5, 1.0, 2.3}) {
    PassivityObserver observer(delay);
    const auto run_cycle = [&] {
      for (int k = 0; k < kSamples; ++k) {
        const double x = std::sin(2.0 * M_PI * k / kSamples);
        observer.observe(joint(x));
        observer.send(joint(-kStiffness * x));
      }
    };
    run_cycle();
    const double before = observer.absorbed();
    run_cycle();
    const double expected = -M_PI * w * kStiffness * kPeriod * (0.5 + delay);
    EXPECT_NEAR(observer.absorbed() - before, expected, 0.001 * std::fabs(expected)) << "delay [s] " << delay;
  }
}

const Wrench kPush{.force = {0.0, 0.0, 10.0}};
const Motion kIn{.translation = {0.0, 0.0, -0.1}};
const Motion kOut{.translation = {0.0, 0.0, 0.1}};

TEST(PassivityController, LeavesTheWrenchAloneWithoutADebt) {
  PassivityController controller({.most_damping = 50.0}, kDelay);
  for (const double absorbed : {0.0, 1e-9, 1.0}) {
    EXPECT_EQ(controller.apply(absorbed, kPush, kIn).force, kPush.force);
    EXPECT_EQ(controller.damping(), 0.0);
  }
  PassivityController off({}, kDelay);
  EXPECT_EQ(off.apply(-1.0, kPush, kIn).force, kPush.force);
}

/// Also where the square of the power is too small for a number.
TEST(PassivityController, DampsNothingWithoutADebtHoweverSmallWrenchAndMotionAre) {
  PassivityController controller({.most_damping = 50.0, .period = kPeriod}, kDelay);
  for (const double force : {1e-150, 1e-3, 10.0}) {
    for (const double speed : {1e-200, 1e-50, 0.1}) {
      const Wrench F{{0.0, 0.0, force}, {0.0, 0.1 * force, 0.0}};
      const Wrench out = controller.apply(0.0, F, {.translation = {0.0, 0.0, -speed}});
      EXPECT_EQ(out.force, F.force) << force << ", " << speed;
      EXPECT_EQ(out.torque, F.torque) << force << ", " << speed;
      EXPECT_EQ(controller.damping(), 0.0) << force << ", " << speed;
    }
  }
}

/// By hand, for a period of 1 ms and a length of 0.1 m: 1 Nm counts as 10 N, 1 rad/s as 0.1 m/s. A debt of 1e-4 J is
/// paid by 1 N at 0.1 m/s, and by 0.1 Nm at 1 rad/s.
TEST(PassivityController, CountsWithTheStatedPeriodAndLengthUnlessToldOtherwise) {
  PassivityController controller({.most_damping = 50.0}, kDelay);
  EXPECT_NEAR(controller.apply(-1e-4, kPush, kIn).force.z(), 11.0, 1e-12);
  EXPECT_NEAR(controller.damping(), 10.0, 1e-12);
  const Wrench out = controller.apply(-1e-4, {.torque = {0.0, 0.0, 1.0}}, {.rotation = {0.0, 0.0, -1.0}});
  EXPECT_NEAR(out.torque.z(), 1.1, 1e-13);
  EXPECT_NEAR(controller.damping(), 10.0, 1e-12);
}

TEST(PassivityController, PaysTheDebtWithinAPeriodWhereItMay) {
  PassivityController controller({.most_damping = 50.0, .period = kPeriod}, kDelay);
  // by hand: 1e-4 J in 1 ms at 0.1 m/s are 1 N
  EXPECT_NEAR(controller.apply(-1e-4, kPush, kIn).force.z(), 11.0, 1e-12);
  EXPECT_NEAR(controller.damping(), 10.0, 1e-12);
  EXPECT_NEAR(controller.apply(-1e-4, kPush, kOut).force.z(), 9.0, 1e-12);
  // the damping is limited to 50 Ns/m
  EXPECT_NEAR(controller.apply(-1.0, kPush, kIn).force.z(), 15.0, 1e-12);
  EXPECT_EQ(controller.damping(), 50.0);
}

TEST(PassivityController, NeverTurnsAPushIntoAPull) {
  PassivityController controller({.most_damping = 500.0, .period = kPeriod}, kDelay);
  EXPECT_EQ(controller.apply(-1.0, kPush, kOut).force.z(), 0.0);
  EXPECT_TRUE(controller.apply(-1.0, {}, kOut).force.isZero(0.0));
}

/// Random wrenches and motions. The direction is kept. The energy taken in a period is between zero and the debt. The
/// change is no larger than the largest damper's. All norms use the coupling's lengths.
TEST(PassivityController, TakesNoMoreThanTheDebtAndTheLargestDamper) {
  constexpr double kLength = 0.16;
  constexpr double kMost = 40.0;
  test::Random random(4);
  for (int i = 0; i < 100000; ++i) {
    PassivityController controller({.most_damping = kMost, .period = kPeriod, .rotation_length = kLength}, kDelay);
    const double size = std::pow(10.0, random.between(-6.0, 2.0));
    const Wrench F{size * random.in_cube(1.0), size * random.in_cube(0.2)};
    const double speed = std::pow(10.0, random.between(-6.0, 1.0));
    const Motion V{speed * random.in_cube(1.0), speed * random.in_cube(5.0)};
    const double debt = std::pow(10.0, random.between(-12.0, 1.0));
    const Wrench out = controller.apply(-debt, F, V);
    const Vector3 df = out.force - F.force;
    const Vector3 dt = out.torque - F.torque;
    const double taken = -kPeriod * (df.dot(V.translation) + dt.dot(V.rotation));
    ASSERT_GE(taken, 0.0);
    const double rounding =
        1e-15 * kPeriod * (F.force.norm() * V.translation.norm() + F.torque.norm() * V.rotation.norm());
    ASSERT_LE(taken, debt * (1.0 + 1e-9) + 4.0 * rounding);
    const double change = std::hypot(df.norm(), dt.norm() / kLength);
    ASSERT_LE(change, kMost * std::hypot(V.translation.norm(), kLength * V.rotation.norm()) * (1.0 + 1e-9));
    ASSERT_LE(out.force.cross(F.force).norm(), 1e-12 * F.force.squaredNorm() + 1e-12 * out.force.squaredNorm());
    ASSERT_GE(out.force.dot(F.force) + out.torque.dot(F.torque), 0.0);
  }
}

TEST(PassivityController, ForgetsASurplusOnceNothingIsRenderedButNotADebt) {
  PassivityController controller({.most_damping = 50.0, .period = kPeriod}, kDelay);
  constexpr double kSurplus = 0.1;
  for (int k = 1; k < PassivityController::kForget; ++k) controller.apply(kSurplus, {}, kIn);
  EXPECT_EQ(controller.apply(kSurplus - 0.01, kPush, kIn).force, kPush.force);  // too early: a wrench may still act
  for (int k = 0; k < PassivityController::kForget; ++k) controller.apply(kSurplus, {}, kIn);
  EXPECT_GT(controller.apply(kSurplus - 0.01, kPush, kIn).force.z(), 10.0);
  for (int k = 0; k < PassivityController::kForget; ++k) controller.apply(kSurplus - 0.01, {}, kIn);
  EXPECT_GT(controller.apply(kSurplus - 0.01, kPush, kIn).force.z(), 10.0);
  controller.reset();
  EXPECT_EQ(controller.apply(0.0, kPush, kIn).force, kPush.force);
}

/// A wrench that was rendered before a pause may still act during it. The surplus lasts for as long as that.
TEST(PassivityController, RemembersASurplusUntilNoWrenchActsAnyMore) {
  for (const double delay : {0.0, 13.5, 14.0, 14.5, 20.0, 20.5, static_cast<double>(PassivityObserver::kMostDelay)}) {
    const int periods = std::max(PassivityController::kForget, static_cast<int>(std::ceil(delay)) + 2);
    for (const int pause : {periods - 1, periods}) {
      PassivityController controller({.most_damping = 50.0, .period = kPeriod}, delay);
      controller.apply(0.1, kPush, kIn);
      for (int k = 0; k < pause; ++k) controller.apply(0.1, {}, kIn);
      const Wrench after_pause = controller.apply(0.05, kPush, kIn);
      EXPECT_EQ(after_pause.force == kPush.force, pause < periods) << delay << ", pause " << pause;
    }
  }
}

/// A surplus is what a wrench may still give back, as long as one is rendered.
TEST(PassivityController, ForgetsNoSurplusWhileAWrenchIsRendered) {
  PassivityController controller({.most_damping = 50.0, .period = kPeriod}, kDelay);
  for (int k = 0; k < 3 * PassivityController::kForget; ++k) controller.apply(0.1, kPush, kIn);
  EXPECT_EQ(controller.apply(0.05, kPush, kIn).force, kPush.force);
  // with a rendered wrench the count begins at 0 again
  for (int k = 1; k < PassivityController::kForget; ++k) controller.apply(0.1, {}, kIn);
  controller.apply(0.1, kPush, kIn);
  for (int k = 1; k < PassivityController::kForget; ++k) controller.apply(0.1, {}, kIn);
  EXPECT_EQ(controller.apply(0.05, kPush, kIn).force, kPush.force);
}

TEST(PassivityController, IsAsANewOneAfterAReset) {
  const PassivityController::Parameters parameters{.most_damping = 50.0, .period = kPeriod};
  PassivityController used(parameters, kDelay), fresh(parameters, kDelay);
  for (const double absorbed : {0.2, -1e-4}) {
    used.apply(absorbed, kPush, kIn);  // with damping and without
    used.reset();
    EXPECT_EQ(used.damping(), fresh.damping());
    EXPECT_EQ(used.damping(), 0.0);
  }
  used.apply(0.1, {}, kIn);
  used.reset();
  for (int k = 0; k < PassivityController::kForget - 1; ++k) {
    used.apply(0.1, {}, kIn);
    fresh.apply(0.1, {}, kIn);
  }
  for (const double absorbed : {0.05, -1e-4, -1.0}) {
    EXPECT_EQ(used.apply(absorbed, kPush, kIn).force, fresh.apply(absorbed, kPush, kIn).force) << absorbed;
    EXPECT_EQ(used.damping(), fresh.damping()) << absorbed;
  }
}

TEST(PassivityController, StaysFiniteAtTheEdgesOfNumbers) {
  PassivityController controller({.most_damping = 50.0, .period = kPeriod}, kDelay);
  for (const double force : {1e-200, 1e-160, 1e-30, 1e30}) {
    for (const double speed : {1e-200, 1e-160, 1e-30, 1e3}) {
      const Wrench out = controller.apply(-1.0, {.force = {0.0, force, 0.0}}, {.translation = {0.0, speed, 0.0}});
      EXPECT_TRUE(out.force.allFinite());
      EXPECT_LE(out.force.norm(), force);
    }
  }
}

}  // namespace
}  // namespace godobject
