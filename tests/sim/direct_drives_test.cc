#include "sim/direct_drives.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/sim/one_joint.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/arms.h"

namespace godobject::sim {
namespace {

using hal::DriveState;
using hal::PowerRequest;
using test::kPeriod_ns;

/// A cycle as a controller runs it, its torque for all joints.
struct DrivesLoop {
  DirectDrives& drives;
  VirtualClock clock{drives};
  std::int64_t deadline_ns = 0;
  hal::JointReading reading{};
  hal::JointCommand command{JointVector::Zero(), PowerRequest::kEnable};

  bool run() {
    drives.receive(reading);
    const bool sent = drives.send(command);
    deadline_ns += kPeriod_ns;
    clock.sleep_until(deadline_ns);
    return sent;
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) run();
  }
  int run_until(DriveState state, int at_most) {
    for (int i = 0; i < at_most; ++i) {
      run();
      if (reading.state[0] == state) return i;
    }
    return at_most;
  }
};

std::array<JointHardwareParameters, 1> exact_joint() {
  JointHardwareParameters joint;
  joint.torque_limit = 100.0;
  joint.brake_torque = 1000.0;
  return {joint};
}

TEST(DirectDrives, EnableTakesPowerStageAndBrake) {
  Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero());
  const auto hardware = exact_joint();
  DirectDrives drives(plant, hardware, {kPeriod_ns, 0});
  DrivesLoop loop{drives};
  loop.command.torque[0] = 1.0;
  EXPECT_EQ(loop.run_until(DriveState::kEnabled, 100), 29);  // 3 + 25 ms, found at the start of the next cycle
  // from 28 ms on torque acts, and nothing before: v = t
  EXPECT_NEAR(plant.velocities()[0], 30e-3 - 28e-3, 1e-12);
  EXPECT_EQ(loop.reading.torque[0], 1.0);
}

TEST(DirectDrives, TorqueActsAfterTheDelayToTheNanosecond) {
  for (const std::int64_t delay_ns : {0L, 1L, 250'000L, 777'777L, 1'000'000L, 1'350'001L, 2'000'000L, 7'900'000L}) {
    Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero());
    const auto hardware = exact_joint();
    DirectDrives drives(plant, hardware, {kPeriod_ns, delay_ns});
    DrivesLoop loop{drives};
    ASSERT_LT(loop.run_until(DriveState::kEnabled, 100), 100);
    loop.run(20);
    ASSERT_EQ(plant.velocities()[0], 0.0);
    const std::int64_t sent_ns = loop.deadline_ns;
    loop.command.torque[0] = 10.0;
    loop.run(1);
    loop.command.torque[0] = 0.0;
    loop.run(20);
    // one period of 10 Nm on 1 kg m^2; how far it got since tells when
    EXPECT_NEAR(plant.velocities()[0], 10.0 * 1e-3, 1e-12) << delay_ns;
    const double since = 1e-9 * static_cast<double>(loop.deadline_ns - sent_ns - delay_ns) - 0.5e-3;
    EXPECT_NEAR(plant.positions()[0], 1e-2 * since, 1e-13) << delay_ns;
    EXPECT_EQ(drives.delay(), 1e-9 * static_cast<double>(delay_ns));
  }
}

TEST(DirectDrives, EachJointHasItsOwnTimes) {
  for (const std::int64_t sampled_ns : {0L, 55'000L, 433'333L}) {
    Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero());
    const auto hardware = exact_joint();
    DriveTiming timing{.period_ns = kPeriod_ns, .delay_ns = 300'000};
    timing.sampled_ns[0] = sampled_ns;
    timing.acts_ns[0] = 470'001;
    timing.collect_ns = 500'000;
    DirectDrives drives(plant, hardware, timing);
    EXPECT_EQ(drives.delay(), 1e-9 * static_cast<double>(770'001 - sampled_ns));
    EXPECT_EQ(drives.collect_ns(), 500'000);
    DrivesLoop loop{drives};
    ASSERT_LT(loop.run_until(DriveState::kEnabled, 100), 100);
    loop.clock.sleep_until(loop.deadline_ns + drives.collect_ns());
    loop.command.torque[0] = 10.0;
    drives.send(loop.command);
    loop.clock.sleep_until(loop.deadline_ns += kPeriod_ns);
    EXPECT_NEAR(plant.velocities()[0], 10.0 * 229'999e-9, 1e-12);
    const double v = plant.velocities()[0];
    const double q = plant.positions()[0];
    loop.clock.sleep_until(loop.deadline_ns + drives.collect_ns());
    drives.receive(loop.reading);
    const double t = 1e-9 * static_cast<double>(sampled_ns);
    EXPECT_NEAR(loop.reading.position[0], q + v * t + 5.0 * t * t, 1e-15) << sampled_ns;
    EXPECT_EQ(loop.reading.age[0], 0u);
  }
}

TEST(DirectDrives, BeforeItsSampleAJointIsAsOldAsTheLastOne) {
  Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero());
  const auto hardware = exact_joint();
  DriveTiming timing{.period_ns = kPeriod_ns, .delay_ns = 0};
  timing.sampled_ns[0] = timing.collect_ns = 200'000;
  DirectDrives drives(plant, hardware, timing);
  hal::JointReading reading;
  drives.receive(reading);
  EXPECT_EQ(reading.age[0], 1u) << "none yet";
  drives.advance_to(200'000);
  drives.receive(reading);
  EXPECT_EQ(reading.age[0], 0u);
  drives.advance_to(kPeriod_ns + 199'999);
  drives.receive(reading);
  EXPECT_EQ(reading.age[0], 1u);
  drives.advance_to(kPeriod_ns + 200'000);
  drives.receive(reading);
  EXPECT_EQ(reading.age[0], 0u);
}

TEST(DirectDrives, SendLaterInTheCycleActsAtTheSameTime) {
  Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero());
  const auto hardware = exact_joint();
  DirectDrives drives(plant, hardware, {kPeriod_ns, 600'000});
  DrivesLoop loop{drives};
  loop.run(50);
  loop.clock.spend(400'000);
  loop.command.torque[0] = 10.0;
  loop.run(1);
  EXPECT_NEAR(plant.velocities()[0], 10.0 * 0.4e-3, 1e-12);
  loop.clock.spend(800'000);  // too late by 0.2 ms: at once
  loop.command.torque[0] = -10.0;
  loop.run(1);
  EXPECT_NEAR(plant.velocities()[0], 10.0 * (0.4e-3 + 0.8e-3 - 0.2e-3), 1e-12);
}

TEST(DirectDrives, RoundsAndLimitsTorques) {
  Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero());
  auto hardware = exact_joint();
  hardware[0].torque_limit = 5.0;
  hardware[0].torque_step = 0.1;
  DirectDrives drives(plant, hardware, {kPeriod_ns, 0});
  DrivesLoop loop{drives};
  loop.run(50);
  const auto acts = [&](double torque) {
    loop.command.torque[0] = torque;
    const double before = plant.velocities()[0];
    loop.run(1);
    const double acted = (plant.velocities()[0] - before) / 1e-3;
    loop.run(1);
    EXPECT_NEAR(loop.reading.torque[0], acted, 1e-9);
    return acted;
  };
  EXPECT_NEAR(acts(1.234), 1.2, 1e-9);
  EXPECT_NEAR(acts(-1.27), -1.3, 1e-9);
  EXPECT_NEAR(acts(0.049), 0.0, 1e-9);
  EXPECT_NEAR(acts(7.0), 5.0, 1e-9);
  EXPECT_NEAR(acts(-700.0), -5.0, 1e-9);
  EXPECT_NEAR(acts(std::numeric_limits<double>::quiet_NaN()), 0.0, 1e-9);
  EXPECT_NEAR(acts(std::numeric_limits<double>::infinity()), 0.0, 1e-9);
  EXPECT_EQ(drives.counters().not_finite, 4);
}

TEST(DirectDrives, MotorTheWrongWayRoundPushesBackUnnoticed) {
  Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero());
  auto hardware = exact_joint();
  hardware[0].motor_sign = -1.0;
  DirectDrives drives(plant, hardware, {kPeriod_ns, 0});
  DrivesLoop loop{drives};
  loop.run(50);
  loop.command.torque[0] = 2.0;
  loop.run(11);
  EXPECT_NEAR(plant.velocities()[0], -2.0 * 11e-3, 1e-12);
  EXPECT_EQ(loop.reading.torque[0], 2.0);
}

TEST(DirectDrives, EncoderRoundsToCountsAndItsWrapIsSeamless) {
  for (const std::int32_t start : {0, std::numeric_limits<std::int32_t>::max() - 50, -7}) {
    Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero());
    auto hardware = exact_joint();
    hardware[0].encoder_step = 1e-3;
    hardware[0].counter_at_zero = start;
    DirectDrives drives(plant, hardware, {kPeriod_ns, 0});
    plant.set_velocity(JointVector::Unit(0));
    DrivesLoop loop{drives};
    loop.command.torque[0] = 5.0;
    bool wrapped = false;
    std::int32_t before = drives.joint(0).counter(plant.positions()[0]);
    for (int i = 0; i < 400; ++i) {
      const double q = plant.positions()[0];
      loop.run();
      EXPECT_NEAR(loop.reading.position[0], q - 0.5e-3, 0.5001e-3);
      EXPECT_NEAR(std::remainder(loop.reading.position[0] / 1e-3, 1.0), 0.0, 1e-9);
      const std::int32_t now = drives.joint(0).counter(plant.positions()[0]);
      wrapped = wrapped || now < before;
      before = now;
    }
    EXPECT_EQ(wrapped, start > 0);
  }
}

TEST(VirtualClock, SleepsUntilAndLate) {
  Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero());
  const auto hardware = exact_joint();
  DirectDrives drives(plant, hardware, {kPeriod_ns, 0});
  const LateWake late[] = {{5'000'000, 300'000}, {8'000'000, 2'500'000}};
  VirtualClock clock(drives, late);
  for (const auto& [until, woke] : {std::pair{1'000'000, 1'000'000},
                                    {500'000, 1'000'000},
                                    {4'999'999, 4'999'999},
                                    {5'000'000, 5'300'000},
                                    {6'000'000, 6'000'000},
                                    {8'500'000, 11'000'000},
                                    {9'000'000, 11'000'000},
                                    {11'000'001, 11'000'001}}) {
    clock.sleep_until(until);
    EXPECT_EQ(clock.now_ns(), woke);
    EXPECT_EQ(plant.now_ns(), woke);
  }
}

/// Runs `cycles` on an enabled joint with a script whose cycles count from the first of these.
struct Scripted {
  std::vector<DriveFault> script;
  Plant plant{test::one_joint(1.0, 0.0), JointVector::Zero()};
  std::array<JointHardwareParameters, 1> hardware = exact_joint();
  DirectDrives drives;
  DrivesLoop loop{drives};

  static std::vector<DriveFault> later(DriveFault fault) {
    fault.first_cycle += 50;
    return {fault};
  }
  explicit Scripted(const DriveFault& fault)
      : script(later(fault)), drives(plant, hardware, {kPeriod_ns, 0, /*enable_ns=*/0}, script) {
    loop.run(50);
    plant.set_velocity(JointVector::Unit(0));
  }
  /// Returns the reading of each cycle from the first cycle of the script on. Appends the true positions.
  std::vector<hal::JointReading> readings(int cycles, std::vector<double>& positions) {
    std::vector<hal::JointReading> all;
    for (int i = 0; i < cycles; ++i) {
      positions.push_back(plant.positions()[0]);
      loop.run();
      all.push_back(loop.reading);
    }
    return all;
  }
};

TEST(Faults, EncoderJumps) {
  Scripted run({FaultKind::kEncoderJump, 0, 2, 3, 0.25});
  std::vector<double> q;
  const auto read = run.readings(8, q);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(read[i].position[0], q[i] + (i >= 2 && i < 5 ? 0.25 : 0.0), 1e-15) << i;
  }
}

TEST(Faults, EncoderReadsNotANumber) {
  Scripted run({FaultKind::kEncoderNotFinite, kAllJoints, 2, 1, 0.0});
  std::vector<double> q;
  const auto read = run.readings(5, q);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(std::isnan(read[i].position[0]), i == 2) << i;
}

TEST(Faults, EncoderSticks) {
  Scripted run({FaultKind::kEncoderStuck, 0, 2, 4, 0.0});
  std::vector<double> q;
  const auto read = run.readings(8, q);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(read[i].position[0], q[i >= 2 && i < 6 ? 2 : i]) << i;
    EXPECT_EQ(read[i].age[0], 0U);
  }
}

TEST(Faults, LostReadingsGrowOld) {
  Scripted run({FaultKind::kReadingLost, 0, 2, 3, 0.0});
  std::vector<double> q;
  const auto read = run.readings(7, q);
  const std::uint32_t age[] = {0, 0, 1, 2, 3, 0, 0};
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(read[i].age[0], age[i]) << i;
    EXPECT_EQ(read[i].position[0], q[i - age[i]]) << i;
  }
}

TEST(Faults, LateReadingsAreOfAnEarlierCycle) {
  Scripted run({FaultKind::kReadingLate, 0, 3, 4, 2.0});
  std::vector<double> q;
  const auto read = run.readings(9, q);
  // the sample before the fault is newer than the first late samples
  const std::uint32_t age[] = {0, 0, 0, 1, 2, 2, 2, 0, 0};
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(read[i].age[0], age[i]) << i;
    EXPECT_EQ(read[i].position[0], q[i - age[i]]) << i;
  }
}

TEST(Faults, DriveTripsUntilReset) {
  Scripted run({FaultKind::kDriveTrips, 0, 2, 1, 0.0});
  run.loop.command.torque[0] = 1.0;
  std::vector<double> q;
  auto read = run.readings(30, q);
  EXPECT_EQ(read[1].state[0], DriveState::kEnabled);
  EXPECT_EQ(read[2].state[0], DriveState::kFault);
  EXPECT_EQ(read[29].state[0], DriveState::kFault) << "enable does not reset";
  EXPECT_EQ(read[3].torque[0], 0.0);
  EXPECT_EQ(run.plant.velocities()[0], 0.0) << "the brake holds";
  run.loop.command.power = PowerRequest::kReset;
  run.loop.run(2);
  EXPECT_EQ(run.loop.reading.state[0], DriveState::kOff);
  run.loop.command.power = PowerRequest::kEnable;
  EXPECT_LT(run.loop.run_until(DriveState::kEnabled, 100), 40);
}

TEST(Faults, DriveLeavesEnabledByItself) {
  Scripted run({FaultKind::kDriveDisabled, 0, 2, 1, 0.0});
  std::vector<double> q;
  const auto read = run.readings(5, q);
  EXPECT_EQ(read[1].state[0], DriveState::kEnabled);
  EXPECT_EQ(read[2].state[0], DriveState::kOff);
}

TEST(Faults, SendFailsAndNothingArrives) {
  Scripted run({FaultKind::kSendFails, 0, 2, 2, 0.0});
  run.loop.command.torque[0] = 1.0;
  run.loop.run(2);
  const double before = run.plant.velocities()[0];
  run.loop.command.torque[0] = -1.0;
  EXPECT_FALSE(run.loop.run());
  EXPECT_FALSE(run.loop.run());
  EXPECT_NEAR(run.plant.velocities()[0] - before, 2e-3, 1e-12) << "the last torque holds";
  EXPECT_TRUE(run.loop.run());
  EXPECT_NEAR(run.plant.velocities()[0] - before, 1e-3, 1e-12);
  EXPECT_EQ(run.drives.counters().dropped, 2);
}

TEST(Faults, DriveTripsWhenNoCommandComes) {
  Scripted run({FaultKind::kCommandLost, 0, 2, 20, 0.0});
  run.loop.command.torque[0] = 1.0;
  std::vector<double> q;
  const auto read = run.readings(10, q);
  // the last command came at the start of cycle 1; the deadline of 4 ms ends at the start of 5, and is passed after it
  for (std::size_t i = 0; i <= 5; ++i) EXPECT_EQ(read[i].state[0], DriveState::kEnabled) << i;
  for (std::size_t i = 6; i < 10; ++i) EXPECT_EQ(read[i].state[0], DriveState::kFault) << i;
  EXPECT_EQ(read[6].torque[0], 0.0);
}

TEST(Faults, SupplyLostMeansNoAnswerAndABrake) {
  Scripted run({FaultKind::kSupplyLost, 0, 2, 40, 0.0});
  run.loop.command.torque[0] = 1.0;
  std::vector<double> q;
  const auto read = run.readings(41, q);
  EXPECT_EQ(read[1].state[0], DriveState::kEnabled);
  for (std::size_t i = 2; i < 41; ++i) {
    ASSERT_EQ(read[i].state[0], DriveState::kUnavailable) << i;
    ASSERT_EQ(read[i].age[0], i - 1) << i;
    ASSERT_EQ(read[i].position[0], q[1]);
  }
  EXPECT_NEAR(q[22] - q[21], q[21] - q[20], 1e-12) << "limp for 20 ms";
  EXPECT_EQ(run.plant.velocities()[0], 0.0) << "then the brake";
  EXPECT_LT(run.loop.run_until(DriveState::kEnabled, 100), 40) << "supply is back";
}

TEST(Faults, OperatorsSwitches) {
  Scripted pressed({FaultKind::kEmergencyStop, kAllJoints, 2, 2, 0.0});
  Scripted released({FaultKind::kEnableReleased, kAllJoints, 2, 2, 0.0});
  std::vector<double> q;
  const auto stop = pressed.readings(6, q);
  const auto enable = released.readings(6, q);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(stop[i].emergency_stop, i == 2 || i == 3);
    EXPECT_TRUE(stop[i].enable_switch);
    EXPECT_EQ(enable[i].enable_switch, i != 2 && i != 3);
    EXPECT_FALSE(enable[i].emergency_stop);
    EXPECT_FALSE(stop[i].clutch_open || enable[i].clutch_open);
  }
  pressed.drives.press_emergency_stop(true);
  pressed.drives.hold_enable_switch(false);
  pressed.loop.run();
  EXPECT_TRUE(pressed.loop.reading.emergency_stop);
  EXPECT_FALSE(pressed.loop.reading.enable_switch);
  Scripted clutch({FaultKind::kClutchOpen, kAllJoints, 2, 2, 0.0});
  std::vector<double> nowhere;
  const auto open = clutch.readings(6, nowhere);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(open[i].clutch_open, i == 2 || i == 3);
}

TEST(DirectDrives, EnableSwitchIsReleasedUntilItsTime) {
  Plant plant(test::one_joint(1.0, 0.0), JointVector::Zero());
  const auto hardware = exact_joint();
  DirectDrives drives(plant, hardware, {.period_ns = kPeriod_ns, .delay_ns = 0, .enable_ns = 20 * kPeriod_ns});
  DrivesLoop loop{drives};
  for (int i = 0; i < 40; ++i) {
    loop.run();
    EXPECT_EQ(loop.reading.enable_switch, i >= 20) << i;
  }
  drives.hold_enable_switch(false);
  loop.run();
  EXPECT_FALSE(loop.reading.enable_switch);
}

TEST(DirectDrives, AllocatesNothing) {
  if (!test::AllocationGuard::works()) GTEST_SKIP() << "a sanitizer needs malloc for itself";
  const test::Arm arm = test::lwr();
  HandParameters hand;
  hand.grip = Grip::kSpring;
  const std::vector<Pose> script(100);
  Plant plant(arm.model, JointVector::Constant(0.3), JointVector::Constant(0.1), OperatorHand(hand, script));
  const auto hardware = usual_hardware(arm.model);
  const DriveFault script_of_faults[] = {{FaultKind::kReadingLost, 3, 40, 2, 0.0},
                                         {FaultKind::kSupplyLost, 3, 60, 5, 0.0}};
  DirectDrives drives(plant, hardware, {kPeriod_ns, 1'300'000}, script_of_faults);
  DrivesLoop loop{drives};
  const test::AllocationGuard guard;
  for (int i = 0; i < 200; ++i) {
    loop.command.torque = plant.gravity_torque();
    if (i == 150) loop.command.power = PowerRequest::kQuickStop;
    loop.run();
  }
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace godobject::sim
