#include "sim/can_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "tests/sim/one_joint.h"
#include "tests/sim/small_master.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/arms.h"

namespace godobject::sim {
namespace {

using test::can_frame;
using test::kMs;
using test::SmallMaster;

constexpr std::int64_t kUs = 1'000;

ArmModel joints(int count, double inertia) {
  ArmModel model = test::one_joint(inertia, 0.0);
  model.gravity_R.setZero();
  model.joint_count = count;
  for (int i = 1; i < count; ++i) model.joints.at(static_cast<std::size_t>(i)) = model.joints[0];
  return model;
}

struct DeviceBench {
  ArmModel model;
  hal::BusLayout layout;
  std::array<JointHardwareParameters, kMaxJoints> hardware;
  Plant plant;
  std::unique_ptr<CanDevice> device;
  SmallMaster master;

  explicit DeviceBench(const ArmModel& arm, const CanScript& script = {})
      : model(arm),
        layout(test::layout_of(arm)),
        hardware(usual_hardware(arm)),
        plant(arm, JointVector::Zero()),
        device(std::make_unique<CanDevice>(plant, layout, hardware, script)),
        master(layout, *device) {}

  void enable(std::int64_t collect_ns = 600 * kUs) {
    ASSERT_TRUE(master.start());
    for (int i = 0; i < 40; ++i) master.cycle({}, collect_ns);
    for (int i = 0; i < layout.joint_count; ++i) ASSERT_EQ(device->nodes().drive(i).state(), PowerState::kEnabled);
  }
};

/// SYNC 55, then answers of 135 one after another in the order of their identifiers, then torques of 95: 745 us.
TEST(CanDevice, CycleOfThreeJointsTakes745Microseconds) {
  DeviceBench bench(joints(3, 1.0));
  bench.layout.panel.bus = -1;  // not on the wire in this test
  Plant plant(bench.model, JointVector::Zero());
  const auto device = std::make_unique<CanDevice>(plant, bench.layout, bench.hardware);
  SmallMaster master(bench.layout, *device);
  ASSERT_TRUE(master.start());
  const std::int64_t begin_ns = device->now_ns();
  master.sync();
  device->advance_to(begin_ns + 54'999);
  EXPECT_TRUE(master.drain(0).empty());
  device->advance_to(begin_ns + 459'999);
  auto frames = master.drain(0);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_TRUE(frames[0].own);
  EXPECT_EQ(frames[0].time_ns, begin_ns + 55 * kUs);
  EXPECT_EQ(frames[1].frame.id, 0x181);
  EXPECT_EQ(frames[1].time_ns, begin_ns + 190 * kUs);
  EXPECT_EQ(frames[2].time_ns, begin_ns + 325 * kUs);
  device->advance_to(begin_ns + 460 * kUs);
  frames = master.drain(0);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].frame.id, 0x183);
  EXPECT_EQ(frames[0].time_ns, begin_ns + 460 * kUs);
  master.command({});
  device->advance_to(begin_ns + kMs);
  frames = master.drain(0);
  ASSERT_EQ(frames.size(), 3u);
  const std::int64_t computed_ns = begin_ns + 460 * kUs + std::llround(1e9 * bench.layout.compute);
  EXPECT_EQ(frames[0].time_ns, computed_ns + 95 * kUs);
  EXPECT_EQ(frames[2].time_ns, computed_ns + 285 * kUs);
  EXPECT_EQ(frames[2].time_ns - begin_ns, 745 * kUs + std::llround(1e9 * bench.layout.compute));
}

/// v = sum of torques times the time that they act, from the end of each RPDO on, to the nanosecond.
TEST(CanDevice, TorquesActWhenTheirFramesEnd) {
  DeviceBench bench(joints(3, 2.0));
  bench.enable();
  const std::int64_t begin_ns = bench.device->now_ns();
  ASSERT_TRUE(bench.plant.velocities().isZero(0.0));
  bench.master.cycle({100, -200, 400}, 600 * kUs);
  bench.device->advance_to(begin_ns + 1'500 * kUs);
  const std::int64_t computed_ns = 600 * kUs + std::llround(1e9 * bench.layout.compute);
  for (int i = 0; i < 3; ++i) {
    const hal::DriveConfig& drive = bench.layout.drives.at(static_cast<std::size_t>(i));
    const double torque = drive.sign * (i == 0 ? 100 : i == 1 ? -200 : 400) * 1e-3 * drive.gear * drive.rated_torque;
    const double acts = 1e-9 * static_cast<double>(1'500 * kUs - computed_ns - (i + 1) * 95 * kUs);
    // joints one above the other about one axis: the rotors' speeds are the joints'
    EXPECT_NEAR(bench.plant.velocities()[i], acts * torque / 2.0, 1e-6 * std::fabs(acts * torque)) << i;
  }
}

TEST(CanDevice, SamplesAtTheEndOfSync) {
  DeviceBench bench(joints(3, 2.0));
  ASSERT_TRUE(bench.master.start());
  bench.plant.set_velocity(JointVector::Zero());
  for (int i = 0; i < 40; ++i) bench.master.cycle({}, 600 * kUs);
  JointVector qd = JointVector::Zero();
  qd.head<3>() << 0.5, -0.4, 0.3;
  bench.plant.set_velocity(qd);
  const JointVector q = bench.plant.positions();
  bench.master.cycle({}, 600 * kUs);
  for (int i = 0; i < 3; ++i) {
    const hal::DriveConfig& drive = bench.layout.drives.at(static_cast<std::size_t>(i));
    const double step = 2.0 * M_PI / (drive.counts * drive.gear);
    EXPECT_NEAR(bench.master.position(i), q[i] + 55e-6 * qd[i], step) << i;
  }
}

TEST(CanDevice, SevenJointsOnThreeBusesAnswerEveryCycle) {
  DeviceBench bench(test::lwr().model);
  ASSERT_EQ(bench.layout.bus_count, 3);
  bench.enable();
  for (int i = 0; i < 100; ++i) {
    const std::int64_t begin_ns = bench.device->now_ns();
    bench.master.cycle({}, 620 * kUs);
    for (int joint = 0; joint < 7; ++joint) {
      const auto& reading = bench.master.readings.at(static_cast<std::size_t>(joint));
      ASSERT_GE(reading.time_ns, begin_ns);
      ASSERT_EQ(reading.statusword & 0x6F, 0x27);
    }
    ASSERT_EQ(bench.master.sync_ns, begin_ns + 55 * kUs);
  }
}

TEST(CanDevice, PanelShowsTheOperatorsSwitches) {
  const CanScript script{.hold_from_ns = 300 * kMs, .faults = {}};
  DeviceBench bench(joints(1, 1.0), script);
  ASSERT_TRUE(bench.master.start());
  ASSERT_LT(bench.device->now_ns(), 290 * kMs);
  bench.master.cycle({}, 600 * kUs);
  EXPECT_EQ(bench.master.panel, 1) << "nobody holds the enable switch";
  while (bench.device->now_ns() < 301 * kMs) bench.master.cycle({}, 600 * kUs);
  EXPECT_EQ(bench.master.panel, 3);
  bench.device->nodes().press_emergency_stop(true);
  bench.master.cycle({}, 600 * kUs);
  EXPECT_EQ(bench.master.panel, 2);
  bench.device->nodes().press_emergency_stop(false);
  bench.device->nodes().hold_enable_switch(false);
  bench.device->nodes().open_clutch(true);
  bench.master.cycle({}, 600 * kUs);
  EXPECT_EQ(bench.master.panel, 5);
}

/// Nothing comes from the controller any more: each drive trips at its own last torque and the deadline, exactly.
TEST(CanDevice, DrivesTripWhenTheControllerFallsSilent) {
  DeviceBench bench(test::lwr().model);
  bench.enable();
  std::array<int, kMaxJoints> gravity{};
  const JointVector held = bench.plant.gravity_torque();
  for (int i = 0; i < 7; ++i) {
    const hal::DriveConfig& drive = bench.layout.drives.at(static_cast<std::size_t>(i));
    gravity.at(static_cast<std::size_t>(i)) =
        static_cast<int>(std::lround(held[i] * drive.sign / (1e-3 * drive.gear * drive.rated_torque)));
  }
  bench.master.cycle(gravity, 620 * kUs);
  const std::int64_t sent_ns = bench.device->now_ns() - kMs + 620 * kUs + std::llround(1e9 * bench.layout.compute);
  const auto joints_at = [](int place) { return place == 0 ? std::vector{0, 3, 6} : std::vector{place, place + 3}; };
  for (int place = 0; place < 3; ++place) {  // of a drive's torque on its bus
    const std::int64_t trips_ns = sent_ns + (place + 1) * 95 * kUs + 4 * kMs;
    bench.device->advance_to(trips_ns);  // events of this instant happen in the next advance
    for (const int i : joints_at(place)) EXPECT_EQ(bench.device->nodes().drive(i).state(), PowerState::kEnabled) << i;
    bench.device->advance_to(trips_ns + 1);
    for (const int i : joints_at(place)) EXPECT_NE(bench.device->nodes().drive(i).state(), PowerState::kEnabled) << i;
  }
  bench.device->advance_to(bench.device->now_ns() + 600 * kMs);
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(bench.device->nodes().drive(i).state(), PowerState::kFault);
    EXPECT_EQ(bench.device->nodes().drive(i).motor_torque(), 0.0);
    EXPECT_GT(bench.device->nodes().drive(i).brake_torque(), 0.0);
  }
  EXPECT_TRUE(bench.plant.velocities().isZero(0.0));
}

TEST(CanDevice, DriveFaultsOfTheScriptAreSeenOverTheWire) {
  const std::vector<DriveFault> faults{{FaultKind::kDriveTrips, 0, 1000, 1},
                                       {FaultKind::kDriveDisabled, 1, 1000, 1},
                                       {FaultKind::kSupplyLost, 2, 1000, 100'000},
                                       {FaultKind::kEmergencyStop, kAllJoints, 1010, 1}};
  DeviceBench bench(joints(3, 1.0), {.hold_from_ns = 0, .faults = faults});
  bench.enable();
  while (bench.device->now_ns() < 1000 * kMs) bench.master.cycle({}, 600 * kUs);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(bench.master.readings.at(static_cast<std::size_t>(i)).statusword & 0x6F, 0x27);
  const std::int64_t last_ns = bench.master.readings[2].time_ns;
  bench.master.cycle({}, 600 * kUs, 0x0F);
  EXPECT_EQ(bench.master.readings[0].statusword & 0x4F, 0x0F) << "fault reaction";
  EXPECT_EQ(bench.master.readings[1].statusword & 0x4F, 0x40);
  EXPECT_EQ(bench.master.readings[2].time_ns, last_ns) << "it does not answer";
  while (bench.device->now_ns() < 1010 * kMs) bench.master.cycle({}, 600 * kUs, 0x0F);
  EXPECT_EQ(bench.master.panel, 3);
  bench.master.cycle({}, 600 * kUs, 0x0F);
  EXPECT_EQ(bench.master.panel, 2);
  bench.master.cycle({}, 600 * kUs, 0x0F);
  EXPECT_EQ(bench.master.panel, 3);
}

/// A controller that turns up at any nanosecond, a plant integrated up to each: twice the same to the last bit.
TEST(CanDevice, RepeatsItself) {
  const auto run = [] {
    DeviceBench bench(test::lwr().model);
    bench.enable();
    for (int i = 0; i < 300; ++i) {
      std::array<int, kMaxJoints> torque{};
      for (int joint = 0; joint < 7; ++joint)
        torque.at(static_cast<std::size_t>(joint)) = (i * 37 + joint * 11) % 41 - 20;
      bench.master.cycle(torque, (600 + i % 50) * kUs + i);
    }
    return std::pair{bench.plant.positions(), bench.plant.velocities()};
  };
  const auto first = run();
  const auto second = run();
  EXPECT_EQ(first.first, second.first);
  EXPECT_EQ(first.second, second.second);
  EXPECT_FALSE(first.second.isZero(1e-3));
}

TEST(CanDevice, IsStatic) {
  if (!test::AllocationGuard::works()) GTEST_SKIP() << "not run: a sanitizer has the heap for itself";
  DeviceBench bench(test::lwr().model);
  bench.enable();
  const test::AllocationGuard guard;
  for (int i = 0; i < 20; ++i) {
    for (int bus = 0; bus < 3; ++bus) (void)bench.device->bus(bus).send(can_frame(0x80, {}));
    bench.device->advance_to(bench.device->now_ns() + kMs);
  }
  // the frames that the test itself puts together are on the stack
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace godobject::sim
