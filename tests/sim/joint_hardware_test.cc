#include "sim/joint_hardware.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/arms.h"

namespace godobject::sim {
namespace {

using hal::DriveState;
using hal::PowerRequest;

constexpr std::int64_t kMs = 1'000'000;

JointHardwareParameters parameters() {
  JointHardwareParameters joint;
  joint.torque_limit = 10.0;
  joint.brake_torque = 20.0;
  joint.quick_stop_damping = 2.0;
  joint.quick_stop_stiffness = 50.0;
  return joint;
}

/// A joint that stands where it is told, in steps of a tenth of a millisecond, with a command each millisecond.
struct JointBench {
  JointHardware joint{parameters()};
  std::int64_t now_ns = 0;
  double position = 0.0;
  double velocity = 0.0;

  void run(double ms, PowerRequest power, double torque) {
    const auto end_ns = now_ns + static_cast<std::int64_t>(ms * kMs);
    for (; now_ns < end_ns; now_ns += kMs / 10) {
      if (now_ns % kMs == 0) joint.command(power, torque, now_ns);
      joint.update(now_ns, position, velocity);
    }
  }
  void silence(double ms) {
    const auto end_ns = now_ns + static_cast<std::int64_t>(ms * kMs);
    for (; now_ns < end_ns; now_ns += kMs / 10) joint.update(now_ns, position, velocity);
  }
  void enable() {
    run(40.0, PowerRequest::kEnable, 3.0);
    ASSERT_EQ(joint.state(), DriveState::kEnabled);
    ASSERT_EQ(joint.motor_torque(), 3.0);
    ASSERT_EQ(joint.brake_torque(), 0.0);
  }
};

TEST(JointHardware, BeginsOffWithItsBrakeClosed) {
  JointBench bench;
  for (const PowerRequest power : {PowerRequest::kOff, PowerRequest::kQuickStop, PowerRequest::kReset}) {
    bench.run(50.0, power, 5.0);
    EXPECT_EQ(bench.joint.state(), DriveState::kOff);
    EXPECT_EQ(bench.joint.motor_torque(), 0.0);
    EXPECT_EQ(bench.joint.brake_torque(), 20.0);
  }
}

TEST(JointHardware, EnablesInOrder) {
  JointBench bench;
  bench.run(27.9, PowerRequest::kEnable, 3.0);
  EXPECT_EQ(bench.joint.state(), DriveState::kOff);
  EXPECT_EQ(bench.joint.motor_torque(), 0.0);
  EXPECT_EQ(bench.joint.brake_torque(), 20.0) << "no torque, so the brake holds";
  bench.run(0.3, PowerRequest::kEnable, 3.0);
  EXPECT_EQ(bench.joint.state(), DriveState::kEnabled);
  EXPECT_EQ(bench.joint.motor_torque(), 3.0);
  EXPECT_EQ(bench.joint.brake_torque(), 0.0);
}

TEST(JointHardware, GivesUpEnablingWhenAskedTo) {
  for (const PowerRequest power : {PowerRequest::kOff, PowerRequest::kQuickStop}) {
    for (const double ms : {1.0, 10.0, 27.0}) {
      JointBench bench;
      bench.run(ms, PowerRequest::kEnable, 3.0);
      bench.run(100.0, power, 3.0);
      EXPECT_EQ(bench.joint.state(), DriveState::kOff);
      EXPECT_EQ(bench.joint.motor_torque(), 0.0);
      EXPECT_EQ(bench.joint.brake_torque(), 20.0);
    }
  }
}

TEST(JointHardware, OffIsLimpUntilTheBrakeHolds) {
  JointBench bench;
  bench.enable();
  bench.run(1.0, PowerRequest::kOff, 3.0);
  EXPECT_EQ(bench.joint.state(), DriveState::kOff);
  EXPECT_EQ(bench.joint.motor_torque(), 0.0);
  bench.run(19.0, PowerRequest::kOff, 3.0);
  EXPECT_EQ(bench.joint.brake_torque(), 0.0);
  bench.run(0.2, PowerRequest::kOff, 3.0);
  EXPECT_EQ(bench.joint.brake_torque(), 20.0);
}

TEST(JointHardware, QuickStopSlowsDownThenBrakesThenGoesOff) {
  JointBench bench;
  bench.enable();
  bench.position = 0.5;
  bench.velocity = 1.0;
  bench.run(1.0, PowerRequest::kQuickStop, -9.0);
  EXPECT_EQ(bench.joint.state(), DriveState::kQuickStop);
  EXPECT_NEAR(bench.joint.motor_torque(), 3.0 - 2.0, 1e-12) << "from the torque that acted, against the motion";
  bench.position = 0.52;
  bench.run(1.0, PowerRequest::kQuickStop, -9.0);
  EXPECT_NEAR(bench.joint.motor_torque(), 3.0 - 2.0 - 50.0 * 0.02, 1e-12);
  bench.run(50.0, PowerRequest::kQuickStop, -9.0);
  EXPECT_EQ(bench.joint.brake_torque(), 0.0) << "it still moves";
  bench.velocity = 0.0;
  bench.run(19.9, PowerRequest::kEnable, -9.0);
  EXPECT_EQ(bench.joint.state(), DriveState::kQuickStop) << "enable does not end a stop";
  EXPECT_NE(bench.joint.motor_torque(), 0.0) << "held until the brake holds";
  bench.run(0.3, PowerRequest::kQuickStop, -9.0);
  EXPECT_EQ(bench.joint.state(), DriveState::kOff);
  EXPECT_EQ(bench.joint.motor_torque(), 0.0);
  EXPECT_EQ(bench.joint.brake_torque(), 20.0);
}

TEST(JointHardware, QuickStopEndsEvenIfTheJointDoesNot) {
  JointBench bench;
  bench.enable();
  bench.velocity = 1.0;
  bench.run(499.0, PowerRequest::kQuickStop, 0.0);
  EXPECT_EQ(bench.joint.brake_torque(), 0.0);
  bench.run(22.0, PowerRequest::kQuickStop, 0.0);
  EXPECT_EQ(bench.joint.brake_torque(), 20.0);
  EXPECT_EQ(bench.joint.state(), DriveState::kOff);
}

TEST(JointHardware, TripsWhenItsQuickStopRunsAway) {
  JointBench bench;
  bench.enable();
  bench.velocity = -1.0;
  bench.run(1.0, PowerRequest::kQuickStop, 0.0);
  bench.velocity = -1.4;
  bench.run(1.0, PowerRequest::kQuickStop, 0.0);
  EXPECT_EQ(bench.joint.state(), DriveState::kQuickStop);
  bench.velocity = -1.6;
  bench.run(1.0, PowerRequest::kQuickStop, 0.0);
  EXPECT_EQ(bench.joint.state(), DriveState::kFault);
  EXPECT_EQ(bench.joint.motor_torque(), 0.0);
}

TEST(JointHardware, TripsWhenNoCommandComes) {
  JointBench bench;
  bench.enable();
  bench.silence(3.0);  // the last command is 1 ms old already
  EXPECT_EQ(bench.joint.state(), DriveState::kEnabled);
  bench.silence(0.2);
  EXPECT_EQ(bench.joint.state(), DriveState::kFault);
  EXPECT_EQ(bench.joint.motor_torque(), 0.0);
  for (const PowerRequest power : {PowerRequest::kEnable, PowerRequest::kOff, PowerRequest::kQuickStop}) {
    bench.run(40.0, power, 3.0);
    EXPECT_EQ(bench.joint.state(), DriveState::kFault) << "left by a reset only";
    EXPECT_EQ(bench.joint.brake_torque(), 20.0);
  }
  bench.run(1.0, PowerRequest::kReset, 3.0);
  EXPECT_EQ(bench.joint.state(), DriveState::kOff);
  bench.enable();
}

TEST(JointHardware, SilenceDoesNotTripADriveThatIsOff) {
  JointBench bench;
  bench.run(5.0, PowerRequest::kOff, 0.0);
  bench.silence(100.0);
  EXPECT_EQ(bench.joint.state(), DriveState::kOff);
}

TEST(JointHardware, WithoutSupplyNothingWorks) {
  JointBench bench;
  bench.enable();
  bench.joint.set_supply(false, bench.now_ns);
  EXPECT_EQ(bench.joint.motor_torque(), 0.0);
  bench.joint.trip(bench.now_ns);
  bench.joint.disable(bench.now_ns);
  bench.run(40.0, PowerRequest::kReset, 3.0);
  bench.run(40.0, PowerRequest::kEnable, 3.0);
  EXPECT_EQ(bench.joint.state(), DriveState::kUnavailable);
  EXPECT_EQ(bench.joint.brake_torque(), 20.0);
  bench.joint.set_supply(true, bench.now_ns);
  EXPECT_EQ(bench.joint.state(), DriveState::kOff);
  bench.enable();
}

TEST(JointHardware, CounterCountsAndWraps) {
  JointHardwareParameters counted = parameters();
  counted.encoder_step = 0.5;
  counted.counter_at_zero = std::numeric_limits<std::int32_t>::max() - 1;
  const JointHardware joint(counted);
  EXPECT_EQ(joint.counter(0.0), std::numeric_limits<std::int32_t>::max() - 1);
  EXPECT_EQ(joint.counter(0.99), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(joint.counter(1.0), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(joint.counter(-0.01), std::numeric_limits<std::int32_t>::max() - 2);
}

TEST(UsualHardware, CanHoldItsArm) {
  for (const test::Arm& arm : {test::lwr(), test::desktop6()}) {
    const auto hardware = usual_hardware(arm.model);
    for (int i = 0; i < arm.model.joint_count; ++i) {
      const JointHardwareParameters& joint = hardware.at(static_cast<std::size_t>(i));
      const ArmJoint& model = arm.model.joints.at(static_cast<std::size_t>(i));
      EXPECT_EQ(joint.torque_limit, model.torque);
      EXPECT_EQ(joint.brake_torque, model.torque);
      EXPECT_NEAR(joint.torque_step, model.torque / 1000.0, 1e-15);
      EXPECT_GT(joint.quick_stop_damping, 0.0);
      EXPECT_GT(joint.encoder_step, 0.0);
    }
  }
}

}  // namespace
}  // namespace godobject::sim
