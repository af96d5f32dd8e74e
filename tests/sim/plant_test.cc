#include "sim/plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/sim/one_joint.h"
#include "tests/support/arms.h"

namespace godobject::sim {
namespace {

using test::Arm;
using test::Random;

constexpr double kPlantStep = 1e-9 * Plant::kStep_ns;

ArmModel without_damping(ArmModel model) {
  for (ArmJoint& joint : model.joints) joint.damping = 0.0;
  return model;
}

void let_run(Plant& plant, double seconds, const JointLoad& load) {
  const std::int64_t end_ns = plant.now_ns() + std::llround(1e9 * seconds);
  while (plant.now_ns() < end_ns) plant.step(std::min(Plant::kStep_ns, end_ns - plant.now_ns()), load);
}

/// Nothing holds the arm: it falls, swings and whirls.
void expect_energy_kept(const ArmModel& model, unsigned seed) {
  Random random(seed);
  for (int trial = 0; trial < 3; ++trial) {
    Plant plant(without_damping(model), test::random_positions(random, model));
    plant.set_velocity(test::random_joints(random, model, 1.0));
    const double before = plant.arm_energy();
    double kinetic = 0.0;
    for (int i = 0; i < 1000; ++i) {
      let_run(plant, 0.01, {});
      kinetic = std::max(kinetic, plant.arm().kinetic_energy(plant.posture(), plant.velocities()));
    }
    EXPECT_LT(std::fabs(plant.arm_energy() - before), 1e-4 * kinetic) << trial;
  }
}

TEST(Plant, FreeLightWeightRobotKeepsItsEnergy) { expect_energy_kept(test::lwr().model, 1); }
TEST(Plant, FreeDesktopArmKeepsItsEnergy) { expect_energy_kept(test::desktop6().model, 2); }

/// All that takes and gives energy at once: motors, a load, a hand, friction that sticks and slips, brakes.
void expect_balance(Grip grip, const ArmModel& model, double torque, unsigned seed) {
  Random random(seed);
  for (int trial = 0; trial < 10; ++trial) {
    HandParameters hand;
    hand.grip = grip;
    hand.grip_damping = 0.0;
    hand.grip_rotation_damping = 0.0;
    JointVector friction = JointVector::Zero();
    for (int i = 0; i < model.joint_count; ++i) friction[i] = random.between(0.0, torque);
    Plant plant(model, 0.5 * test::random_positions(random, model), friction, OperatorHand(hand));
    const double arm_before = plant.arm_energy();
    const double hand_before = plant.hand_energy();
    double turnover = 0.0;
    for (int i = 0; i < 100; ++i) {
      JointLoad load;
      load.motor = plant.gravity_torque() + test::random_joints(random, model, 5.0 * torque);
      if (i % 10 == 9) load.brake = JointVector::Constant(2.0 * torque);
      plant.set_tool_load({random.in_cube(10.0 * torque), random.in_cube(0.1 * torque)});
      const double work_before = plant.work().motor.sum();
      let_run(plant, 0.01, load);
      turnover += std::fabs(plant.work().motor.sum() - work_before);
    }
    const PlantWork& work = plant.work();
    const double on_arm = work.motor.sum() + work.hand.sum() + work.load + work.friction;
    // each time that a joint comes to rest or breaks away costs a term of the first order of a step
    EXPECT_NEAR(plant.arm_energy() - arm_before, on_arm, 3e-5 * turnover) << trial;
    if (grip == Grip::kSpring) {
      // and what swings in the grip its frequency times the step, squared, by 8
      EXPECT_NEAR(plant.hand_energy() - hand_before, work.operator_arm - work.hand.sum(), 3e-4 * turnover) << trial;
    }
    EXPECT_LT(work.friction, 0.0);
    if (grip == Grip::kSpring) {
      EXPECT_LE(work.operator_arm, 0.0) << "a passive hand gives no energy";
    }
  }
}

TEST(Plant, WorkIsEnergyWithoutHand) { expect_balance(Grip::kNone, test::lwr().model, 1.0, 3); }
TEST(Plant, WorkIsEnergyWithRigidHand) { expect_balance(Grip::kRigid, test::lwr().model, 1.0, 4); }
TEST(Plant, WorkIsEnergyWithHandOnSpring) { expect_balance(Grip::kSpring, test::lwr().model, 1.0, 5); }
TEST(Plant, WorkIsEnergyOfTheDesktopArm) { expect_balance(Grip::kSpring, test::desktop6().model, 0.02, 6); }

/// v0 = 1 rad/s, friction 2 Nm: rest after 0.5 s and 0.25 rad, then not a bit of motion.
TEST(DryFriction, BringsAJointToRestAndKeepsItThere) {
  Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero(), 2.0 * JointVector::Unit(0));
  plant.set_velocity(JointVector::Unit(0));
  let_run(plant, 0.4, {});
  EXPECT_NEAR(plant.velocities()[0], 0.2, 1e-9);
  EXPECT_NEAR(plant.positions()[0], 0.4 - 0.16, 1e-9);
  let_run(plant, 0.11, {});
  EXPECT_EQ(plant.velocities()[0], 0.0);
  EXPECT_NEAR(plant.positions()[0], 0.25, kPlantStep * kPlantStep);
  const JointVector rest = plant.positions();
  JointLoad load;
  for (const double torque : {1.99, -1.99, 0.0, 1.0}) {
    load.motor[0] = torque;
    let_run(plant, 0.1, load);
    EXPECT_TRUE(plant.positions() == rest) << torque;
  }
  EXPECT_NEAR(plant.work().friction, -0.5, 1e-9);
  load.motor[0] = 2.5;
  let_run(plant, 0.1, load);
  EXPECT_NEAR(plant.velocities()[0], 0.05, 1e-9);
  EXPECT_NEAR(plant.positions()[0] - rest[0], 0.0025, 1e-9);
}

TEST(DryFriction, DoesNotChatterAtTurningPoints) {
  // a slow torque back and forth, twice the friction: the joint stops twice a period, and its motion never trembles
  Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero(), 1.0 * JointVector::Unit(0));
  JointLoad load;
  int reversals = 0;
  double before = 0.0;
  for (int i = 0; i < 40000; ++i) {
    load.motor[0] = 2.0 * std::sin(2.0 * M_PI * 1e-4 * i);
    plant.step(Plant::kStep_ns, load);
    const double now = plant.velocities()[0];
    if (now * before < 0.0 || (before == 0.0 && now != 0.0)) ++reversals;
    before = now;
  }
  EXPECT_LE(reversals, 9);
  EXPECT_GE(reversals, 7);
}

/// Of two coupled joints only one is held: the reaction of the other's motion must not free it, nor be lost.
TEST(DryFriction, HoldsOneJointOfAnArmThatMoves) {
  const ArmModel model = without_damping(test::lwr().model);
  JointVector q = JointVector::Zero();
  q[1] = 0.5;
  q[3] = 1.0;
  JointVector friction = JointVector::Zero();
  friction[1] = 300.0;
  Plant held(model, q, friction);
  let_run(held, 0.5, {});
  EXPECT_EQ(held.positions()[1], 0.5);
  EXPECT_GT(std::fabs(held.positions()[3] - 1.0), 0.1);
  EXPECT_EQ(held.work().friction, 0.0);

  // by an independent way: a rotor so heavy that it does not move
  ArmModel heavy = model;
  heavy.joints[1].rotor = 1e9;
  Plant slow(heavy, q);
  let_run(slow, 0.5, {});
  EXPECT_LT((slow.positions() - held.positions()).norm(), 1e-5);
}

/// Brakes that close on a fast arm: every joint comes to rest once, and no later kicks.
TEST(DryFriction, BrakesStopAnArmForGood) {
  Random random(7);
  for (const Arm& arm : {test::lwr(), test::desktop6()}) {
    JointLoad load;
    for (int i = 0; i < arm.model.joint_count; ++i) {
      load.brake[i] = arm.model.joints.at(static_cast<std::size_t>(i)).torque;
    }
    for (int trial = 0; trial < 10; ++trial) {
      Plant plant(arm.model, 0.8 * test::random_positions(random, arm.model));
      plant.set_velocity(test::random_joints(random, arm.model, 2.0));
      double energy = plant.arm_energy();
      let_run(plant, 1.0, load);
      const JointVector rest = plant.positions();
      ASSERT_TRUE(plant.velocities().isZero(0.0));
      EXPECT_NEAR(plant.arm_energy() - energy, plant.work().friction, 1e-3 * std::fabs(plant.work().friction));
      let_run(plant, 1.0, load);
      EXPECT_TRUE(plant.positions() == rest);
    }
  }
}

}  // namespace
}  // namespace godobject::sim
