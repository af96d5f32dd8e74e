// The controller's CAN drives against the simulated ones, each written from the standard for itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include "core/device/dynamics.h"
#include "core/device/kinematics.h"
#include "core/device/stability.h"
#include "hal/cia402/bus_plan.h"
#include "hal/cia402/can_drives.h"
#include "sim/can_device.h"
#include "tests/sim/one_joint.h"
#include "tests/sim/small_master.h"
#include "tests/support/arms.h"
#include "tests/support/random.h"

namespace godobject::sim {
namespace {

/// The controller's end of everything, over a simulated device.
struct Loop {
  hal::BusLayout layout;
  std::array<JointHardwareParameters, kMaxJoints> hardware;
  Plant& plant;
  std::unique_ptr<CanDevice> device;
  std::array<hal::CanBus*, hal::kMaxBuses> wires{};
  std::unique_ptr<VirtualClock> clock;
  hal::BusPlan plan;
  std::optional<hal::CanDrives> drives;
  hal::JointReading reading;

  Loop(const ArmModel& arm, const hal::BusLayout& on, Plant& body, const CanScript& script = {})
      : layout(on), hardware(usual_hardware(arm)), plant(body) {
    device = std::make_unique<CanDevice>(plant, layout, hardware, script);
    clock = std::make_unique<VirtualClock>(*device);
    for (int i = 0; i < layout.bus_count; ++i) wires.at(static_cast<std::size_t>(i)) = &device->bus(i);
    plan = hal::plan_buses(layout);
    drives.emplace(layout, std::span(wires.data(), static_cast<std::size_t>(layout.bus_count)), plan.timing);
  }

  hal::BringUpResult bring_up() {
    const hal::BringUpResult result = drives->bring_up(*clock);
    clock->sleep_until((device->now_ns() / 1'000'000 + 1) * 1'000'000);
    return result;
  }

  void cycle(const JointVector& torque, hal::PowerRequest power = hal::PowerRequest::kEnable) {
    const std::int64_t begin_ns = device->now_ns();
    drives->request();
    clock->sleep_until(begin_ns + drives->collect_ns());
    drives->receive(reading);
    EXPECT_TRUE(drives->send({torque, power}));
    clock->sleep_until(begin_ns + 1'000'000);
  }
};

TEST(CanLoop, DrivesOfTheArmComeUpAndTakeTorque) {
  const ArmModel arm = test::lwr().model;
  Plant plant(arm, JointVector::Zero());
  Loop loop(arm, test::layout_of(arm), plant);
  const hal::BringUpResult result = loop.bring_up();
  ASSERT_EQ(result.status, hal::BringUpStatus::kOk)
      << describe(result.status) << " bus " << result.bus << " node " << result.node << std::hex << " object "
      << result.index << ':' << int{result.subindex} << " expected " << result.expected << " found " << result.found;
  for (int i = 0; i < 100; ++i) loop.cycle(plant.gravity_torque());
  EXPECT_EQ(loop.reading.alarm, hal::Alarm::kNone);
  EXPECT_FALSE(loop.reading.emergency_stop);
  EXPECT_TRUE(loop.reading.enable_switch);
  for (int i = 0; i < 7; ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_EQ(loop.reading.state.at(at), hal::DriveState::kEnabled);
    EXPECT_EQ(loop.reading.age.at(at), 0u);
    const hal::DriveConfig& drive = loop.layout.drives.at(at);
    EXPECT_NEAR(loop.reading.position[i], plant.positions()[i], 2.1 * M_PI / (drive.counts * drive.gear));
    EXPECT_NEAR(loop.reading.torque[i], plant.gravity_torque()[i], 1.01e-3 * drive.gear * drive.rated_torque);
  }
  EXPECT_EQ(loop.drives->statistics().malformed, 0u);
  for (const auto lost : loop.drives->statistics().lost) EXPECT_EQ(lost, 0u);
}

/// Two joints on a bus whose drives take 150 us: a plan that counts them loses nothing, one that does not loses all.
TEST(CanLoop, DrivesThatTakeTheirTimeAnswerInTheTimeThatThePlanGivesThem) {
  ArmModel arm = test::one_joint(0.5, 0.1);
  arm.gravity_R.setZero();
  arm.joint_count = 2;
  arm.joints[1] = arm.joints[0];
  hal::BusLayout layout = test::layout_of(arm);
  layout.panel.bus = -1;
  for (const bool counted : {true, false}) {
    layout.answer = 150e-6;
    Plant plant(arm, JointVector::Zero());
    Loop loop(arm, layout, plant);
    if (!counted) {
      layout.answer = 0.0;
      loop.drives.emplace(loop.layout, std::span(loop.wires.data(), 1), hal::plan_buses(layout).timing);
    }
    ASSERT_EQ(loop.bring_up().status, hal::BringUpStatus::kOk);
    for (int i = 0; i < 300; ++i) loop.cycle(JointVector::Zero());
    const hal::CanStatistics& statistics = loop.drives->statistics();
    if (counted) {
      EXPECT_EQ(loop.reading.alarm, hal::Alarm::kNone);
      EXPECT_EQ(loop.reading.state.at(0), hal::DriveState::kEnabled);
      EXPECT_EQ(statistics.lost.at(0) + statistics.lost.at(1), 0u);
      EXPECT_GE(statistics.longest_round_trip_ns, 150'000 + 270'000);
    } else {
      EXPECT_GT(statistics.lost.at(1), 250u);
    }
  }
}

TEST(CanLoop, ALimitOfADriveBelowItsJointsIsRefused) {
  const ArmModel arm = test::lwr().model;
  hal::BusLayout layout = test::layout_of(arm);
  for (int i = 0; i < 7; ++i)
    layout.drives.at(static_cast<std::size_t>(i)).torque_limit = arm.joints.at(static_cast<std::size_t>(i)).torque;
  for (const std::uint32_t permille : {1000u, 999u}) {
    Plant plant(arm, JointVector::Zero());
    Loop loop(arm, layout, plant);
    loop.device->nodes().drive(4).objects().set_initial(hal::canopen::kMaxTorque, 0, permille);
    const hal::BringUpResult result = loop.bring_up();
    if (permille == 1000) {
      EXPECT_EQ(result.status, hal::BringUpStatus::kOk) << describe(result.status);
    } else {
      EXPECT_EQ(result.status, hal::BringUpStatus::kTooLow);
      EXPECT_EQ(result.joint, 4);
    }
  }
}

ArmModel three_joints() {
  ArmModel model = test::one_joint(0.5, 0.1);
  model.gravity_R.setZero();
  model.joint_count = 3;
  model.joints[1] = model.joints[2] = model.joints[0];
  return model;
}

/// The three joints at rest, or the seven-joint arm under gravity in a random posture.
JointVector random_posture(const ArmModel& arm, test::Random& random) {
  JointVector q = JointVector::Zero();
  if (arm.joint_count == 3) return q;
  for (int i = 0; i < arm.joint_count; ++i) {
    const ArmJoint& joint = arm.joints.at(static_cast<std::size_t>(i));
    q[i] = random.between(0.6 * joint.lower, 0.6 * joint.upper);
  }
  return q;
}

/// SIGKILL at a hundred random instants, of three joints without gravity and of seven with gravity. All joints
/// accelerate. Each drive has left its torque by its deadline after the last frame, brings its joint to rest within a
/// few degrees, and ends without torque and with its brake closed. A joint that falls would move by a radian and more.
TEST(CanLoop, DrivesStopThemselvesWheneverTheControllerIsKilled) {
  constexpr int kCycles = 20;           // of acceleration
  constexpr double kAcceleration = 30;  // at most [rad/s^2]: 0.6 rad/s at the kill
  test::Random random(3);
  double fastest = 0.0;
  double furthest = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    const ArmModel arm = trial < 100 ? three_joints() : test::lwr().model;
    Plant plant(arm, random_posture(arm, random));
    Loop loop(arm, test::layout_of(arm), plant);
    ASSERT_EQ(loop.bring_up().status, hal::BringUpStatus::kOk);
    for (int i = 0; i < 45; ++i) loop.cycle(plant.gravity_torque());
    JointVector acceleration = JointVector::Zero();
    for (int i = 0; i < arm.joint_count; ++i) acceleration[i] = random.between(-kAcceleration, kAcceleration);
    const auto torque = [&]() -> JointVector {
      return plant.gravity_torque() + mass_matrix(arm, forward_kinematics(arm, plant.positions())) * acceleration;
    };
    for (int i = 0; i < kCycles; ++i) loop.cycle(torque());
    // the last cycle ends anywhere: before SYNC, before or after the torques
    const std::int64_t begin_ns = loop.device->now_ns();
    const std::int64_t killed_ns = begin_ns + random.integer(0, 999'999);
    loop.drives->request();
    if (killed_ns > begin_ns + loop.drives->collect_ns()) {
      loop.clock->sleep_until(begin_ns + loop.drives->collect_ns());
      loop.drives->receive(loop.reading);
      ASSERT_TRUE(loop.drives->send({torque(), hal::PowerRequest::kEnable}));
    }
    loop.clock->sleep_until(killed_ns);
    const JointVector killed_at = plant.positions();
    fastest = std::max(fastest, plant.velocities().cwiseAbs().maxCoeff());
    // frames that were handed over still go out: at most until the end of the cycle
    loop.clock->sleep_until(begin_ns + 1'000'000 + std::llround(1e9 * loop.layout.command_deadline));
    const auto drive = [&loop](int i) -> const Cia402Slave& { return loop.device->nodes().drive(i); };
    for (int i = 0; i < arm.joint_count; ++i) EXPECT_NE(drive(i).state(), PowerState::kEnabled) << trial;
    loop.clock->sleep_until(begin_ns + 600'000'000);
    for (int i = 0; i < arm.joint_count; ++i) {
      EXPECT_EQ(drive(i).motor_torque(), 0.0) << trial;
      EXPECT_GT(drive(i).brake_torque(), 0.0) << trial;
    }
    EXPECT_TRUE(plant.velocities().isZero(1e-9)) << trial;
    furthest = std::max(furthest, (plant.positions() - killed_at).cwiseAbs().maxCoeff());
  }
  std::printf("[ measured ] at most %.3f rad/s at the kill, and %.4f rad from there to rest\n", fastest, furthest);
  EXPECT_GT(fastest, 0.8 * kAcceleration * 1e-3 * kCycles);
  EXPECT_LT(furthest, 0.15);
}

/// The work that a virtual spring does in a period of motion, more than nothing, is what delay and hold give: the delay
/// measured over the wire is that of the layout's frames, and within the plan's.
TEST(CanLoop, MeasuresTheDelayOfTheWire) {
  ArmModel arm = test::one_joint(1.0, 2.0);
  arm.gravity_R.setZero();
  constexpr double kStiffness = 1000.0;
  constexpr double kAmplitude = 4e-3;
  constexpr int kSine = 1000;  // cycles a period
  const double w = 2.0 * M_PI / (1e-3 * kSine);
  HandParameters hand;
  hand.grip = Grip::kSpring;
  hand.stiffness = 3000.0;
  hand.damping = 30.0;
  std::vector<Pose> script(5 * kSine);
  for (std::size_t i = 0; i < script.size(); ++i) {
    const double time = 1e-3 * static_cast<double>(i);
    script[i].translation = Vector3(1.0, std::clamp(time - 1.0, 0.0, 1.0) * kAmplitude * std::sin(w * time), 0.0);
  }
  Plant plant(arm, JointVector::Zero(), JointVector::Zero(), OperatorHand(hand, script));
  Loop loop(arm, test::layout_of(arm), plant);
  ASSERT_EQ(loop.bring_up().status, hal::BringUpStatus::kOk);
  const auto spring = [&loop] {
    JointVector torque = JointVector::Zero();
    const double y = std::sin(loop.reading.position[0]);
    torque[0] = -kStiffness * y * std::cos(loop.reading.position[0]);
    return torque;
  };
  const auto cycle = [&] {
    const std::int64_t begin_ns = loop.device->now_ns();
    loop.drives->request();
    loop.clock->sleep_until(begin_ns + loop.drives->collect_ns());
    loop.drives->receive(loop.reading);
    ASSERT_TRUE(loop.drives->send({spring(), hal::PowerRequest::kEnable}));
    loop.clock->sleep_until(begin_ns + 1'000'000);
  };
  while (loop.device->now_ns() < 3 * kSine * 1'000'000LL) cycle();
  const double work_before = plant.work().motor.sum();
  const double y_before = std::sin(plant.positions()[0]);
  double in_phase = 0.0;
  double out_of_phase = 0.0;
  for (int i = 0; i < kSine; ++i) {
    const double y = std::sin(plant.positions()[0]);
    in_phase += 2.0 / kSine * y * std::cos(w * 1e-3 * i);
    out_of_phase += 2.0 / kSine * y * std::sin(w * 1e-3 * i);
    cycle();
  }
  const double square = in_phase * in_phase + out_of_phase * out_of_phase;
  ASSERT_GT(square, 1e-6);
  const double y_after = std::sin(plant.positions()[0]);
  const double stored = 0.5 * kStiffness * (y_after * y_after - y_before * y_before);
  const double given = plant.work().motor.sum() - work_before + stored;
  const double measured = given / (M_PI * w * square * kStiffness) - 0.5e-3;
  // from the end of SYNC, where it is sampled, to the end of the torque's frame
  const double expected = 1e-9 * static_cast<double>(loop.plan.unblocked_ns[0]);
  std::printf("[ measured ] %.1f us of %.1f, longest by the plan %.1f\n", 1e6 * measured, 1e6 * expected,
              1e6 * loop.plan.timing.delay_s);
  EXPECT_NEAR(measured, expected, 0.05 * expected);
  EXPECT_LT(measured, loop.plan.timing.delay_s);
}

/// A4 over the wire, with the delay of the layout's frames: a torsional spring on one joint, released at 20 mrad.
TEST(CanLoop, DecaysBelowTheExactBoundaryOfItsDelayAndGrowsAbove) {
  ArmModel arm = test::one_joint(1.0, 2.0);
  arm.gravity_R.setZero();
  for (const double share : {0.98, 1.02}) {
    Plant plant(arm, JointVector::Constant(0.02));
    Loop loop(arm, test::layout_of(arm), plant);
    ASSERT_EQ(loop.bring_up().status, hal::BringUpStatus::kOk);
    ArmLoop theory;
    theory.joint_count = 1;
    theory.mass(0, 0) = 1.0;
    theory.damping[0] = 2.0;
    theory.jacobian(0, 0) = 1.0;
    theory.stiffness = 1.0;
    theory.timing.delay = 1e-9 * static_cast<double>(loop.plan.unblocked_ns[0]);
    theory.stiffness = share * stiffness_margin(theory);
    const auto cycle = [&] {
      const std::int64_t begin_ns = loop.device->now_ns();
      loop.drives->request();
      loop.clock->sleep_until(begin_ns + loop.drives->collect_ns());
      loop.drives->receive(loop.reading);
      JointVector torque = JointVector::Zero();
      torque[0] = -theory.stiffness * loop.reading.position[0];
      ASSERT_TRUE(loop.drives->send({torque, hal::PowerRequest::kEnable}));
      loop.clock->sleep_until(begin_ns + 1'000'000);
    };
    const auto swing = [&] {
      double low = 1.0;
      double high = -1.0;
      for (int i = 0; i < 500; ++i) {
        cycle();
        low = std::min(low, plant.positions()[0]);
        high = std::max(high, plant.positions()[0]);
      }
      return high - low;
    };
    for (int i = 0; i < 500; ++i) cycle();
    const double first = swing();
    for (int i = 0; i < 7500; ++i) cycle();
    const double growth = std::log(swing() / first);
    const double expected = 8000.0 * std::log(spectral_radius(theory));
    std::printf("[ measured ] %.0f N/m, %.2f of the boundary, delay %.1f us: e^%.4f in 8000 cycles, by theory e^%.4f\n",
                theory.stiffness, share, 1e6 * theory.timing.delay, growth, expected);
    if (share < 1.0) {
      EXPECT_LT(growth, 0.0);
    } else {
      EXPECT_GT(growth, 0.0);
    }
    // heartbeats hold some torques up, and torques come in steps of a permille
    EXPECT_NEAR(growth, expected, 0.05);
  }
}

}  // namespace
}  // namespace godobject::sim
