#include "core/device/arm_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/arms.h"

namespace godobject {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(DeviceFiles, AreArms) {
  for (const auto& arm : {test::lwr(), test::desktop6()}) {
    EXPECT_EQ(validate(arm.model), Status::kOk);
    EXPECT_EQ(validate(arm.parameters, arm.model), Status::kOk);
  }
}

TEST(DeviceFiles, LightWeightRobotIsThePublishedOne) {
  const ArmModel model = test::lwr().model;
  ASSERT_EQ(model.joint_count, 7);
  // straight up at zero: 0.3105 + 0.4 + 0.39 + 0.078 to the flange, 0.08 to the handle
  const ArmKinematics straight = forward_kinematics(model, JointVector::Zero());
  EXPECT_LT((straight.H_RM.translation - Vector3(0.0, 0.0, 1.2585)).norm(), 1e-12);
  EXPECT_LT(log_rotation(straight.H_RM.rotation).norm(), 1e-12);
  double mass = 0.0;
  for (const ArmJoint& joint : model.joints) mass += joint.link.mass;
  EXPECT_NEAR(mass, 14.4, 1e-12);
}

TEST(DeviceFiles, DesktopArmHasItsPostureAtZero) {
  const ArmModel model = test::desktop6().model;
  const ArmKinematics rest = forward_kinematics(model, JointVector::Zero());
  // turntable 0.12 m up, upper arm 0.14 m forward, forearm 0.14 m down, stylus 0.04 m at a right angle to it
  EXPECT_LT((rest.H_RL[4].translation - Vector3(0.14, 0.0, -0.02)).norm(), 1e-12);
  EXPECT_NEAR((rest.H_RM.translation - rest.H_RL[5].translation).z(), 0.0, 1e-12);
  EXPECT_NEAR((rest.H_RM.translation - rest.H_RL[5].translation).norm(), 0.04, 1e-12);
}

template <class Change>
Status after(Change change) {
  static const ArmModel kArm = test::lwr().model;
  ArmModel model = kArm;
  change(model);
  return validate(model);
}

TEST(ArmModel, RefusesWhatIsNotFinite) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_EQ(after([&](ArmModel& m) { m.joints[6].a = bad; }), Status::kNotFinite);
    EXPECT_EQ(after([&](ArmModel& m) { m.joints[0].upper = bad; }), Status::kNotFinite);
    EXPECT_EQ(after([&](ArmModel& m) { m.joints[3].link.com.y() = bad; }), Status::kNotFinite);
    EXPECT_EQ(after([&](ArmModel& m) { m.joints[3].link.inertia(2, 0) = bad; }), Status::kNotFinite);
    EXPECT_EQ(after([&](ArmModel& m) { m.payload.mass = bad; }), Status::kNotFinite);
    EXPECT_EQ(after([&](ArmModel& m) { m.gravity_R.x() = bad; }), Status::kNotFinite);
    EXPECT_EQ(after([&](ArmModel& m) { m.H_RA.translation.x() = bad; }), Status::kNotFinite);
    EXPECT_EQ(after([&](ArmModel& m) { m.H_FM.rotation.x() = bad; }), Status::kNotFinite);
  }
}

TEST(ArmModel, RefusesJointCountsAndRotationsThatCannotBe) {
  EXPECT_EQ(after([](ArmModel& m) { m.joint_count = 0; }), Status::kArmShape);
  EXPECT_EQ(after([](ArmModel& m) { m.joint_count = -1; }), Status::kArmShape);
  EXPECT_EQ(after([](ArmModel& m) { m.joint_count = kMaxJoints + 1; }), Status::kArmShape);
  EXPECT_EQ(after([](ArmModel& m) { m.H_RA.rotation.w() = 1.01; }), Status::kArmShape);
  EXPECT_EQ(after([](ArmModel& m) { m.H_FM.rotation.coeffs().setZero(); }), Status::kArmShape);
}

TEST(ArmModel, RefusesMassesThatNoBodyHas) {
  const auto inertia = [](double x, double y, double z) { return Matrix3(Vector3(x, y, z).asDiagonal()); };
  EXPECT_EQ(after([](ArmModel& m) { m.joints[2].link.mass = 0.0; }), Status::kArmMass);
  EXPECT_EQ(after([](ArmModel& m) { m.joints[2].rotor = -1e-9; }), Status::kArmMass);
  EXPECT_EQ(after([](ArmModel& m) { m.joints[2].damping = -1e-9; }), Status::kArmMass);
  EXPECT_EQ(after([](ArmModel& m) { m.payload.mass = -1.0; }), Status::kArmMass);
  EXPECT_EQ(after([](ArmModel& m) { m.joints[2].link.inertia(0, 1) = 1e-3; }), Status::kArmMass);
  EXPECT_EQ(after([&](ArmModel& m) { m.joints[2].link.inertia = inertia(-0.1, 0.1, 0.1); }), Status::kArmMass);
  EXPECT_EQ(after([&](ArmModel& m) { m.joints[2].link.inertia = inertia(0.1, 0.1, 0.21); }), Status::kArmMass);
  EXPECT_EQ(after([&](ArmModel& m) { m.payload.inertia = inertia(0.1, 0.3, 0.1); }), Status::kArmMass);
  // limits of the triangle inequality: a disc, a rod, a point
  EXPECT_EQ(after([&](ArmModel& m) { m.joints[2].link.inertia = inertia(0.1, 0.1, 0.2); }), Status::kOk);
  EXPECT_EQ(after([&](ArmModel& m) { m.joints[2].link.inertia = inertia(0.1, 0.1, 0.0); }), Status::kOk);
  EXPECT_EQ(after([&](ArmModel& m) { m.joints[2].link.inertia.setZero(); }), Status::kOk);
  EXPECT_EQ(after([](ArmModel& m) { m.payload = LinkMass(); }), Status::kOk);
}

TEST(ArmModel, JudgesTurnedInertiasAsItDoesStraightOnes) {
  test::Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const Vector3 moments(random.between(-0.2, 1.0), random.between(0.0, 1.0), random.between(0.0, 1.0));
    const double worst = std::min({moments.x(), moments.x() + moments.y() - moments.z(),
                                   moments.y() + moments.z() - moments.x(), moments.z() + moments.x() - moments.y()});
    if (std::fabs(worst) < 1e-4) continue;
    const Matrix3 R = exp_rotation(random.motion(0.0, 3.0).rotation).toRotationMatrix();
    const Status status = after([&](ArmModel& m) { m.payload.inertia = R * moments.asDiagonal() * R.transpose(); });
    ASSERT_EQ(status, worst > 0.0 ? Status::kOk : Status::kArmMass) << moments.transpose();
  }
}

TEST(ArmModel, RefusesLimitsOutOfOrder) {
  EXPECT_EQ(after([](ArmModel& m) { m.joints[4].lower = m.joints[4].upper; }), Status::kArmLimits);
  EXPECT_EQ(after([](ArmModel& m) { m.joints[4].velocity = 0.0; }), Status::kArmLimits);
  EXPECT_EQ(after([](ArmModel& m) { m.joints[4].torque = -1.0; }), Status::kArmLimits);
}

}  // namespace
}  // namespace godobject
