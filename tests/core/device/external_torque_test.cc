#include "core/device/external_torque.h"

#include <gtest/gtest.h>

#include <limits>

#include "sim/plant.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/arms.h"

namespace godobject {
namespace {

using test::Arm;
using test::Random;

double kinetic_energy(const ArmModel& model, const JointVector& q, const JointVector& qd) {
  return 0.5 * qd.dot(mass_matrix(model, forward_kinematics(model, q)) * qd);
}

/// Compares with the mass matrix, which other code computes, and its change with differences of the kinetic energy.
TEST(ArmMomentum, IsMassTimesVelocityAndChangesWithTheKineticEnergy) {
  constexpr double kStep = 1e-5;
  Random random(7101);
  for (int trial = 0; trial < 200; ++trial) {
    const Arm arm = test::random_arm(random, 1 + trial % kMaxJoints);
    const JointVector q = test::random_positions(random, arm.model);
    const JointVector qd = test::random_joints(random, arm.model, 2.0);
    const ArmKinematics kinematics = forward_kinematics(arm.model, q);
    const ArmMomentum momentum = arm_momentum(arm.model, kinematics, qd);
    const JointVector expected = mass_matrix(arm.model, kinematics) * qd;
    EXPECT_LT((momentum.momentum - expected).norm(), 1e-11 * (1.0 + expected.norm()));
    const double size = 1.0 + kinetic_energy(arm.model, q, qd);
    for (int i = 0; i < kMaxJoints; ++i) {
      JointVector step = JointVector::Zero();
      if (i < arm.model.joint_count) step[i] = kStep;
      const double slope =
          (kinetic_energy(arm.model, q + step, qd) - kinetic_energy(arm.model, q - step, qd)) / (2.0 * kStep);
      EXPECT_NEAR(momentum.change[i], slope, 1e-7 * size) << "joint " << i << ", trial " << trial;
    }
  }
}

/// A simulated arm whose motors carry the model's gravity, watched by an observer that knows the model only.
class Watched {
 public:
  Watched(const ArmModel& real, const ArmModel& model, const JointVector& q) : model_(model), plant_(real, q) {}

  void run(int cycles, const Wrench& F_M_R) {
    plant_.set_tool_load(F_M_R);
    for (int i = 0; i < cycles; ++i) {
      const JointVector torque = gravity_torque(model_, forward_kinematics(model_, plant_.positions()));
      for (int k = 0; k < 10; ++k) plant_.step(sim::Plant::kStep_ns, {torque, JointVector::Zero()});
      kinematics_ = forward_kinematics(model_, plant_.positions());
      observer_.update(model_, kinematics_, plant_.velocities(), torque);
    }
  }

  const JointVector& estimate() const { return observer_.torque(); }
  JointVector torque_of(const Wrench& F_M_R) const {
    Eigen::Matrix<double, 6, 1> wrench;
    wrench << F_M_R.force, F_M_R.torque;
    return geometric_jacobian(kinematics_, kinematics_.H_RM.translation).transpose() * wrench;
  }
  const ArmKinematics& kinematics() const { return kinematics_; }

 private:
  const ArmModel model_;
  sim::Plant plant_;
  ArmKinematics kinematics_;
  ExternalTorqueObserver observer_{50.0, 1e-3};
};

const JointVector kPosture = (JointVector() << 0.2, -0.5, 0.3, 1.4, 0.0, -1.2, 0.0).finished();

TEST(ExternalTorqueObserver, FindsTheWrenchOnTheToolOfAMovingArm) {
  Random random(7102);
  for (int trial = 0; trial < 10; ++trial) {
    const Arm arm = test::lwr();
    Watched watched(arm.model, arm.model, kPosture);
    const Wrench F_M_R{random.in_cube(5.0), random.in_cube(0.3)};
    watched.run(250, F_M_R);
    const JointVector expected = watched.torque_of(F_M_R);
    EXPECT_LT((watched.estimate() - expected).norm(), 0.1 * expected.norm() + 0.02);
  }
}

TEST(ExternalTorqueObserver, SeesNothingOnAnArmThatIsAsModelled) {
  const Arm arm = test::lwr();
  Watched watched(arm.model, arm.model, kPosture);
  watched.run(100, {Vector3(8.0, 0.0, 3.0), Vector3::Zero()});
  watched.run(200, {});  // it coasts, faster than a hand would
  EXPECT_LT(watched.estimate().cwiseAbs().maxCoeff(), 0.05);
}

TEST(ExternalTorqueObserver, FindsALoadThatTheModelDoesNotHave) {
  const Arm arm = test::lwr();
  ArmModel heavier = arm.model;
  heavier.payload.mass += 0.2;
  Watched watched(heavier, arm.model, kPosture);
  watched.run(150, {});
  const JointVector more =
      gravity_torque(arm.model, watched.kinematics()) - gravity_torque(heavier, watched.kinematics());
  EXPECT_LT((watched.estimate() - more).norm(), 0.1 * more.norm());
  EXPECT_GT(more.norm(), 0.5);
}

TEST(ExternalTorqueObserver, StartsAgainAfterNumbersThatAreNotFinite) {
  const Arm arm = test::lwr();
  const ArmKinematics kinematics = forward_kinematics(arm.model, kPosture);
  ExternalTorqueObserver observer(50.0, 1e-3);
  const JointVector holding = gravity_torque(arm.model, kinematics);
  const JointVector none = JointVector::Zero();
  const JointVector nan = JointVector::Constant(std::numeric_limits<double>::quiet_NaN());
  const test::AllocationGuard guard;
  for (const JointVector& bad : {nan, JointVector(-nan)}) {
    for (int i = 0; i < 50; ++i) observer.update(arm.model, kinematics, none, holding + JointVector::Ones());
    EXPECT_NEAR(observer.torque()[0], -1.0, 0.2);  // it stands still in spite of 1 Nm
    observer.update(arm.model, kinematics, bad, holding);
    EXPECT_TRUE(observer.torque().isZero());
    observer.update(arm.model, kinematics, none, bad);
    EXPECT_TRUE(observer.torque().isZero());
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace
}  // namespace godobject
