// The values of structs that nobody has filled in: "none", as their comments say.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "hal/can_bus.h"
#include "hal/can_frame.h"
#include "hal/canopen/emergency.h"
#include "hal/canopen/network.h"
#include "hal/canopen/sdo.h"
#include "hal/cia402/alarm_latch.h"
#include "hal/cia402/bring_up.h"
#include "hal/cia402/bus_layout.h"
#include "hal/cia402/can_statistics.h"
#include "hal/cia402/joint_channel.h"
#include "hal/cia402/joint_scaling.h"
#include "hal/cia402/parameters.h"
#include "hal/joint_drives.h"

namespace godobject::hal {
namespace {

TEST(Defaults, AFrameIsEmptyAndOfNobody) {
  const ReceivedFrame received;
  EXPECT_EQ(received.frame.id, 0);
  EXPECT_EQ(received.frame.length, 0);
  EXPECT_FALSE(received.frame.fd);
  EXPECT_EQ(received.frame.data, (std::array<std::uint8_t, 64>{}));
  EXPECT_EQ(received.time_ns, 0);
  EXPECT_FALSE(received.own);
}

TEST(Defaults, ABusIsHealthyAndHasCountedNothing) {
  const BusHealth health;
  EXPECT_FALSE(health.down || health.bus_off || health.passive);
  EXPECT_EQ(health.dropped + health.errors + health.unreturned + health.malformed, 0u);
}

TEST(Defaults, MessagesAreOfNoNode) {
  const canopen::Emergency emergency;
  EXPECT_EQ(emergency.node, 0);
  EXPECT_EQ(emergency.code, 0);
  EXPECT_EQ(emergency.error_register, 0);
  EXPECT_EQ(canopen::Heartbeat().node, 0);
  EXPECT_EQ(canopen::Heartbeat().state, canopen::kNmtBoot);
  const canopen::SdoResponse response;
  EXPECT_EQ(response.node, 0);
  EXPECT_EQ(response.kind, canopen::SdoResponse::Kind::kAborted);
  EXPECT_EQ(response.index, 0);
  EXPECT_EQ(response.subindex, 0);
  EXPECT_EQ(response.size, 0);
  EXPECT_EQ(response.value, 0u);
}

TEST(Defaults, AnAlarmHasNoCause) {
  const cia402::AlarmDetail detail;
  EXPECT_EQ(detail.alarm, Alarm::kNone);
  EXPECT_EQ(detail.bus, -1);
  EXPECT_EQ(detail.joint, -1);
  EXPECT_EQ(detail.id, 0);
  EXPECT_EQ(detail.index, 0);
  EXPECT_EQ(detail.subindex, 0);
  EXPECT_EQ(detail.expected, 0u);
  EXPECT_EQ(detail.found, 0u);
}

TEST(Defaults, AStartHasNoCulprit) {
  const BringUpResult result;
  EXPECT_EQ(result.status, BringUpStatus::kOk);
  EXPECT_EQ(result.bus, -1);
  EXPECT_EQ(result.node, 0);
  EXPECT_EQ(result.joint, -1);
  EXPECT_EQ(result.index, 0);
  EXPECT_EQ(result.subindex, 0);
  EXPECT_EQ(result.expected, 0u);
  EXPECT_EQ(result.found, 0u);
  EXPECT_EQ(result.ratio_expected, 0.0);
  EXPECT_EQ(result.ratio_found, 0.0);
  EXPECT_FALSE(result.began);
}

TEST(Defaults, StatisticsAreZero) {
  const CanStatistics statistics;
  EXPECT_EQ(statistics.sent + statistics.full + statistics.down + statistics.received, 0u);
  EXPECT_EQ(statistics.malformed + statistics.floods + statistics.warnings, 0u);
  for (const std::uint64_t count : statistics.lost) EXPECT_EQ(count, 0u);
  for (const std::uint64_t count : statistics.late) EXPECT_EQ(count, 0u);
  EXPECT_EQ(statistics.round_trip_ns, 0);
  EXPECT_EQ(statistics.longest_round_trip_ns, 0);
}

TEST(Defaults, AReadingHasNoAlarmAndNobodyPressesAnything) {
  const JointReading reading;
  EXPECT_EQ(reading.position, JointVector::Zero());
  EXPECT_EQ(reading.torque, JointVector::Zero());
  EXPECT_FALSE(reading.emergency_stop || reading.enable_switch || reading.clutch_open);
  EXPECT_EQ(reading.alarm, Alarm::kNone);
  EXPECT_EQ(reading.alarm_joint, -1);
  const JointCommand command;
  EXPECT_EQ(command.torque, JointVector::Zero());
  EXPECT_EQ(command.power, PowerRequest::kOff);
}

/// A drive of which the device file tells nothing: 2^20 counts a turn of its joint, no gear, no torque.
TEST(Defaults, ADriveTurnsOncePerMillionCountsAndGivesNoTorque) {
  cia402::JointScaling scaling{DriveConfig()};
  EXPECT_EQ(scaling.position(0), 0.0);
  EXPECT_DOUBLE_EQ(scaling.position(1'048'576), 2.0 * M_PI);
  EXPECT_EQ(scaling.torque(1000), 0.0);
  EXPECT_EQ(DriveConfig().torque_limit, 0.0);
  cia402::JointChannel channel(DriveConfig(), false, 1e-3);
  CanFrame rpdo;
  EXPECT_FALSE(channel.command(PowerRequest::kEnable, 1.0, rpdo)) << "no rated torque";
  EXPECT_EQ(rpdo.id, 0x201);
}

TEST(Defaults, AChannelWithoutADriveIsUnavailableAndAtZero) {
  cia402::JointChannel channel;
  EXPECT_EQ(channel.state(), DriveState::kUnavailable);
  EXPECT_EQ(channel.position(), 0.0);
  EXPECT_EQ(channel.torque(), 0.0);
  EXPECT_FALSE(channel.left_torque_mode());
  CanFrame rpdo;
  EXPECT_FALSE(channel.command(PowerRequest::kEnable, 1.0, rpdo));
  EXPECT_EQ(rpdo.id, 0x200) << "of no node";
  EXPECT_FALSE(rpdo.fd);
  cia402::JointScaling scaling;
  EXPECT_EQ(scaling.position(1000), 0.0);
  EXPECT_EQ(scaling.position(2000), 0.0);
  EXPECT_EQ(scaling.torque(1000), 0.0);
}

TEST(Defaults, ALayoutHasOneClassicalBusOfAMegabitAndNoNode) {
  const BusLayout layout;
  EXPECT_EQ(layout.bus_count, 1);
  EXPECT_EQ(layout.joint_count, 0);
  EXPECT_EQ(layout.bit_rate, 1e6);
  EXPECT_FALSE(layout.fd);
  EXPECT_EQ(layout.data_rate, 5e6);
  EXPECT_EQ(layout.period, 1e-3);
  EXPECT_EQ(layout.panel.bus, -1);
  EXPECT_EQ(layout.panel.node, 32);
  EXPECT_EQ(BusTiming().collect_ns, 0);
  EXPECT_EQ(BusTiming().delay_s, 0.0);
}

TEST(Defaults, AParameterMatchesOnlyZeroAndAllOfIt) {
  const cia402::ParameterStep step;
  EXPECT_EQ(step.index, 0);
  EXPECT_EQ(step.subindex, 0);
  EXPECT_EQ(step.size, 0);
  EXPECT_TRUE(step.accepts(0));
  for (int bit = 0; bit < 32; ++bit) EXPECT_FALSE(step.accepts(1u << bit)) << bit;
}

}  // namespace
}  // namespace godobject::hal
