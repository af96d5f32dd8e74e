#include "sim/operator_hand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/plant.h"
#include "tests/sim/one_joint.h"
#include "tests/support/arms.h"

namespace godobject::sim {
namespace {

using test::Random;

HandParameters held(Grip grip) {
  HandParameters parameters;
  parameters.grip = grip;
  return parameters;
}

std::vector<Pose> random_walk(Random& random, std::size_t rows) {
  std::vector<Pose> script(rows);
  for (std::size_t i = 1; i < rows; ++i) {
    const Motion step = random.motion(0.3e-3, 2e-3);  // up to 0.3 m/s and 2 rad/s
    script[i].translation = script[i - 1].translation + step.translation;
    script[i].rotation = exp_rotation(step.rotation) * script[i - 1].rotation;
  }
  return script;
}

double distance(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm() + log_rotation(a.rotation * b.rotation.conjugate()).norm();
}

void run(Plant& plant, double seconds, const JointLoad& load = {}) {
  const std::int64_t end_ns = plant.now_ns() + std::llround(1e9 * seconds);
  while (plant.now_ns() < end_ns) plant.step(std::min(Plant::kStep_ns, end_ns - plant.now_ns()), load);
}

TEST(Target, PassesThroughTheRowsAndHoldsTheEnds) {
  Random random(1);
  const std::vector<Pose> script = random_walk(random, 50);
  const OperatorHand hand(held(Grip::kSpring), script, 2'000'000'000);
  for (std::size_t i = 0; i < script.size(); ++i) {
    EXPECT_LT(distance(hand.target(2.0 + 1e-3 * static_cast<double>(i)).pose, script[i]), 1e-12) << i;
  }
  for (const double time : {0.0, 1.9999, 2.05, 100.0}) {
    const BodyState target = hand.target(time);
    EXPECT_LT(distance(target.pose, time < 2.0 ? script.front() : script.back()), 1e-15);
    EXPECT_EQ(target.velocity.translation.norm() + target.velocity.rotation.norm(), 0.0);
  }
}

TEST(Target, VelocityIsTheSlopeOfThePoseAndContinuous) {
  constexpr double kStep = 1e-8;
  Random random(2);
  const std::vector<Pose> script = random_walk(random, 50);
  const OperatorHand hand(held(Grip::kSpring), script);
  for (int i = 0; i < 2000; ++i) {
    const double time = random.between(1e-5, 49e-3 - 1e-5);
    const Pose before = hand.target(time - kStep).pose;
    const Pose after = hand.target(time + kStep).pose;
    const BodyState target = hand.target(time);
    const Vector3 v = (after.translation - before.translation) / (2.0 * kStep);
    const Vector3 w = log_rotation(after.rotation * before.rotation.conjugate()) / (2.0 * kStep);
    // steps of 2 mrad: a rotation vector's rate differs from the angular velocity by their product
    ASSERT_LT((target.velocity.translation - v).norm(), 1e-5);
    ASSERT_LT((target.velocity.rotation - w).norm(), 5e-3);
  }
  for (int row = 1; row < 49; ++row) {
    const Motion left = hand.target(1e-3 * row - 1e-12).velocity;
    const Motion right = hand.target(1e-3 * row + 1e-12).velocity;
    ASSERT_LT((left.translation - right.translation).norm(), 1e-6);
    ASSERT_LT((left.rotation - right.rotation).norm(), 5e-3);
  }
}

TEST(HandSprings, WrenchesAreTheSlopeOfTheEnergyTheyStore) {
  constexpr double kStep = 1e-6;
  Random random(3);
  const std::vector<Pose> script(1);
  const OperatorHand hand(held(Grip::kSpring), script);
  const auto turned = [](const BodyState& body, int axis, double step) {
    BodyState moved = body;
    if (axis < 3) moved.pose.translation[axis] += step;
    if (axis >= 3) moved.pose.rotation = exp_rotation(step * Vector3::Unit(axis - 3)) * moved.pose.rotation;
    return moved;
  };
  for (int i = 0; i < 200; ++i) {
    BodyState bodies[3];
    for (BodyState& body : bodies) body.pose = set_matrix(random.motion(0.05, 1.0));
    const HandWrenches wrenches = hand.wrenches(bodies[0], bodies[1], bodies[2]);
    for (int axis = 0; axis < 6; ++axis) {
      const auto entry = [&](const Wrench& wrench) { return axis < 3 ? wrench.force[axis] : wrench.torque[axis - 3]; };
      const auto slope = [&](int body) {
        double energy[2];
        for (int side = 0; side < 2; ++side) {
          BodyState moved[3] = {bodies[0], bodies[1], bodies[2]};
          moved[body] = turned(bodies[body], axis, side == 0 ? -kStep : kStep);
          energy[side] = hand.energy(moved[0], moved[1], moved[2]);
        }
        return (energy[1] - energy[0]) / (2.0 * kStep);
      };
      ASSERT_NEAR(entry(wrenches.F_M_R), -slope(2), 1e-4);
      ASSERT_NEAR(entry(wrenches.F_H_R), slope(0), 1e-4) << "what pulls the hand pulls the target back";
      ASSERT_NEAR(entry(wrenches.F_H_R) - entry(wrenches.F_M_R), -slope(1), 1e-4);
    }
  }
}

TEST(Hand, CarriesAToolToItsTarget) {
  const test::Arm arm = test::lwr();
  JointVector q = JointVector::Zero();
  q.head<6>() << 0.2, 0.6, 0.3, 1.4, -0.4, 0.8;
  ArmModel model = arm.model;
  model.gravity_R.setZero();
  for (const Grip grip : {Grip::kSpring, Grip::kRigid}) {
    std::vector<Pose> script(1);
    script[0] = Plant(model, q).tool().pose;
    script[0].translation += Vector3(0.03, -0.02, 0.04);
    script[0].rotation = exp_rotation(Vector3(0.1, 0.2, -0.1)) * script[0].rotation;
    Plant plant(model, q, JointVector::Zero(), OperatorHand(held(grip), script));
    run(plant, 6.0);
    EXPECT_LT(distance(plant.tool().pose, script[0]), 1e-3);
    EXPECT_LT(distance(plant.hand().pose, script[0]), 1e-3);
  }
}

/// Its own arm carries the hand, so a tool that is held against gravity does not sink when it is grasped.
TEST(Hand, HasNoWeightOnTheArm) {
  const test::Arm arm = test::lwr();
  for (const Grip grip : {Grip::kSpring, Grip::kRigid}) {
    Plant plant(arm.model, JointVector::Constant(0.4), JointVector::Zero(), OperatorHand(held(grip)));
    const Plant alone(arm.model, JointVector::Constant(0.4));
    EXPECT_LT((plant.gravity_torque() - alone.gravity_torque()).norm(), 1e-12);
    const Pose start = plant.tool().pose;
    JointLoad load;
    load.motor = plant.gravity_torque();
    run(plant, 0.5, load);
    EXPECT_LT(distance(plant.tool().pose, start), 1e-9);
  }
}

/// A rotor of 1 kg m^2, the tool at 1 m, a hand of 0.5 kg and 0.001 kg m^2.
TEST(Hand, RigidGripAddsItsMass) {
  HandParameters parameters = held(Grip::kRigid);
  parameters.damping = 0.0;
  parameters.rotation_damping = 0.0;
  Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero(), JointVector::Zero(), OperatorHand(parameters));
  JointLoad load;
  load.motor[0] = 3.0;
  run(plant, 0.1, load);
  EXPECT_NEAR(plant.velocities()[0], 0.3 / 1.501, 1e-9);
  EXPECT_NEAR(plant.hand().velocity.translation.norm(), 0.3 / 1.501, 1e-9);
}

/// A rotor that turns at 1 rad/s and a hand that does not, until its springs take it along: neither their angular
/// momentum nor their energy changes.
TEST(Hand, ExchangesMomentumWithTheArm) {
  HandParameters springs = held(Grip::kSpring);
  springs.damping = 0.0;
  springs.rotation_damping = 0.0;
  springs.grip_damping = 0.0;
  springs.grip_rotation_damping = 0.0;
  Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero(), JointVector::Zero(), OperatorHand(springs));
  plant.set_velocity(JointVector::Unit(0));
  double most = 0.0;
  for (int i = 0; i < 1000; ++i) {
    run(plant, 1e-3);
    const BodyState& hand = plant.hand();
    const double of_hand = springs.mass * hand.pose.translation.cross(hand.velocity.translation).z() +
                           springs.inertia * hand.velocity.rotation.z();
    most = std::max(most, of_hand);
    ASSERT_NEAR(plant.velocities()[0] + of_hand, 1.0, 1e-6) << i;
    // a step of 0.1 ms at 224 rad/s: the square of their product, by 8, of the energy comes and goes
    ASSERT_NEAR(plant.arm_energy() + plant.hand_energy(), 0.5, 0.5 * 6.3e-5) << i;
  }
  EXPECT_GT(most, 0.5);
}

TEST(Hand, StiffGripIsNearlyRigid) {
  Random random(4);
  const test::Arm arm = test::lwr();
  const JointVector q = JointVector::Constant(0.4);
  std::vector<Pose> script(300);
  for (std::size_t i = 0; i < script.size(); ++i) {
    script[i] = Plant(arm.model, q).tool().pose;
    script[i].translation.x() += 0.05 * (1.0 - std::cos(2e-2 * static_cast<double>(i)));
  }
  HandParameters stiff = held(Grip::kSpring);
  stiff.grip_stiffness = 5e5;
  stiff.grip_damping = 500.0;
  stiff.grip_rotation_stiffness = 500.0;
  stiff.grip_rotation_damping = 0.5;
  Plant spring(arm.model, q, JointVector::Zero(), OperatorHand(stiff, script));
  Plant rigid(arm.model, q, JointVector::Zero(), OperatorHand(held(Grip::kRigid), script));
  const Pose start = rigid.tool().pose;
  for (int i = 0; i < 300; ++i) {
    JointLoad load;
    load.motor = rigid.gravity_torque();
    run(spring, 1e-3, load);
    run(rigid, 1e-3, load);
  }
  EXPECT_GT(distance(rigid.tool().pose, start), 0.02);
  EXPECT_LT((rigid.tool().pose.translation - spring.tool().pose.translation).norm(), 2e-4);
}

/// The energy of the arm changes by the work of motors, hand and friction, while the hand knocks, shakes and turns.
TEST(Hand, ItsWorkIsTheArmsEnergy) {
  Random random(5);
  for (const Grip grip : {Grip::kSpring, Grip::kRigid}) {
    const test::Arm arm = test::lwr();
    const JointVector q = JointVector::Constant(0.4);
    std::vector<Pose> script(1000);
    script[0] = Plant(arm.model, q).tool().pose;
    for (std::size_t i = 1; i < script.size(); ++i) {
      const auto t = 1e-3 * static_cast<double>(i);
      script[i] = script[0];
      script[i].translation += 0.03 * Vector3(std::sin(9.0 * t), std::sin(23.0 * t), std::sin(5.0 * t));
      script[i].rotation = exp_rotation(0.3 * std::sin(11.0 * t) * Vector3::UnitX()) * script[0].rotation;
      if (i > 500 && i < 550) script[i].translation.z() -= 0.02;  // a knock, from one row to the next
    }
    Plant plant(arm.model, q, JointVector::Zero(), OperatorHand(held(grip), script));
    const double before = plant.arm_energy();
    for (int i = 0; i < 1000; ++i) {
      JointLoad load;
      load.motor = plant.gravity_torque();
      run(plant, 1e-3, load);
    }
    const PlantWork& work = plant.work();
    EXPECT_NEAR(plant.arm_energy() - before, work.motor.sum() + work.hand.sum() + work.friction,
                1e-6 * std::fabs(work.friction));
    EXPECT_GT(work.hand.cwiseAbs().minCoeff(), 0.0);
    EXPECT_GT(work.hand.sum(), 0.1);
    if (grip == Grip::kRigid) {
      EXPECT_NEAR(work.operator_arm, work.hand.sum(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace godobject::sim
