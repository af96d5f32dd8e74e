#include "core/device/joint_torque.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/device/dynamics.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/arms.h"
#include "tests/support/decompositions.h"

namespace godobject {
namespace {

using test::Arm;
using test::Random;

using Vector6 = Eigen::Matrix<double, 6, 1>;

TorqueRequest request_at(const ArmModel& model, const JointVector& q) {
  TorqueRequest request;
  request.q = q;
  request.kinematics = forward_kinematics(model, q);
  request.p_RP = request.kinematics.H_RM.translation;
  return request;
}

JointTorque expect_ok(const Arm& arm, const TorqueRequest& request) {
  JointTorque result;
  EXPECT_EQ(joint_torque(arm.model, arm.parameters, request, result), Status::kOk);
  return result;
}

Vector6 stacked(const Wrench& F) {
  Vector6 vector;
  vector << F.force, F.torque;
  return vector;
}

/// Returns the Jacobian with its rotation rows in units of the force rows: Z J.
Jacobian weighted_jacobian(const Arm& arm, const TorqueRequest& request) {
  Jacobian J = geometric_jacobian(request.kinematics, request.p_RP);
  J.bottomRows<3>() *= arm.parameters.rotation_length;
  return J;
}

Vector6 singular_values(const Arm& arm, const TorqueRequest& request) {
  const Eigen::MatrixXd J = weighted_jacobian(arm, request);
  return test::singular_values_of(J).values;
}

double smallest_singular_value(const Arm& arm, const TorqueRequest& request) {
  return singular_values(arm, request)[std::min(6, arm.model.joint_count) - 1];
}

/// Returns the length of a wrench whose torque has the unit of its force: |Z^-1 F|.
double weighted_length(const Arm& arm, const Wrench& F) {
  return std::hypot(F.force.norm(), F.torque.norm() / arm.parameters.rotation_length);
}

JointVector torque_limits(const ArmModel& model) {
  JointVector limits = JointVector::Zero();
  for (int i = 0; i < model.joint_count; ++i) limits[i] = model.joints.at(static_cast<std::size_t>(i)).torque;
  return limits;
}

/// Returns the arm without springs and without damping.
Arm without_additions(Arm arm) {
  arm.parameters.null_damping.setZero();
  arm.parameters.limit_stiffness.setZero();
  arm.parameters.limit_damping.setZero();
  for (ArmJoint& joint : arm.model.joints) {
    joint.lower = -10.0;
    joint.upper = 10.0;
  }
  return arm;
}

Arm with_strong_joints(Arm arm) {
  for (ArmJoint& joint : arm.model.joints) joint.torque = 1e6;
  return arm;
}

TEST(JointTorque, IsGravityAndTransposedJacobianWhereNothingIsSingular) {
  Random random(1);
  for (const Arm& arm : {without_additions(test::lwr()), without_additions(test::desktop6())}) {
    int regular = 0;
    for (int i = 0; i < 5000; ++i) {
      TorqueRequest request = request_at(arm.model, test::random_joints(random, arm.model, 1.5));
      if (smallest_singular_value(arm, request) < arm.parameters.singular_full) continue;
      ++regular;
      request.p_RP += random.in_cube(0.02);
      if (smallest_singular_value(arm, request) < arm.parameters.singular_full) continue;
      request.F_P_R = {random.in_cube(0.1), random.in_cube(0.01)};
      const JointTorque result = expect_ok(arm, request);
      const JointVector gravity = gravity_torque(arm.model, request.kinematics);
      const Jacobian J = geometric_jacobian(request.kinematics, request.p_RP);
      ASSERT_LT((result.torque - gravity - J.transpose() * stacked(request.F_P_R)).norm(), 1e-12);
      ASSERT_LT((stacked(result.rendered_P_R) - stacked(request.F_P_R)).norm(), 1e-12);
      ASSERT_EQ(result.scale, 1.0);
      ASSERT_LT(result.left_out, 1e-12);
      ASSERT_FALSE(result.gravity_clipped);
    }
    EXPECT_GT(regular, 500);
  }
}

TEST(JointTorque, PowerOfTheRenderedWrenchIsPowerOfItsTorque) {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const Arm arm = without_additions(test::random_arm(random, 1 + i % kMaxJoints));
    TorqueRequest request = request_at(arm.model, test::random_joints(random, arm.model, 3.0));
    request.qd = test::random_joints(random, arm.model, 2.0);
    request.F_P_R = {random.in_cube(100.0), random.in_cube(20.0)};
    const JointTorque result = expect_ok(arm, request);
    const Motion velocity = tool_velocity(geometric_jacobian(request.kinematics, request.p_RP), request.qd);
    const double at_tool =
        result.rendered_P_R.force.dot(velocity.translation) + result.rendered_P_R.torque.dot(velocity.rotation);
    const double at_joints = (result.torque - result.gravity).dot(request.qd);
    ASSERT_NEAR(at_joints, at_tool, 1e-10 * (1.0 + weighted_length(arm, request.F_P_R))) << i;
  }
}

TEST(JointTorque, SingularDirectionsAreNeverAmplified) {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    Arm arm = with_strong_joints(without_additions(test::random_arm(random, 1 + i % kMaxJoints)));
    if (i % 3 == 0) {  // parallel axes, no offsets: singular or nearly singular in every posture
      for (ArmJoint& joint : arm.model.joints) {
        joint.alpha *= 1e-3;
        joint.d *= 1e-3;
      }
    }
    TorqueRequest request = request_at(arm.model, test::random_joints(random, arm.model, 3.0));
    request.F_P_R = {random.in_cube(10.0), random.in_cube(2.0)};
    const JointTorque result = expect_ok(arm, request);
    const Jacobian J = geometric_jacobian(request.kinematics, request.p_RP);
    const double rendered = (result.torque - result.gravity).norm();
    const double rounding = 1e-12 * (1.0 + result.gravity.norm());
    ASSERT_LE(rendered, (J.transpose() * stacked(request.F_P_R)).norm() + rounding) << i;
    ASSERT_LE(rendered, singular_values(arm, request)[0] * weighted_length(arm, request.F_P_R) + rounding) << i;
    ASSERT_LE(weighted_length(arm, result.rendered_P_R), weighted_length(arm, request.F_P_R) * (1.0 + 1e-12)) << i;
    ASSERT_GE(result.left_out, 0.0);
    ASSERT_LE(result.left_out, 1.0);
  }
}

/// Returns the largest change of torque between neighbouring postures on a straight path through joint space.
double largest_step(const Arm& arm, const JointVector& from, const JointVector& to, int steps, double& least_singular) {
  double largest = 0.0;
  JointVector last = JointVector::Zero();
  for (int i = 0; i <= steps; ++i) {
    TorqueRequest request = request_at(arm.model, from + (to - from) * i / steps);
    request.F_P_R = {Vector3(20.0, -30.0, 25.0), Vector3(1.0, 2.0, -1.5)};
    request.qd = JointVector::Zero();
    request.qd.head(arm.model.joint_count).setConstant(0.5);
    const JointVector torque = expect_ok(arm, request).torque;
    if (i > 0) largest = std::max(largest, (torque - last).norm());
    last = torque;
    least_singular = std::min(least_singular, smallest_singular_value(arm, request));
  }
  return largest;
}

/// Expects a bounded slope: a tenth of the step gives about a tenth of the change. A jump would keep its size.
void expect_continuous(const Arm& arm, const JointVector& from, const JointVector& to) {
  double least_singular = std::numeric_limits<double>::infinity();
  const double coarse = largest_step(arm, from, to, 2000, least_singular);
  const double fine = largest_step(arm, from, to, 20000, least_singular);
  EXPECT_LT(fine, 0.2 * coarse);
  EXPECT_LT(least_singular, 0.1 * arm.parameters.singular_none) << "the path misses the singularity";
}

TEST(JointTorque, IsContinuousThroughStretchedElbow) {
  const Arm arm = with_strong_joints(test::lwr());
  JointVector from;
  from << 0.3, 0.5, 0.2, -0.7, 0.4, 0.8, 0.1;
  JointVector to = from;
  to[3] = 0.6;
  expect_continuous(arm, from, to);
}

TEST(JointTorque, IsContinuousThroughWristSingularity) {
  Arm arm = with_strong_joints(test::desktop6());
  arm.model.joints[4].lower = -2.0;  // the arm itself stops before this limit
  arm.parameters.null_damping.setConstant(0.01);
  JointVector from;
  from << 0.3, 0.5, 0.2, 0.4, -1.8, 0.1, 0.0;
  JointVector to = from;
  to[4] = -1.3;
  expect_continuous(arm, from, to);
}

TEST(JointTorque, IsContinuousAtTorqueLimits) {
  const Arm arm = test::lwr();
  Random random(4);
  for (int i = 0; i < 5; ++i) {
    const JointVector from = test::random_joints(random, arm.model, 2.9);
    const JointVector to = test::random_joints(random, arm.model, 2.9);
    double least_singular = 1.0;
    const double coarse = largest_step(arm, from, to, 1000, least_singular);
    const double fine = largest_step(arm, from, to, 10000, least_singular);
    EXPECT_LT(fine, 0.2 * coarse) << i;
  }
}

TEST(JointTorque, LeavesOutWhatTheArmCannotShow) {
  // one joint about z, tool at 0.3 m along x: the arm can render a force along y, nothing else
  Arm arm;
  arm.model.joint_count = 1;
  arm.model.gravity_R.setZero();
  arm.model.H_FM.translation = Vector3(0.3, 0.0, 0.0);
  arm.model.joints[0].link.mass = 1.0;
  arm.model.joints[0].lower = -1.0;
  arm.model.joints[0].upper = 1.0;
  arm.model.joints[0].torque = 10.0;
  TorqueRequest request = request_at(arm.model, JointVector::Zero());
  request.F_P_R.force = Vector3(5.0, 0.0, 3.0);
  JointTorque result = expect_ok(arm, request);
  EXPECT_TRUE(result.torque.isZero(1e-15));
  EXPECT_NEAR(result.left_out, 1.0, 1e-15);

  request.F_P_R.force = Vector3(0.0, 5.0, 0.0);
  result = expect_ok(arm, request);
  EXPECT_NEAR(result.torque[0], 1.5, 1e-14);
  // the joint renders the part of a pure force along (y, L about z): cos^2 of the angle between them
  const double L = arm.parameters.rotation_length;
  EXPECT_NEAR(result.rendered_P_R.force.y(), 5.0 * 0.09 / (0.09 + L * L), 1e-13);
}

/// A wrench that does no work at any joint is left out as a whole. Rounding makes that no more than all of it.
TEST(JointTorque, LeavesOutNoMoreThanAllOfAWrench) {
  Random random(17);
  for (int i = 0; i < 500; ++i) {
    const int joints = 1 + i % 5;
    const Arm arm = with_strong_joints(without_additions(test::random_arm(random, joints)));
    TorqueRequest request = request_at(arm.model, test::random_joints(random, arm.model, 3.0));
    const Eigen::MatrixXd J = weighted_jacobian(arm, request);
    const Eigen::MatrixXd U = test::singular_values_of(J).U;
    Vector6 wanted = Vector6::Zero();
    for (int k = joints; k < 6; ++k) wanted += random.between(-10.0, 10.0) * U.col(k);
    request.F_P_R = {wanted.head<3>(), arm.parameters.rotation_length * wanted.tail<3>()};
    const JointTorque result = expect_ok(arm, request);
    ASSERT_LE(result.left_out, 1.0) << i;
    ASSERT_GE(result.left_out, 1.0 - 1e-12) << i;
  }
}

TEST(JointTorque, KeepsTheDirectionOfWhatIsTooStrong) {
  Random random(5);
  for (int i = 0; i < 5000; ++i) {
    const Arm arm = without_additions(test::random_arm(random, 1 + i % kMaxJoints));
    TorqueRequest request = request_at(arm.model, test::random_joints(random, arm.model, 3.0));
    request.F_P_R = {random.in_cube(1e-3), random.in_cube(1e-3)};
    const JointTorque weak = expect_ok(arm, request);
    if (weak.gravity_clipped) continue;
    const double factor = 1e7;
    request.F_P_R = {factor * request.F_P_R.force, factor * request.F_P_R.torque};
    const JointTorque strong = expect_ok(arm, request);
    const Vector6 expected = strong.scale * factor * stacked(weak.rendered_P_R);
    ASSERT_LE((stacked(strong.rendered_P_R) - expected).norm(), 1e-10 * expected.norm());
    // the tolerance covers the rounding of the small difference between the weak torque and gravity
    const JointVector torque = strong.scale * factor * (weak.torque - weak.gravity);
    ASSERT_LE((strong.torque - strong.gravity - torque).norm(), 1e-12 * (1.0 + strong.scale * factor) * 1e3);
    // the wrench is as strong as possible: one joint is at its limit
    if (strong.scale < 1.0) {
      const JointVector left = torque_limits(arm.model) - strong.torque.cwiseAbs();
      ASSERT_NEAR(left.head(arm.model.joint_count).minCoeff(), 0.0, 1e-9) << i;
    }
  }
}

TEST(JointTorque, NeverExceedsTheLimits) {
  Random random(6);
  for (int i = 0; i < 50000; ++i) {
    const Arm arm = test::random_arm(random, 1 + i % kMaxJoints);
    TorqueRequest request = request_at(arm.model, test::random_joints(random, arm.model, 4.0));
    request.qd = test::random_joints(random, arm.model, std::pow(10.0, random.between(-3.0, 4.0)));
    const double size = std::pow(10.0, random.between(-3.0, 150.0));
    request.F_P_R = {random.in_cube(size), random.in_cube(size)};
    const JointTorque result = expect_ok(arm, request);
    const JointVector limits = torque_limits(arm.model);
    ASSERT_TRUE((result.torque.array().abs() <= limits.array()).all()) << i;
    ASSERT_TRUE(result.torque.tail(kMaxJoints - arm.model.joint_count).isZero(0.0));
    ASSERT_GE(result.scale, 0.0);
    ASSERT_LE(result.scale, 1.0);
  }
}

TEST(JointTorque, HoldsTheArmWhateverElseIsAsked) {
  // rendered torques may use the rest of each limit in both directions, but no more
  const Arm arm = without_additions(test::lwr());
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    TorqueRequest request = request_at(arm.model, test::random_joints(random, arm.model, 2.0));
    request.F_P_R = {random.in_cube(1e4), random.in_cube(1e3)};
    const JointTorque result = expect_ok(arm, request);
    ASSERT_LT((result.gravity - gravity_torque(arm.model, request.kinematics)).norm(), 1e-12);
    const Jacobian J = geometric_jacobian(request.kinematics, request.p_RP);
    const JointVector rendered = J.transpose() * stacked(result.rendered_P_R);
    ASSERT_LT((result.torque - result.gravity - rendered).norm(), 1e-9);
  }
}

TEST(JointTorque, SaysThatAJointCannotHoldTheArm) {
  Arm arm = without_additions(test::lwr());
  arm.model.joints[1].torque = 5.0;
  JointVector q = JointVector::Zero();
  q[1] = 1.5;
  TorqueRequest request = request_at(arm.model, q);
  const JointTorque result = expect_ok(arm, request);
  EXPECT_TRUE(result.gravity_clipped);
  EXPECT_EQ(std::fabs(result.torque[1]), 5.0);
}

TEST(JointTorque, NullSpaceDampingIsNotFeltAtTheTool) {
  Arm arm = with_strong_joints(without_additions(test::lwr()));
  Random random(8);
  arm.parameters.null_damping = test::lwr().parameters.null_damping;
  int regular = 0;
  for (int i = 0; i < 5000; ++i) {
    TorqueRequest request = request_at(arm.model, test::random_joints(random, arm.model, 2.0));
    if (smallest_singular_value(arm, request) < arm.parameters.singular_full) continue;
    ++regular;
    request.qd = test::random_joints(random, arm.model, 2.0);
    const JointTorque result = expect_ok(arm, request);
    const JointVector damping = result.torque - result.gravity;
    const Jacobian J = geometric_jacobian(request.kinematics, request.p_RP);
    // the damping contains no torque that a wrench at the tool would balance
    ASSERT_LT((J * damping).norm(), 1e-10);
    ASSERT_GT(damping.norm(), 1e-6);
    // the damping takes power only from the motion that leaves the tool at rest
    const JointVector with_tool = test::pseudo_inverse_of(J) * (J * request.qd);
    ASSERT_NEAR(damping.dot(with_tool), 0.0, 1e-10);
    ASSERT_LT(damping.dot(request.qd), 0.0);
    request.qd = with_tool;
    const JointTorque moving = expect_ok(arm, request);
    ASSERT_LT((moving.torque - moving.gravity).norm(), 1e-10);
  }
  EXPECT_GT(regular, 1000);
}

TEST(JointTorque, DampingNeverGivesPower) {
  Random random(9);
  for (int i = 0; i < 20000; ++i) {
    Arm arm = without_additions(test::random_arm(random, 1 + i % kMaxJoints));
    for (int k = 0; k < arm.model.joint_count; ++k) arm.parameters.null_damping[k] = random.between(0.0, 5.0);
    TorqueRequest request = request_at(arm.model, test::random_joints(random, arm.model, 3.0));
    request.qd = test::random_joints(random, arm.model, 10.0);
    const JointTorque result = expect_ok(arm, request);
    ASSERT_LE((result.torque - result.gravity).dot(request.qd), 1e-10 * (1.0 + result.gravity.norm())) << i;
  }
}

TEST(JointTorque, SixRegularJointsAreNotDamped) {
  Arm arm = with_strong_joints(without_additions(test::desktop6()));
  arm.parameters.null_damping.setConstant(1.0);
  TorqueRequest request = request_at(arm.model, JointVector::Zero());
  request.qd.head<6>().setConstant(1.0);
  ASSERT_GT(smallest_singular_value(arm, request), arm.parameters.singular_full);
  const JointTorque result = expect_ok(arm, request);
  EXPECT_LT((result.torque - result.gravity).norm(), 1e-12);
}

TEST(JointTorque, SpringsPushAwayFromTheLimitsAndOnlyInTheBand) {
  Arm arm = with_strong_joints(test::desktop6());
  arm.model.gravity_R.setZero();
  for (int joint = 0; joint < arm.model.joint_count; ++joint) {
    const ArmJoint& limits = arm.model.joints.at(static_cast<std::size_t>(joint));
    const double band = arm.parameters.limit_band;
    const double k = arm.parameters.limit_stiffness[joint];
    const double b = arm.parameters.limit_damping[joint];
    const auto torque_at = [&](double position, double velocity) {
      JointVector q = JointVector::Zero();
      q[joint] = position;
      TorqueRequest request = request_at(arm.model, q);
      request.qd[joint] = velocity;
      return expect_ok(arm, request).torque[joint];
    };
    EXPECT_NEAR(torque_at(limits.upper, 0.0), -k * band, 1e-12);
    EXPECT_NEAR(torque_at(limits.lower, 0.0), k * band, 1e-12);
    EXPECT_NEAR(torque_at(limits.upper, 2.0), -k * band - 2.0 * b, 1e-12);
    EXPECT_NEAR(torque_at(limits.upper - 0.5 * band, 2.0), -0.5 * k * band - b, 1e-12);
    EXPECT_NEAR(torque_at(limits.upper, -2.0), -k * band, 1e-12);  // on the way back the damper does not act
    EXPECT_NEAR(torque_at(limits.upper - 1.001 * band, 5.0), 0.0, 1e-12);
    EXPECT_NEAR(torque_at(limits.lower + 1.001 * band, -5.0), 0.0, 1e-12);
    for (const double speed : {-5.0, 0.0, 5.0}) {
      for (double depth = 0.0; depth < 3.0 * band; depth += 0.01) {
        EXPECT_LE(torque_at(limits.upper - band + depth, speed), 0.0);
        EXPECT_GE(torque_at(limits.lower + band - depth, speed), 0.0);
      }
    }
  }
}

TEST(JointTorque, NoWrenchPressesTheArmThroughItsSprings) {
  Random random(10);
  for (Arm arm : {test::lwr(), test::desktop6()}) {
    arm.model.gravity_R.setZero();
    for (int i = 0; i < 2000; ++i) {
      const int joint = i % arm.model.joint_count;
      const ArmJoint& limits = arm.model.joints.at(static_cast<std::size_t>(joint));
      JointVector q = 0.8 * test::random_positions(random, arm.model);
      q[joint] = limits.upper;
      TorqueRequest request = request_at(arm.model, q);
      request.F_P_R = {random.in_cube(1e5), random.in_cube(1e4)};
      const JointTorque result = expect_ok(arm, request);
      const double spring =
          std::min(arm.parameters.limit_stiffness[joint] * arm.parameters.limit_band, 0.9 * limits.torque);
      ASSERT_LE(result.torque[joint], -0.1 * spring + 1e-9) << i;
    }
  }
}

/// The wrenches that a hand may feel are small beside the light-weight robot's torque limits. They fade, too.
TEST(JointTorque, FadesWhatPushesTowardsALimitFromTheBandOn) {
  const Arm arm = test::lwr();
  const double band = arm.parameters.limit_band;
  JointVector q;
  q << 0.0, -0.5, 0.0, 1.4, 0.0, -1.2, 0.0;
  for (const double side : {-1.0, 1.0}) {
    double last = 3.0;
    for (int step = 0; step <= 100; ++step) {
      const double share = 0.01 * step;
      const ArmJoint& flange = arm.model.joints[6];
      q[6] = (side > 0.0 ? flange.upper : flange.lower) - side * (1.0 - share) * band;
      TorqueRequest request = request_at(arm.model, q);
      request.F_P_R.torque = side * 3.0 * request.kinematics.axis_R[6];
      const double spring = arm.parameters.limit_stiffness[6] * share * band;
      const JointTorque result = expect_ok(arm, request);
      const double towards = side * (result.torque[6] - result.gravity[6]) + spring;
      ASSERT_LE(towards, std::max(1.0 - share, 0.9 * spring / 3.0) * 3.0 + 1e-9) << step;
      ASSERT_LE(last - towards, 3.0 * 0.011) << "the torque must fade evenly, step " << step;
      last = towards;
      request.F_P_R.torque = -request.F_P_R.torque;  // away from the limit the torque is unchanged
      EXPECT_NEAR(expect_ok(arm, request).scale, 1.0, 1e-12);
    }
  }
}

class NotFinite : public testing::TestWithParam<double> {};

TEST_P(NotFinite, GivesGravityOrNothing) {
  const double bad = GetParam();
  const Arm arm = test::lwr();
  JointVector q;
  q << 0.3, 0.5, 0.2, -0.7, 0.4, 0.8, 0.1;
  const TorqueRequest good = request_at(arm.model, q);
  const JointVector gravity = gravity_torque(arm.model, good.kinematics);
  JointTorque result;
  const auto expect_gravity = [&](const TorqueRequest& request) {
    EXPECT_EQ(joint_torque(arm.model, arm.parameters, request, result), Status::kNotFinite);
    EXPECT_TRUE(result.torque == gravity);
    EXPECT_EQ(result.scale, 0.0);
    EXPECT_TRUE(stacked(result.rendered_P_R).isZero(0.0));
  };
  for (int i = 0; i < 3; ++i) {
    TorqueRequest request = good;
    request.F_P_R.force[i] = bad;
    expect_gravity(request);
    request = good;
    request.F_P_R.torque[i] = bad;
    expect_gravity(request);
    request = good;
    request.p_RP[i] = bad;
    expect_gravity(request);
  }
  for (int i = 0; i < arm.model.joint_count; ++i) {
    TorqueRequest request = good;
    request.q[i] = bad;
    expect_gravity(request);
    request = good;
    request.qd[i] = bad;
    expect_gravity(request);
    request.q[i] = bad;
    request.kinematics = forward_kinematics(arm.model, request.q);
    EXPECT_EQ(joint_torque(arm.model, arm.parameters, request, result), Status::kNotFinite);
    EXPECT_TRUE(result.torque.allFinite());
  }
  TorqueRequest request = good;
  request.kinematics.H_RL[0].translation.x() = bad;
  EXPECT_EQ(joint_torque(arm.model, arm.parameters, request, result), Status::kNotFinite);
  EXPECT_TRUE(result.torque.isZero(0.0));
  EXPECT_FALSE(result.gravity.allFinite()) << "the caller learns that it does not hold the arm";
}

INSTANTIATE_TEST_SUITE_P(JointTorque, NotFinite,
                         testing::Values(std::numeric_limits<double>::quiet_NaN(),
                                         std::numeric_limits<double>::infinity(),
                                         -std::numeric_limits<double>::infinity()));

TEST(JointTorque, OverflowIsNotFinite) {
  const Arm arm = test::lwr();
  TorqueRequest request = request_at(arm.model, JointVector::Constant(0.4));
  request.F_P_R.force.setConstant(std::numeric_limits<double>::max());
  request.F_P_R.torque.setConstant(std::numeric_limits<double>::max());
  JointTorque result;
  EXPECT_EQ(joint_torque(arm.model, arm.parameters, request, result), Status::kNotFinite);
  EXPECT_TRUE(result.torque == result.gravity);
}

/// Numbers that are finite, with products that are not: of the damper in the null space, and of the limits' springs.
TEST(JointTorque, IsFiniteOrRefusedAtHugeVelocities) {
  constexpr double kHuge = std::numeric_limits<double>::max();
  int refused = 0;
  for (const Arm& arm : {test::lwr(), test::desktop6()}) {
    for (int i = 0; i < arm.model.joint_count; ++i) {
      for (const double sign : {1.0, -1.0}) {
        TorqueRequest request = request_at(arm.model, JointVector::Constant(0.4));
        request.F_P_R = {Vector3(1.0, 2.0, 3.0), Vector3(0.1, 0.2, 0.3)};
        request.qd.setConstant(0.5 * kHuge);
        request.qd[i] = sign * kHuge;
        Arm stiff = arm;
        stiff.parameters.null_damping.setConstant(kHuge);
        JointTorque result;
        const Status status = joint_torque(stiff.model, stiff.parameters, request, result);
        ASSERT_TRUE(result.torque.allFinite());
        ASSERT_TRUE(((torque_limits(arm.model) - result.torque.cwiseAbs()).array() >= 0.0).all());
        ASSERT_EQ(result.left_out == 0.0 || status == Status::kOk, true);
        if (status != Status::kNotFinite) continue;
        ++refused;
        ASSERT_TRUE(result.torque == result.gravity);
      }
    }
  }
  EXPECT_GT(refused, 0);
}

/// The point is finite, but the square of its lever is not. All axes of the planar arm are parallel: there is no sum of
/// infinite numbers with different signs.
TEST(JointTorque, AtAPointWhoseLeverHasNoSquareIsNotFinite) {
  Random random(13);
  Arm planar = test::random_arm(random, 3);
  planar.model.H_RA = {};
  for (ArmJoint& joint : planar.model.joints) joint.alpha = 0.0;
  for (const Arm& arm : {planar, test::lwr(), test::desktop6()}) {
    for (const Vector3& direction : {Vector3(1.0, 0.0, 0.0), Vector3(0.0, 1.0, 0.0), Vector3(-0.6, 0.8, 0.0)}) {
      TorqueRequest request = request_at(arm.model, JointVector::Constant(0.4));
      request.F_P_R = {Vector3(1.0, 2.0, 3.0), Vector3(0.1, 0.2, 0.3)};
      request.p_RP = 1e160 * direction;
      JointTorque result;
      EXPECT_EQ(joint_torque(arm.model, arm.parameters, request, result), Status::kNotFinite);
      EXPECT_TRUE(result.torque == result.gravity);
      EXPECT_TRUE(result.torque.allFinite());
    }
  }
}

TEST(JointTorque, DoesNotAllocate) {
  if (!test::AllocationGuard::works()) GTEST_SKIP() << "not run: a sanitizer holds the allocation functions";
  Random random(11);
  const Arm arms[] = {test::lwr(), test::desktop6(), test::random_arm(random, 3)};
  const test::AllocationGuard guard;
  double sum = 0.0;
  for (int i = 0; i < 300; ++i) {
    const Arm& arm = arms[i % 3];
    TorqueRequest request = request_at(arm.model, test::random_positions(random, arm.model));
    request.qd = test::random_joints(random, arm.model, 1.0);
    request.F_P_R = {random.in_cube(30.0), random.in_cube(3.0)};
    JointTorque result;
    if (validate(arm.model) != Status::kOk) break;
    if (joint_torque(arm.model, arm.parameters, request, result) != Status::kOk) break;
    sum += result.torque.sum() + mass_matrix(arm.model, request.kinematics).sum();
  }
  EXPECT_EQ(guard.allocations(), 0) << sum;
}

}  // namespace
}  // namespace godobject
