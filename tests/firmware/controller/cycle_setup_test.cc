#include "firmware/controller/cycle_setup.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/device/velocity_estimator.h"
#include "tests/support/arms.h"
#include "tests/support/small_scenes.h"

namespace godobject::firmware::cycle_setup_test {
namespace {

class CycleSetupTest : public testing::Test {
 protected:
  CycleSetupTest() : image_(test::ball_over_plate()), scene_(test::open_scene(image_)) {
    const test::Arm arm = test::lwr();
    placement_.device.model = arm.model;
    placement_.device.torque = arm.parameters;
  }
  CycleSetup setup() { return cycle_setup(config_, scene_, placement_, memory_); }

  test::SceneImage image_;
  SceneView scene_;
  ControllerConfig config_;
  Placement placement_;
  std::array<std::byte, 16> memory_{};
};

TEST_F(CycleSetupTest, HasEachNumberOfTheFileInItsPlace) {
  config_.loop.velocity_window = 7;
  config_.passivity.damping = 12.0;
  placement_.device.torque.rotation_length = 0.33;
  config_.limits = {11.0, 1.2, 0.3, 0.4, 5.0, 6.0, 0.5, 0.7, 0.011, 0.04};
  config_.engage = {0.6, 0.25};
  config_.start = {3.5, false, 0.07, 0.003};
  placement_.mapping.scale = 2.5;
  const CycleSetup made = setup();
  EXPECT_EQ(made.scene, &scene_);
  EXPECT_EQ(made.arm, &placement_.device.model);
  EXPECT_EQ(made.joint_torque, &placement_.device.torque);
  EXPECT_EQ(made.memory.data(), memory_.data());
  EXPECT_EQ(made.memory.size(), memory_.size());
  EXPECT_EQ(made.mapping.scale, 2.5);
  EXPECT_EQ(made.velocity_window, 7);
  EXPECT_EQ(made.passivity.most_damping, 12.0);
  EXPECT_EQ(made.passivity.period, 1e-3);
  EXPECT_EQ(made.passivity.rotation_length, 0.33);
  EXPECT_EQ(made.hand.force, 11.0);
  EXPECT_EQ(made.hand.torque, 1.2);
  EXPECT_EQ(made.hand.speed, 0.3);
  EXPECT_EQ(made.hand.speed_stop, 0.4);
  EXPECT_EQ(made.hand.turn, 5.0);
  EXPECT_EQ(made.hand.turn_stop, 6.0);
  EXPECT_EQ(made.torque.joint_speed, 0.5);
  EXPECT_EQ(made.torque.joint_speed_stop, 0.7);
  EXPECT_EQ(made.stuck_torque, 0.011);
  EXPECT_EQ(made.torque.rate, 0.04);
  EXPECT_EQ(made.supervisor.engage_force, 0.6);
  EXPECT_EQ(made.supervisor.engage_cycles, 250u);
  EXPECT_EQ(made.supervisor.boot_cycles, 3500u);
  EXPECT_FALSE(made.supervisor.sign_test);
  EXPECT_EQ(made.supervisor.sign.push, 0.07);
  EXPECT_EQ(made.supervisor.sign.motion, 0.003);
}

/// From zero, at the rate limit, the largest torque is reached before power is asked for.
TEST_F(CycleSetupTest, PreparesForLongEnoughToReachAnyTorque) {
  for (const double rate : {0.05, 0.03, 0.01, 0.001}) {
    config_.limits.torque_rate = rate;
    const std::uint32_t cycles = setup().supervisor.prepare_cycles;
    EXPECT_GE(cycles * rate, 1.0) << rate;
    EXPECT_LE((cycles - 6.0) * rate, 1.0) << "no longer than it must, and some cycles";
    EXPECT_GE((cycles - 5.0 + 1.0) * rate, 1.0);
  }
}

/// All that is a time stays one: at 4 kHz four times as many cycles. Torques change as fast as at 1 kHz.
TEST_F(CycleSetupTest, FollowsThePeriodOfTheDevice) {
  for (const auto& [period, a_millisecond] : {std::pair{0.125e-3, 8.0}, {0.25e-3, 4.0}, {2e-3, 0.5}, {10e-3, 0.1}}) {
    config_.device.bus.period = period;
    config_.limits.torque_rate = 0.04;
    config_.engage.ramp = 0.3;
    config_.start.wait = 5.0;
    const CycleSetup made = setup();
    EXPECT_EQ(made.period, period);
    EXPECT_EQ(made.passivity.period, period);
    EXPECT_EQ(made.supervisor.period, period);
    EXPECT_EQ(made.supervisor.boot_cycles, static_cast<std::uint32_t>(std::lround(5000 * a_millisecond)));
    EXPECT_EQ(made.supervisor.engage_cycles, static_cast<std::uint32_t>(std::lround(300 * a_millisecond)));
    EXPECT_NEAR(made.torque.rate, 0.04 / a_millisecond, 1e-12);
    EXPECT_GE(made.supervisor.prepare_cycles * made.torque.rate, 1.0);
  }
  config_.device.bus.period = 10e-3;
  config_.limits.torque_rate = 0.05;
  EXPECT_EQ(setup().torque.rate, 0.5);
}

TEST_F(CycleSetupTest, RoundsTimesToCycles) {
  for (const auto& [seconds, cycles] :
       std::initializer_list<std::pair<double, std::uint32_t>>{{0.02, 20}, {0.0204, 20}, {0.0206, 21}, {10.0, 10000}}) {
    config_.engage.ramp = seconds;
    EXPECT_EQ(setup().supervisor.engage_cycles, cycles) << seconds;
  }
}

TEST_F(CycleSetupTest, TakesSolverAndFrictionOfTheSceneUnlessTheFileNamesThem) {
  for (const bool friction : {false, true}) {
    scene_.settings.friction = friction ? 1 : 0;
    EXPECT_EQ(setup().friction, friction);
    for (const bool asked : {false, true}) {
      config_.scene.friction = asked;
      EXPECT_EQ(setup().friction, asked);
    }
    config_.scene.friction.reset();
  }
  EXPECT_EQ(setup().solver, scene_.default_solver());
  for (const Solver solver : {Solver::kContact, Solver::kCorrected, Solver::kPaper}) {
    config_.scene.solver = solver;
    EXPECT_EQ(setup().solver, solver);
  }
}

/// The defaults of the structures are those of the controller file: a cycle that a test makes is a cycle as users run
/// it.
TEST_F(CycleSetupTest, AgreesWithTheDefaultsOfTheCycle) {
  const CycleSetup made = setup();
  const CycleSetup bare;
  EXPECT_EQ(made.velocity_window, bare.velocity_window);
  EXPECT_EQ(made.stuck_torque, bare.stuck_torque);
  EXPECT_EQ(made.hand.force, bare.hand.force);
  EXPECT_EQ(made.hand.torque, bare.hand.torque);
  EXPECT_EQ(made.hand.speed, bare.hand.speed);
  EXPECT_EQ(made.hand.speed_stop, bare.hand.speed_stop);
  EXPECT_EQ(made.hand.turn, bare.hand.turn);
  EXPECT_EQ(made.hand.turn_stop, bare.hand.turn_stop);
  EXPECT_EQ(made.torque.rate, bare.torque.rate);
  EXPECT_EQ(made.torque.joint_speed, bare.torque.joint_speed);
  EXPECT_EQ(made.torque.joint_speed_stop, bare.torque.joint_speed_stop);
  EXPECT_EQ(made.supervisor.boot_cycles, bare.supervisor.boot_cycles);
  EXPECT_EQ(made.supervisor.prepare_cycles, bare.supervisor.prepare_cycles);
  EXPECT_EQ(made.supervisor.engage_cycles, bare.supervisor.engage_cycles);
  EXPECT_EQ(made.supervisor.engage_force, bare.supervisor.engage_force);
  EXPECT_EQ(made.supervisor.sign_test, bare.supervisor.sign_test);
  EXPECT_EQ(made.supervisor.sign.push, bare.supervisor.sign.push);
  EXPECT_EQ(made.supervisor.sign.motion, bare.supervisor.sign.motion);
  EXPECT_FALSE(bare.friction);
  // those that the file documents
  EXPECT_EQ(made.velocity_window, 4);
  EXPECT_EQ(made.hand.force, 30.0);
  EXPECT_EQ(made.hand.torque, 3.0);
  EXPECT_EQ(made.hand.speed, 1.0);
  EXPECT_EQ(made.hand.turn, 6.0);
  EXPECT_EQ(made.supervisor.boot_cycles, 5000u);
  EXPECT_EQ(made.supervisor.prepare_cycles, 25u);
  EXPECT_EQ(made.supervisor.engage_cycles, 500u);
}

}  // namespace
}  // namespace godobject::firmware::cycle_setup_test
