#include "core/device/arm_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

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

/// Returns all numbers of a body.
std::vector<double*> numbers_of(LinkMass& body) {
  std::vector<double*> numbers = {&body.mass};
  for (int i = 0; i < 3; ++i) numbers.push_back(&body.com[i]);
  for (int i = 0; i < 9; ++i) numbers.push_back(&body.inertia(i / 3, i % 3));
  return numbers;
}

/// Returns all numbers of an arm.
std::vector<double*> numbers_of(ArmModel& m) {
  std::vector<double*> numbers = numbers_of(m.payload);
  for (int i = 0; i < 3; ++i) {
    for (Vector3* v : {&m.gravity_R, &m.H_RA.translation, &m.H_FM.translation}) numbers.push_back(&(*v)[i]);
  }
  for (int i = 0; i < 4; ++i) {
    for (Pose* pose : {&m.H_RA, &m.H_FM}) numbers.push_back(&pose->rotation.coeffs()[i]);
  }
  for (int k = 0; k < m.joint_count; ++k) {
    ArmJoint& joint = m.joints.at(static_cast<std::size_t>(k));
    for (double* number : numbers_of(joint.link)) numbers.push_back(number);
    for (double* number : {&joint.a, &joint.alpha, &joint.d, &joint.offset, &joint.lower, &joint.upper, &joint.velocity,
                           &joint.torque, &joint.rotor, &joint.damping}) {
      numbers.push_back(number);
    }
  }
  return numbers;
}

TEST(ArmModel, RefusesEveryNumberThatIsNotFinite) {
  ArmModel model = test::lwr().model;
  const std::vector<double*> numbers = numbers_of(model);
  ASSERT_EQ(numbers.size(), 13u + 3u + 14u + 7u * (13u + 10u));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double good = *numbers[i];
    for (const double bad : {kNaN, kInfinity, -kInfinity}) {
      *numbers[i] = bad;
      ASSERT_EQ(validate(model), Status::kNotFinite) << "number " << i;
    }
    *numbers[i] = good;
    ASSERT_EQ(validate(model), Status::kOk);
  }
}

TEST(ArmModel, TakesAnyFiniteGeometry) {
  EXPECT_EQ(after([](ArmModel& m) {
              for (ArmJoint& joint : m.joints) joint.a = joint.alpha = joint.d = joint.offset = 1e308;
            }),
            Status::kOk);
}

TEST(ArmModel, DoesNotLookAtJointsThatTheArmLacks) {
  ArmModel model = test::desktop6().model;
  ASSERT_EQ(model.joint_count, 6);
  model.joints[6].link.mass = kNaN;
  EXPECT_EQ(validate(model), Status::kOk);
}

/// A model that only names its joints: no geometry, nothing that could pass `validate` unless it is set.
TEST(ArmModel, BeginsWithNothingButEarthsGravity) {
  const ArmModel model;
  EXPECT_EQ(model.joint_count, 0);
  EXPECT_EQ(model.gravity_R, Vector3(0.0, 0.0, -9.81));
  EXPECT_TRUE(model.H_RA == Pose() && model.H_FM == Pose());
  ArmModel copy = model;
  copy.joint_count = kMaxJoints;
  std::vector<double*> numbers = numbers_of(copy);
  const auto first_of_joints = numbers.begin() + 13 + 9 + 8;
  EXPECT_TRUE(std::all_of(numbers.begin(), numbers.begin() + 13, [](const double* number) { return *number == 0.0; }));
  EXPECT_TRUE(std::all_of(first_of_joints, numbers.end(), [](const double* number) { return *number == 0.0; }));
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

/// Expects `status` if the link of any joint, and only if that link, is changed.
template <class Change>
void expect_for_each_joint(Status status, Change change) {
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    EXPECT_EQ(after([&](ArmModel& m) { change(m.joints.at(i)); }), status) << "joint " << i + 1;
  }
}

TEST(ArmModel, TakesEachMassUpToItsBoundAtEachJoint) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  expect_for_each_joint(Status::kArmMass, [](ArmJoint& j) { j.link.mass = 0.0; });
  expect_for_each_joint(Status::kOk, [](ArmJoint& j) { j.link.mass = kLeast; });
  expect_for_each_joint(Status::kArmMass, [](ArmJoint& j) { j.rotor = -kLeast; });
  expect_for_each_joint(Status::kOk, [](ArmJoint& j) { j.rotor = 0.0; });
  expect_for_each_joint(Status::kArmMass, [](ArmJoint& j) { j.damping = -kLeast; });
  expect_for_each_joint(Status::kOk, [](ArmJoint& j) { j.damping = 0.0; });
  EXPECT_EQ(after([](ArmModel& m) { m.payload.mass = -kLeast; }), Status::kArmMass);
  EXPECT_EQ(after([](ArmModel& m) { m.payload.mass = 0.0; }), Status::kOk);
}

TEST(ArmModel, TakesEachLimitUpToItsBoundAtEachJoint) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  expect_for_each_joint(Status::kArmLimits, [](ArmJoint& j) { j.lower = j.upper; });
  expect_for_each_joint(Status::kOk, [](ArmJoint& j) { j.lower = std::nextafter(j.upper, -10.0); });
  expect_for_each_joint(Status::kArmLimits, [](ArmJoint& j) { j.velocity = 0.0; });
  expect_for_each_joint(Status::kOk, [](ArmJoint& j) { j.velocity = kLeast; });
  expect_for_each_joint(Status::kArmLimits, [](ArmJoint& j) { j.torque = 0.0; });
  expect_for_each_joint(Status::kOk, [](ArmJoint& j) { j.torque = kLeast; });
}

TEST(ArmModel, TakesRotationsOfUnitLengthToAMillionth) {
  for (const double error : {-1.0, 1.0}) {
    for (Pose ArmModel::*pose : {&ArmModel::H_RA, &ArmModel::H_FM}) {
      const auto with_length = [&](double length) {
        return after([&](ArmModel& m) {
          (m.*pose).rotation = exp_rotation(Vector3(0.3, -0.2, 0.5));
          (m.*pose).rotation.coeffs() *= length;
        });
      };
      EXPECT_EQ(with_length(1.0 + 0.9e-6 * error), Status::kOk);
      EXPECT_EQ(with_length(1.0 + 1.1e-6 * error), Status::kArmShape);
    }
  }
}

/// The tolerance is a millionth of the largest element, whatever the size of the body.
TEST(ArmModel, TakesInertiasThatAreRoundedToAMillionth) {
  for (const double size : {1e-9, 1.0, 1e6}) {
    const auto status = [&](const Matrix3& inertia) {
      const Status of_payload = after([&](ArmModel& m) { m.payload.inertia = size * inertia; });
      expect_for_each_joint(of_payload, [&](ArmJoint& j) { j.link.inertia = size * inertia; });
      return of_payload;
    };
    const Matrix3 ball = Matrix3::Identity();
    for (int i = 0; i < 9; ++i) {
      if (i % 4 == 0) continue;  // of the diagonal
      for (const double side : {-1.0, 1.0}) {
        Matrix3 skew = ball;
        skew(i / 3, i % 3) = side * 0.9e-6;
        EXPECT_EQ(status(skew), Status::kOk) << i;
        skew(i / 3, i % 3) = side * 1.1e-6;
        EXPECT_EQ(status(skew), Status::kArmMass) << i;
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      // a disc of moments (1, 1, 2): two of half the size, and their sum
      Vector3 disc = Vector3::Constant(0.5);
      disc[axis] = 1.0 + 0.9 * 2e-6;  // half of the excess is missing in the second moments
      EXPECT_EQ(status(disc.asDiagonal()), Status::kOk) << axis;
      disc[axis] = 1.0 + 1.1 * 2e-6;
      EXPECT_EQ(status(disc.asDiagonal()), Status::kArmMass) << axis;
    }
  }
}

/// A flat plate and a thin rod lie on the bound. Their rotation leaves rounding errors on both sides of it.
TEST(ArmModel, TakesFlatBodiesHoweverTheyAreTurned) {
  test::Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double share = random.between(0.0, 1.0);
    const Vector3 moments = i % 3 == 0 ? Vector3(0.0, 1.0, 1.0) : Vector3(share, 1.0 - share, 1.0);
    const Matrix3 R = exp_rotation(random.motion(0.0, 3.0).rotation).toRotationMatrix();
    ASSERT_EQ(after([&](ArmModel& m) { m.payload.inertia = R * moments.asDiagonal() * R.transpose(); }), Status::kOk)
        << moments.transpose();
  }
}

TEST(ArmModel, JudgesTurnedInertiasAsItDoesStraightOnes) {
  test::Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const Vector3 moments(random.between(-0.2, 1.0), random.between(0.0, 1.0), random.between(0.0, 1.0));
    const double worst = std::min({moments.x(), moments.x() + moments.y() - moments.z(),
                                   moments.y() + moments.z() - moments.x(), moments.z() + moments.x() - moments.y()});
    if (std::fabs(worst) < 1e-5) continue;
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
