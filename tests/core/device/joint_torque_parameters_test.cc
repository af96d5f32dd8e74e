#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/device/joint_torque.h"
#include "tests/support/arms.h"

namespace godobject {
namespace {

using test::Arm;
using P = JointTorqueParameters;

constexpr double kLeastPositive = std::numeric_limits<double>::denorm_min();

template <class Change>
Status parameters_after(Change change) {
  static const Arm kArm = test::lwr();
  Arm arm = kArm;
  change(arm.parameters);
  return validate(arm.parameters, arm.model);
}

TEST(JointTorqueParameters, RefuseEveryNumberThatIsNotFinite) {
  Arm arm = test::lwr();
  P& p = arm.parameters;
  std::vector<double*> numbers = {&p.rotation_length, &p.singular_none, &p.singular_full, &p.limit_band};
  for (int i = 0; i < kMaxJoints; ++i) {
    for (JointVector* v : {&p.null_damping, &p.limit_stiffness, &p.limit_damping}) numbers.push_back(&(*v)[i]);
  }
  for (double* number : numbers) {
    const double good = *number;
    for (const double bad :
         {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
      *number = bad;
      ASSERT_EQ(validate(p, arm.model), Status::kNotFinite) << "number " << number - numbers[0];
    }
    *number = good;
    ASSERT_EQ(validate(p, arm.model), Status::kOk);
  }
}

TEST(JointTorqueParameters, AreTakenUpToTheirBounds) {
  EXPECT_EQ(parameters_after([](P& p) { p.rotation_length = 0.0; }), Status::kArmControl);
  EXPECT_EQ(parameters_after([](P& p) { p.rotation_length = kLeastPositive; }), Status::kOk);
  EXPECT_EQ(parameters_after([](P& p) { p.limit_band = 0.0; }), Status::kArmControl);
  EXPECT_EQ(parameters_after([](P& p) { p.limit_band = kLeastPositive; }), Status::kOk);
  EXPECT_EQ(parameters_after([](P& p) { p.singular_none = 0.0; }), Status::kArmControl);
  EXPECT_EQ(parameters_after([](P& p) { p.singular_none = -1.0; }), Status::kArmControl);
  EXPECT_EQ(parameters_after([](P& p) { p.singular_none = kLeastPositive; }), Status::kOk);
  EXPECT_EQ(parameters_after([](P& p) { p.singular_full = p.singular_none; }), Status::kArmControl);
  EXPECT_EQ(parameters_after([](P& p) { p.singular_full = std::nextafter(p.singular_none, 1.0); }), Status::kOk);
  EXPECT_EQ(parameters_after([](P& p) { p.singular_full = 1e300; }), Status::kOk);
}

TEST(JointTorqueParameters, MayBeZeroButNotNegativeAtEachJoint) {
  for (JointVector P::*numbers : {&P::null_damping, &P::limit_stiffness, &P::limit_damping}) {
    for (int i = 0; i < kMaxJoints; ++i) {
      EXPECT_EQ(parameters_after([&](P& p) { (p.*numbers)[i] = 0.0; }), Status::kOk) << i;
      EXPECT_EQ(parameters_after([&](P& p) { (p.*numbers)[i] = -kLeastPositive; }), Status::kArmControl) << i;
    }
    EXPECT_EQ(parameters_after([&](P& p) { (p.*numbers).setZero(); }), Status::kOk);
  }
}

/// Two bands may meet in the middle of a joint's range, but not overlap.
TEST(JointTorqueParameters, HaveABandThatFitsIntoTheRangeOfEachJoint) {
  for (int i = 0; i < 6; ++i) {
    Arm arm = test::desktop6();  // there is no seventh joint: its range of zero does not count
    ArmJoint& joint = arm.model.joints.at(static_cast<std::size_t>(i));
    joint.lower = 0.25;
    joint.upper = 0.75;
    arm.parameters.limit_band = 0.25;
    EXPECT_EQ(validate(arm.parameters, arm.model), Status::kOk) << i;
    arm.parameters.limit_band = std::nextafter(0.25, 1.0);
    EXPECT_EQ(validate(arm.parameters, arm.model), Status::kArmControl) << i;
  }
}

/// The numbers that the header states. A device file may omit them.
TEST(JointTorqueParameters, BeginWithTheStatedNumbers) {
  const P p;
  EXPECT_EQ(p.rotation_length, 0.16);
  EXPECT_EQ(p.singular_none, 0.005);
  EXPECT_EQ(p.singular_full, 0.02);
  EXPECT_EQ(p.limit_band, 0.1);
  EXPECT_TRUE(p.null_damping.isZero(0.0) && p.limit_stiffness.isZero(0.0) && p.limit_damping.isZero(0.0));
  EXPECT_EQ(validate(p, test::lwr().model), Status::kOk);
}

}  // namespace
}  // namespace godobject
