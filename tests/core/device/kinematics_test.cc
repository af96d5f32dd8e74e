#include "core/device/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "core/device/dynamics.h"
#include "tests/support/arms.h"
#include "tests/support/kdl_arm.h"

namespace godobject {
namespace {

using test::Arm;
using test::Random;

/// The same arm in Orocos KDL, an independent implementation.
class Oracle {
 public:
  explicit Oracle(const ArmModel& model)
      : chain_(test::make_chain(model)),
        pose_(chain_),
        jacobian_(chain_),
        dynamics_(chain_, test::to_kdl(model.gravity_R)) {}

  void expect_equal(const ArmModel& model, const JointVector& q) {
    constexpr double kTolerance = 1e-9;  // for values of at most some hundred metres, Nm or kg m^2
    const int n = model.joint_count;
    const auto size = static_cast<unsigned>(n);
    const ArmKinematics kinematics = forward_kinematics(model, q);
    KDL::JntArray positions(size);
    positions.data = q.head(n);

    KDL::Frame H_RM;
    ASSERT_GE(pose_.JntToCart(positions, H_RM), 0);
    const Matrix3 R_RM = kinematics.H_RM.rotation.toRotationMatrix();
    for (int i = 0; i < 3; ++i) {
      ASSERT_NEAR(kinematics.H_RM.translation[i], H_RM.p(i), kTolerance);
      for (int j = 0; j < 3; ++j) ASSERT_NEAR(R_RM(i, j), H_RM.M(i, j), kTolerance);
    }

    KDL::Jacobian jacobian(size);
    ASSERT_GE(jacobian_.JntToJac(positions, jacobian), 0);
    const Jacobian ours = geometric_jacobian(kinematics, kinematics.H_RM.translation);
    ASSERT_LT((ours.leftCols(n) - jacobian.data).cwiseAbs().maxCoeff(), kTolerance);
    ASSERT_TRUE(ours.rightCols(kMaxJoints - n).isZero(0.0));

    KDL::JntArray gravity(size);
    ASSERT_GE(dynamics_.JntToGravity(positions, gravity), 0);
    const JointVector torque = gravity_torque(model, kinematics);
    ASSERT_LT((torque.head(n) - gravity.data).cwiseAbs().maxCoeff(), kTolerance);
    ASSERT_TRUE(torque.tail(kMaxJoints - n).isZero(0.0));

    KDL::JntSpaceInertiaMatrix mass(n);
    ASSERT_GE(dynamics_.JntToMass(positions, mass), 0);
    const JointMatrix ours_mass = mass_matrix(model, kinematics);
    ASSERT_LT((ours_mass.topLeftCorner(n, n) - mass.data).cwiseAbs().maxCoeff(), kTolerance);
    ASSERT_TRUE(ours_mass.rightCols(kMaxJoints - n).isZero(0.0));
    ASSERT_TRUE(ours_mass == ours_mass.transpose());
  }

 private:
  KDL::Chain chain_;
  KDL::ChainFkSolverPos_recursive pose_;
  KDL::ChainJntToJacSolver jacobian_;
  KDL::ChainDynParam dynamics_;
};

void expect_as_kdl(const ArmModel& model, unsigned seed) {
  Random random(seed);
  Oracle oracle(model);
  for (int i = 0; i < 10000; ++i) {
    SCOPED_TRACE(i);
    oracle.expect_equal(model, test::random_positions(random, model));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Kinematics, HaveNoJointUntilTheyAreComputed) {
  EXPECT_EQ(ArmKinematics{}.joint_count, 0);
  EXPECT_TRUE(geometric_jacobian(ArmKinematics{}, Vector3::UnitX()).isZero(0.0));
}

TEST(Kinematics, LightWeightRobotIsAsOrocosHasIt) { expect_as_kdl(test::lwr().model, 1); }
TEST(Kinematics, DesktopArmIsAsOrocosHasIt) { expect_as_kdl(test::desktop6().model, 2); }

TEST(Kinematics, AnyArmIsAsOrocosHasIt) {
  Random random(3);
  for (int i = 0; i < 2100; ++i) {
    SCOPED_TRACE(i);
    const ArmModel model = test::random_arm(random, 1 + i % kMaxJoints).model;
    ASSERT_EQ(validate(model), Status::kOk);
    Oracle oracle(model);
    for (int k = 0; k < 5; ++k) {
      oracle.expect_equal(model, test::random_positions(random, model));
      if (HasFatalFailure()) return;
    }
  }
}

/// Returns two links in the vertical plane: joints about -y of R, q = 0 along x, positive angles upwards.
ArmModel planar_arm() {
  ArmModel model;
  model.joint_count = 2;
  model.H_RA.rotation = exp_rotation(Vector3(0.5 * M_PI, 0.0, 0.0));
  model.joints[1].a = 0.4;
  model.joints[0].link = {2.0, Vector3(0.2, 0.0, 0.0), Vector3(0.0, 0.01, 0.01).asDiagonal()};
  model.joints[1].link = {1.0, Vector3(0.15, 0.0, 0.0), Vector3(0.0, 0.02, 0.02).asDiagonal()};
  model.H_FM.translation = Vector3(0.3, 0.0, 0.0);
  return model;
}

TEST(Kinematics, PlanarArmIsAsByHand) {
  const ArmModel model = planar_arm();
  const double q1 = 0.3;
  const double q2 = 0.9;
  JointVector q = JointVector::Zero();
  q.head<2>() << q1, q2;
  const ArmKinematics kinematics = forward_kinematics(model, q);
  const double x = 0.4 * std::cos(q1) + 0.3 * std::cos(q1 + q2);
  const double z = 0.4 * std::sin(q1) + 0.3 * std::sin(q1 + q2);
  EXPECT_LT((kinematics.H_RM.translation - Vector3(x, 0.0, z)).norm(), 1e-15);

  const Jacobian J = geometric_jacobian(kinematics, kinematics.H_RM.translation);
  const double x2 = 0.3 * std::cos(q1 + q2);
  const double z2 = 0.3 * std::sin(q1 + q2);
  Jacobian expected = Jacobian::Zero();
  expected.col(0) << -z, 0.0, x, 0.0, -1.0, 0.0;
  expected.col(1) << -z2, 0.0, x2, 0.0, -1.0, 0.0;
  EXPECT_LT((J - expected).norm(), 1e-15);

  const JointVector gravity = gravity_torque(model, kinematics);
  const double second = 9.81 * 1.0 * 0.15 * std::cos(q1 + q2);
  EXPECT_NEAR(gravity[0], 9.81 * (2.0 * 0.2 + 1.0 * 0.4) * std::cos(q1) + second, 1e-13);
  EXPECT_NEAR(gravity[1], second, 1e-13);

  const JointMatrix M = mass_matrix(model, kinematics);
  const double coupling = 1.0 * 0.4 * 0.15 * std::cos(q2);
  const double M22 = 0.02 + 1.0 * 0.15 * 0.15;
  EXPECT_NEAR(M(0, 0), 0.01 + 2.0 * 0.2 * 0.2 + 1.0 * 0.4 * 0.4 + M22 + 2.0 * coupling, 1e-14);
  EXPECT_NEAR(M(0, 1), M22 + coupling, 1e-14);
  EXPECT_NEAR(M(1, 1), M22, 1e-14);
}

/// Returns the velocity of a tool point and the angular velocity, by central differences of the poses.
Motion velocity_by_differences(const ArmModel& model, const JointVector& q, const JointVector& qd, const Vector3& p_M) {
  constexpr double kStep = 1e-5;  // error: kStep^2 times the third derivatives, plus rounding divided by kStep
  const Pose before = forward_kinematics(model, q - kStep * qd).H_RM;
  const Pose after = forward_kinematics(model, q + kStep * qd).H_RM;
  return {(after * p_M - before * p_M) / (2.0 * kStep),
          log_rotation(after.rotation * before.rotation.conjugate()) / (2.0 * kStep)};
}

TEST(Kinematics, PowerAtTheToolIsPowerAtTheJoints) {
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const ArmModel model = test::random_arm(random, 1 + i % kMaxJoints).model;
    const JointVector q = test::random_positions(random, model);
    const JointVector qd = test::random_joints(random, model, 1.0);
    const ArmKinematics kinematics = forward_kinematics(model, q);
    const Vector3 p_M = random.in_cube(0.5);
    const Jacobian J = geometric_jacobian(kinematics, kinematics.H_RM * p_M);
    const Motion expected = velocity_by_differences(model, q, qd, p_M);
    const Motion velocity = tool_velocity(J, qd);
    ASSERT_LT((velocity.translation - expected.translation).norm(), 1e-7) << i;
    ASSERT_LT((velocity.rotation - expected.rotation).norm(), 1e-7) << i;
    Eigen::Matrix<double, 6, 1> F;
    F << random.in_cube(10.0), random.in_cube(1.0);
    const double at_tool = F.head<3>().dot(expected.translation) + F.tail<3>().dot(expected.rotation);
    ASSERT_NEAR((J.transpose() * F).dot(qd), at_tool, 1e-5) << i;
  }
}

double potential_energy(const ArmModel& model, const JointVector& q) {
  const ArmKinematics kinematics = forward_kinematics(model, q);
  double energy = -model.payload.mass * model.gravity_R.dot(kinematics.H_RM * model.payload.com);
  for (int i = 0; i < model.joint_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const LinkMass& link = model.joints.at(k).link;
    energy -= link.mass * model.gravity_R.dot(kinematics.H_RL.at(k) * link.com);
  }
  return energy;
}

TEST(Dynamics, GravityTorqueIsTheGradientOfPotentialEnergy) {
  constexpr double kStep = 1e-4;
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const ArmModel model = test::random_arm(random, 1 + i % kMaxJoints).model;
    const JointVector q = test::random_positions(random, model);
    const JointVector torque = gravity_torque(model, forward_kinematics(model, q));
    for (int j = 0; j < model.joint_count; ++j) {
      const JointVector step = kStep * JointVector::Unit(j);
      const double slope = (potential_energy(model, q + step) - potential_energy(model, q - step)) / (2.0 * kStep);
      ASSERT_NEAR(torque[j], slope, 1e-5) << i;
    }
  }
}

TEST(Dynamics, FarFromTheOriginOnlyPositionsAreLost) {
  Arm arm = test::lwr();
  Random random(6);
  const JointVector q = test::random_positions(random, arm.model);
  const JointMatrix near = mass_matrix(arm.model, forward_kinematics(arm.model, q));
  arm.model.H_RA.translation = Vector3(1e4, -1e4, 1e4);
  const JointMatrix far = mass_matrix(arm.model, forward_kinematics(arm.model, q));
  EXPECT_LT((near - far).cwiseAbs().maxCoeff(), 1e-10);  // positions of 1e4 m are rounded to 1e4 * 2^-52 m
}

}  // namespace
}  // namespace godobject
