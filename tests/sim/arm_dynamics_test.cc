#include "sim/arm_dynamics.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "tests/support/arms.h"
#include "tests/support/kdl_arm.h"

namespace godobject::sim {
namespace {

using test::Random;

constexpr double kTolerance = 1e-9;  // of metres, Nm and kg m^2 in the hundreds at most

/// Kinematics and inverse dynamics of Orocos KDL, wrench on the tool included.
class Oracle {
 public:
  explicit Oracle(const ArmModel& model)
      : chain_(test::make_chain(model)),
        pose_(chain_),
        jacobian_(chain_),
        torque_(chain_, test::to_kdl(model.gravity_R)),
        wrenches_(chain_.getNrOfSegments(), KDL::Wrench::Zero()),
        n_(model.joint_count),
        q_(size()),
        qd_(size()),
        qdd_(size()),
        needed_(size()) {}

  KDL::Frame pose(const JointVector& q) {
    q_.data = q.head(n_);
    KDL::Frame H_RM;
    EXPECT_GE(pose_.JntToCart(q_, H_RM), 0);
    return H_RM;
  }

  Eigen::MatrixXd jacobian(const JointVector& q) {
    q_.data = q.head(n_);
    KDL::Jacobian jacobian(size());
    EXPECT_GE(jacobian_.JntToJac(q_, jacobian), 0);
    return jacobian.data;
  }

  Eigen::VectorXd torque(const JointVector& q, const JointVector& qd, const JointVector& qdd, const Wrench& F_M_R) {
    const KDL::Wrench on_axes_of_R(test::to_kdl(F_M_R.force), test::to_kdl(F_M_R.torque));
    wrenches_.back() = pose(q).M.Inverse() * on_axes_of_R;
    qd_.data = qd.head(n_);
    qdd_.data = qdd.head(n_);
    EXPECT_GE(torque_.CartToJnt(q_, qd_, qdd_, wrenches_, needed_), 0);
    return needed_.data;
  }

 private:
  unsigned size() const { return static_cast<unsigned>(n_); }

  KDL::Chain chain_;
  KDL::ChainFkSolverPos_recursive pose_;
  KDL::ChainJntToJacSolver jacobian_;
  KDL::ChainIdSolver_RNE torque_;
  KDL::Wrenches wrenches_;
  int n_;
  KDL::JntArray q_, qd_, qdd_, needed_;
};

void expect_as_kdl(const ArmModel& model, Oracle& oracle, Random& random) {
  const int n = model.joint_count;
  const JointVector q = test::random_positions(random, model);
  const JointVector qd = test::random_joints(random, model, 5.0);
  const JointVector qdd = test::random_joints(random, model, 20.0);
  const Wrench F_M_R = {random.in_cube(30.0), random.in_cube(3.0)};
  const ArmDynamics arm(model);
  ArmPosture posture;
  arm.set_posture(q, posture);

  const KDL::Frame H_RM = oracle.pose(q);
  const Pose tool = arm.tool_pose(posture);
  const Matrix3 R_RM = tool.rotation.toRotationMatrix();
  for (int i = 0; i < 3; ++i) {
    ASSERT_NEAR(tool.translation[i], H_RM.p(i), kTolerance);
    for (int j = 0; j < 3; ++j) ASSERT_NEAR(R_RM(i, j), H_RM.M(i, j), kTolerance);
  }

  const Eigen::MatrixXd jacobian = oracle.jacobian(q);
  for (int i = 0; i < n; ++i) {
    const Motion column = arm.tool_velocity(posture, JointVector::Unit(i));
    ASSERT_LT((column.translation - jacobian.col(i).head<3>()).norm(), kTolerance);
    ASSERT_LT((column.rotation - jacobian.col(i).tail<3>()).norm(), kTolerance);
  }

  const JointVector none = JointVector::Zero();
  const Eigen::VectorXd gravity = oracle.torque(q, none, none, {});
  ASSERT_LT((arm.bias_torque(posture, none).head(n) - gravity).cwiseAbs().maxCoeff(), kTolerance);
  const Eigen::VectorXd bias = oracle.torque(q, qd, none, {});
  ASSERT_LT((arm.bias_torque(posture, qd).head(n) - bias).cwiseAbs().maxCoeff(), kTolerance);
  for (int i = 0; i < n; ++i) {
    const Eigen::VectorXd column = oracle.torque(q, none, JointVector::Unit(i), {}) - gravity;
    ASSERT_LT((posture.mass.col(i).head(n) - column).cwiseAbs().maxCoeff(), kTolerance);
  }
  const JointVector applied = posture.mass * qdd + arm.bias_torque(posture, qd) - arm.tool_torque(posture, F_M_R);
  ASSERT_LT((applied.head(n) - oracle.torque(q, qd, qdd, F_M_R)).cwiseAbs().maxCoeff(), kTolerance);
  ASSERT_TRUE(posture.mass == posture.mass.transpose());
  ASSERT_TRUE(applied.tail(kMaxJoints - n).isZero(0.0));
}

void expect_as_kdl(const ArmModel& model, unsigned seed) {
  Random random(seed);
  Oracle oracle(model);
  for (int i = 0; i < 10000; ++i) {
    SCOPED_TRACE(i);
    expect_as_kdl(model, oracle, random);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(ArmDynamics, LightWeightRobotIsAsOrocosHasIt) { expect_as_kdl(test::lwr().model, 1); }
TEST(ArmDynamics, DesktopArmIsAsOrocosHasIt) { expect_as_kdl(test::desktop6().model, 2); }

TEST(ArmDynamics, AnyArmIsAsOrocosHasIt) {
  Random random(3);
  for (int i = 0; i < 2100; ++i) {
    SCOPED_TRACE(i);
    const ArmModel model = test::random_arm(random, 1 + i % kMaxJoints).model;
    Oracle oracle(model);
    for (int k = 0; k < 5; ++k) {
      expect_as_kdl(model, oracle, random);
      if (HasFatalFailure()) return;
    }
  }
}

/// A point mass on a rod, a joint that turns about -y of R: M = m l^2, g(q) = m g l cos q.
TEST(ArmDynamics, PendulumIsAsByHand) {
  ArmModel model;
  model.joint_count = 1;
  model.H_RA.rotation = exp_rotation(Vector3(0.5 * M_PI, 0.0, 0.0));
  model.joints[0].link = {2.0, Vector3(0.5, 0.0, 0.0), Matrix3::Zero()};
  model.joints[0].rotor = 0.1;
  model.joints[0].lower = -1.0;
  model.joints[0].upper = model.joints[0].velocity = model.joints[0].torque = 1.0;
  model.H_FM.translation = Vector3(0.7, 0.0, 0.0);
  ASSERT_EQ(validate(model), Status::kOk);
  const ArmDynamics arm(model);
  ArmPosture posture;
  JointVector q = JointVector::Zero();
  q[0] = 0.3;
  arm.set_posture(q, posture);
  EXPECT_NEAR(posture.mass(0, 0), 2.0 * 0.25 + 0.1, 1e-15);
  EXPECT_NEAR(arm.bias_torque(posture, JointVector::Unit(0))[0], 2.0 * 9.81 * 0.5 * std::cos(0.3), 1e-14);
  EXPECT_NEAR(arm.potential_energy(posture), 2.0 * 9.81 * 0.5 * std::sin(0.3), 1e-14);
  EXPECT_NEAR(arm.kinetic_energy(posture, JointVector::Unit(0)), 0.3, 1e-15);
  EXPECT_LT((arm.tool_pose(posture).translation - 0.7 * Vector3(std::cos(0.3), 0.0, std::sin(0.3))).norm(), 1e-15);
  // upwards, at a lever of 0.7 cos q
  EXPECT_NEAR(arm.tool_torque(posture, {Vector3::UnitZ(), Vector3::Zero()})[0], 0.7 * std::cos(0.3), 1e-15);
}

TEST(MovingJoints, SolveWhatIsNotHeld) {
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const int n = random.integer(1, kMaxJoints);
    const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return random.between(-1.0, 1.0); });
    JointMatrix mass = JointMatrix::Zero();
    mass.topLeftCorner(n, n) = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd kept = mass.topLeftCorner(n, n);
    JointVector b = JointVector::Zero();
    std::array<bool, kMaxJoints> held{};
    for (int k = 0; k < n; ++k) {
      b[k] = random.between(-1.0, 1.0);
      held.at(static_cast<std::size_t>(k)) = random.integer(0, 2) == 0;
    }
    Eigen::VectorXd right = b.head(n);
    for (int k = 0; k < n; ++k) {
      if (!held.at(static_cast<std::size_t>(k))) continue;
      kept.row(k) = Eigen::RowVectorXd::Unit(n, k);
      kept.col(k) = Eigen::VectorXd::Unit(n, k);
      right[k] = 0.0;
    }
    MovingJoints moving;
    moving.factor(mass, n, held);
    const JointVector x = moving.solve(b);
    ASSERT_LT((x.head(n) - kept.inverse() * right).norm(), 1e-10) << i;
    for (int k = 0; k < kMaxJoints; ++k) {
      if (k >= n || held.at(static_cast<std::size_t>(k))) {
        ASSERT_EQ(x[k], 0.0);
      }
    }
  }
}

}  // namespace
}  // namespace godobject::sim
