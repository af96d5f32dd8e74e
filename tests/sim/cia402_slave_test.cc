#include "sim/cia402_slave.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <vector>

#include "sim/virtual_clock.h"
#include "tests/sim/canopen_bench.h"

namespace godobject::sim {
namespace {

using test::can_frame;
using test::is;
using test::kMs;
using enum PowerState;

hal::DriveConfig slave_config() {
  hal::DriveConfig config;
  config.node = 5;
  config.counts = 1000.0;
  config.gear = 10.0;
  config.rated_torque = 2.0;  // a permille is 0.02 Nm at the joint
  return config;
}

JointHardwareParameters slave_joint() {
  JointHardwareParameters joint;
  joint.torque_limit = 20.0;
  joint.brake_torque = 40.0;
  joint.quick_stop_damping = 2.0;
  joint.quick_stop_stiffness = 50.0;
  return joint;
}

/// An operational drive with the layout's PDOs whose joint stands where it is told.
struct SlaveBench : test::NodeBench<Cia402Slave> {
  Cia402Slave slave;
  double position = 0.0;
  double velocity = 0.0;

  explicit SlaveBench(const hal::DriveConfig& config = slave_config(), int deadline_ms = 0)
      : NodeBench{slave}, slave(config, slave_joint(), false) {
    boot();
    EXPECT_EQ(write(0x1400, 1, 4, 0x8000'0205), 0u);
    EXPECT_EQ(write(0x1600, 0, 1, 0), 0u);
    EXPECT_EQ(write(0x1600, 1, 4, 0x6040'0010), 0u);
    EXPECT_EQ(write(0x1600, 2, 4, 0x6071'0010), 0u);
    EXPECT_EQ(write(0x1600, 0, 1, 2), 0u);
    EXPECT_EQ(write(0x1400, 5, 2, static_cast<std::uint32_t>(deadline_ms)), 0u);
    EXPECT_EQ(write(0x1400, 1, 4, 0x205), 0u);
    EXPECT_EQ(write(0x1800, 1, 4, 0x8000'0185), 0u);
    EXPECT_EQ(write(0x1A00, 0, 1, 0), 0u);
    EXPECT_EQ(write(0x1A00, 1, 4, 0x6041'0010), 0u);
    EXPECT_EQ(write(0x1A00, 2, 4, 0x6064'0020), 0u);
    EXPECT_EQ(write(0x1A00, 3, 4, 0x6077'0010), 0u);
    EXPECT_EQ(write(0x1A00, 0, 1, 3), 0u);
    EXPECT_EQ(write(0x1800, 2, 1, 1), 0u);
    EXPECT_EQ(write(0x1800, 1, 4, 0x185), 0u);
    EXPECT_EQ(write(0x6060, 0, 1, 10), 0u);
    put(can_frame(0, {1, 0}));
    update();
  }

  void update() { slave.update(now_ns, position, velocity); }
  void command(int controlword, int torque = 0) {
    update();
    put(can_frame(0x205, {controlword & 0xFF, controlword >> 8, torque & 0xFF, (torque >> 8) & 0xFF}));
    update();
  }
  /// In steps of a tenth of a millisecond, without a frame.
  void wait(double ms) {
    for (const auto end_ns = now_ns + static_cast<std::int64_t>(ms * kMs); now_ns < end_ns;) {
      now_ns += kMs / 10;
      update();
      slave.run_timers(now_ns);
    }
  }
  /// Into a state by the standard's own way.
  void bring_to(PowerState state) {
    if (state == kSwitchOnDisabled) return;
    if (state == kFault) return slave.trip(0x2310, now_ns);
    command(0x06);
    if (state == kReady) return;
    command(0x07);
    wait(4.0);
    if (state == kSwitchedOn) return;
    command(0x0F);
    wait(26.0);
    velocity = 1.0;
    update();
    if (state == kQuickStop) command(0x02);
    if (state == kFaultReaction) slave.trip(0x2310, now_ns);
  }
  std::vector<int> tpdo() {
    update();
    sent();
    const auto frames = put(can_frame(0x80, {}));
    return frames.size() == 1 ? test::bytes_of(frames[0]) : std::vector<int>{};
  }
  int statusword() {
    const auto bytes = tpdo();
    return bytes.size() < 2 ? -1 : bytes[0] | bytes[1] << 8;
  }
};

struct Row {
  PowerState from;
  int controlword;
  PowerState to;
};

/// CiA 402's figure, one row for each state and command; transition 16 only for 605A above 4, which this drive has not.
TEST(Cia402Slave, TakesTheTransitionsOfTheStandard) {
  const std::vector<Row> table{
      // disable voltage 00, quick stop 02, shutdown 06, switch on 07, enable operation 0F, fault reset 80
      {kSwitchOnDisabled, 0x00, kSwitchOnDisabled},
      {kSwitchOnDisabled, 0x02, kSwitchOnDisabled},
      {kSwitchOnDisabled, 0x06, kReady},
      {kSwitchOnDisabled, 0x07, kSwitchOnDisabled},
      {kSwitchOnDisabled, 0x0F, kSwitchOnDisabled},
      {kSwitchOnDisabled, 0x80, kSwitchOnDisabled},
      {kReady, 0x00, kSwitchOnDisabled},
      {kReady, 0x02, kSwitchOnDisabled},
      {kReady, 0x06, kReady},
      {kReady, 0x07, kSwitchedOn},
      {kReady, 0x0F, kEnabled},
      {kReady, 0x80, kSwitchOnDisabled},
      {kSwitchedOn, 0x00, kSwitchOnDisabled},
      {kSwitchedOn, 0x02, kSwitchOnDisabled},
      {kSwitchedOn, 0x06, kReady},
      {kSwitchedOn, 0x07, kSwitchedOn},
      {kSwitchedOn, 0x0F, kEnabled},
      {kSwitchedOn, 0x80, kSwitchOnDisabled},
      {kEnabled, 0x00, kSwitchOnDisabled},
      {kEnabled, 0x02, kQuickStop},
      {kEnabled, 0x06, kReady},
      {kEnabled, 0x07, kSwitchedOn},
      {kEnabled, 0x0F, kEnabled},
      {kEnabled, 0x80, kSwitchOnDisabled},
      {kQuickStop, 0x00, kSwitchOnDisabled},
      {kQuickStop, 0x02, kQuickStop},
      {kQuickStop, 0x06, kQuickStop},
      {kQuickStop, 0x07, kQuickStop},
      {kQuickStop, 0x0F, kQuickStop},
      {kQuickStop, 0x80, kSwitchOnDisabled},
      {kFaultReaction, 0x00, kFaultReaction},
      {kFaultReaction, 0x02, kFaultReaction},
      {kFaultReaction, 0x06, kFaultReaction},
      {kFaultReaction, 0x07, kFaultReaction},
      {kFaultReaction, 0x0F, kFaultReaction},
      {kFaultReaction, 0x80, kFaultReaction},
      {kFault, 0x00, kFault},
      {kFault, 0x02, kFault},
      {kFault, 0x06, kFault},
      {kFault, 0x07, kFault},
      {kFault, 0x0F, kFault},
      {kFault, 0x80, kSwitchOnDisabled},
  };
  const std::map<PowerState, int> words{
      {kSwitchOnDisabled, 0x250}, {kReady, 0x231},         {kSwitchedOn, 0x233}, {kEnabled, 0x1237},
      {kQuickStop, 0x217},        {kFaultReaction, 0x21F}, {kFault, 0x218}};
  for (const Row& row : table) {
    SlaveBench bench;
    bench.bring_to(row.from);
    ASSERT_EQ(bench.slave.state(), row.from);
    ASSERT_EQ(bench.statusword(), words.at(row.from));
    bench.command(row.controlword);
    bench.wait(40.0);
    EXPECT_EQ(bench.slave.state(), row.to) << static_cast<int>(row.from) << " by " << row.controlword;
    EXPECT_EQ(bench.statusword(), words.at(row.to));
    if (row.to != kEnabled && row.to != kQuickStop && row.to != kFaultReaction) {
      EXPECT_EQ(bench.slave.motor_torque(), 0.0);
      EXPECT_EQ(bench.slave.brake_torque(), 40.0);
    }
  }
}

TEST(Cia402Slave, PowerStageAndBrakeTakeTheirTime) {
  SlaveBench bench;
  bench.command(0x06);
  bench.command(0x0F, 100);
  bench.wait(2.9);
  EXPECT_EQ(bench.slave.state(), kReady);
  bench.wait(0.2);
  EXPECT_EQ(bench.slave.state(), kSwitchedOn);
  EXPECT_EQ(bench.slave.brake_torque(), 40.0);
  bench.wait(24.8);
  EXPECT_EQ(bench.slave.state(), kSwitchedOn);
  EXPECT_EQ(bench.slave.motor_torque(), 0.0);
  bench.wait(0.3);
  EXPECT_EQ(bench.slave.state(), kEnabled);
  EXPECT_EQ(bench.slave.brake_torque(), 0.0);
  EXPECT_NEAR(bench.slave.motor_torque(), 2.0, 1e-12);
}

TEST(Cia402Slave, WithdrawnEnableClosesTheBrakeAgain) {
  SlaveBench bench;
  bench.bring_to(kSwitchedOn);
  bench.command(0x0F);
  bench.wait(20.0);
  bench.command(0x07);
  bench.wait(30.0);
  EXPECT_EQ(bench.slave.state(), kSwitchedOn);
  EXPECT_EQ(bench.slave.brake_torque(), 40.0);
}

TEST(Cia402Slave, FaultResetNeedsARisingEdge) {
  SlaveBench bench;
  bench.command(0x80);
  bench.slave.trip(0x2310, bench.now_ns);
  bench.command(0x80);
  bench.command(0x86);
  EXPECT_EQ(bench.slave.state(), kFault) << "the bit was set before";
  bench.command(0x06);
  EXPECT_EQ(bench.slave.state(), kFault);
  const auto sent = bench.put(can_frame(0x205, {0x80, 0, 0, 0}));
  EXPECT_EQ(bench.slave.state(), kSwitchOnDisabled);
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_TRUE(is(sent[0], 0x085, {0, 0, 0, 0, 0, 0, 0, 0})) << "no error any more";
}

TEST(Cia402Slave, TripsWithCodeMessageAndReaction) {
  for (const int option : {0, 1, 2}) {
    SlaveBench bench;
    ASSERT_EQ(bench.write(0x605E, 0, 2, static_cast<std::uint32_t>(option)), 0u);
    bench.bring_to(kEnabled);
    bench.command(0x0F, 150);  // 3 Nm
    const auto sent = bench.put(test::sdo_request(5, 0x2000, 0, 2, 0x2310));
    ASSERT_EQ(sent.size(), 2u);
    EXPECT_TRUE(is(sent[0], 0x085, {0x10, 0x23, 0x01, 0, 0, 0, 0, 0}));
    EXPECT_EQ(bench.read(0x603F), 0x2310u);
    bench.update();
    EXPECT_EQ(bench.slave.state(), option == 0 ? kFault : kFaultReaction);
    if (option > 0) {
      EXPECT_NEAR(bench.slave.motor_torque(), 3.0 - 2.0 * 1.0, 1e-12) << "against the motion of 1 rad/s";
    } else {
      EXPECT_EQ(bench.slave.motor_torque(), 0.0);
    }
    bench.velocity = 0.0;
    bench.wait(21.0);
    EXPECT_EQ(bench.slave.state(), kFault);
    EXPECT_EQ(bench.slave.brake_torque(), 40.0);
  }
}

TEST(Cia402Slave, QuickStopFollowsItsOption) {
  for (const int option : {0, 1, 2}) {
    SlaveBench bench;
    ASSERT_EQ(bench.write(0x605A, 0, 2, static_cast<std::uint32_t>(option)), 0u);
    bench.bring_to(kEnabled);
    bench.command(0x02);
    EXPECT_EQ(bench.slave.state(), option == 0 ? kSwitchOnDisabled : kQuickStop);
    EXPECT_NEAR(bench.slave.motor_torque(), option == 0 ? 0.0 : -2.0, 1e-12);
    bench.wait(100.0);
    EXPECT_EQ(bench.slave.state(), option == 0 ? kSwitchOnDisabled : kQuickStop) << "it still moves";
    bench.velocity = 0.0;
    bench.wait(21.0);
    EXPECT_EQ(bench.slave.state(), kSwitchOnDisabled);
    EXPECT_EQ(bench.slave.brake_torque(), 40.0);
    EXPECT_EQ(bench.slave.motor_torque(), 0.0);
  }
  SlaveBench bench;
  EXPECT_EQ(bench.write(0x605A, 0, 2, 5), 0x0609'0030u);
  EXPECT_EQ(bench.write(0x605A, 0, 2, 0xFFFF), 0x0609'0030u);
}

TEST(Cia402Slave, QuickStopThatRunsAwayEndsInAFault) {
  SlaveBench bench;
  bench.bring_to(kQuickStop);
  bench.velocity = 1.6;
  bench.wait(0.1);
  EXPECT_EQ(bench.slave.state(), kFault);
  EXPECT_EQ(bench.slave.motor_torque(), 0.0);
  const auto sent = bench.sent();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_TRUE(is(sent[0], 0x085, {0x00, 0x84, 0x01, 0, 0, 0, 0, 0}));
  EXPECT_EQ(bench.read(0x603F), 0x8400u);
}

/// Torque and state from the first reception on, for each answer to a lost connection.
TEST(Cia402Slave, DeadlineOfTheTorqueTripsToTheNanosecond) {
  const std::map<int, PowerState> ends{{0, kEnabled}, {1, kFaultReaction}, {2, kSwitchOnDisabled}, {3, kQuickStop}};
  for (const auto& [option, end] : ends) {
    SlaveBench bench(slave_config(), 4);
    ASSERT_EQ(bench.write(0x6007, 0, 2, static_cast<std::uint32_t>(option)), 0u);
    EXPECT_EQ(bench.slave.next_timer_ns(), kNever) << "armed by the first reception only";
    for (int i = 0; i < 40; ++i) {
      bench.command(i == 0 ? 0x06 : 0x0F);
      bench.wait(1.0);
    }
    bench.velocity = 1.0;
    bench.command(0x0F, 10);
    ASSERT_EQ(bench.slave.state(), kEnabled);
    const std::int64_t deadline_ns = bench.now_ns + 4 * kMs;
    EXPECT_EQ(bench.slave.next_timer_ns(), deadline_ns);
    bench.slave.run_timers(deadline_ns - 1);
    EXPECT_EQ(bench.slave.state(), kEnabled);
    bench.sent();
    bench.slave.run_timers(deadline_ns);
    EXPECT_EQ(bench.slave.state(), end);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_TRUE(is(sent[0], 0x085, {0x50, 0x82, 0x11, 0, 0, 0, 0, 0}));
    EXPECT_EQ(bench.read(0x603F), option == 1 ? 0x8250u : 0u);
    EXPECT_EQ(bench.slave.next_timer_ns(), kNever) << "once, until the next reception";
    bench.now_ns = deadline_ns;
    bench.command(0x0F, 10);
    EXPECT_EQ(bench.slave.next_timer_ns(), deadline_ns + 4 * kMs);
  }
}

TEST(Cia402Slave, SilenceDoesNotTripADriveThatIsOff) {
  SlaveBench bench(slave_config(), 4);
  bench.command(0x00);
  bench.wait(10.0);
  EXPECT_EQ(bench.slave.state(), kSwitchOnDisabled);
}

TEST(Cia402Slave, NoTorqueOutlivesTheStateOperational) {
  for (const int command : {0x02, 0x80, 0x81, 0x82}) {
    for (const int option : {1, 2, 3}) {
      SlaveBench bench;
      ASSERT_EQ(bench.write(0x6007, 0, 2, static_cast<std::uint32_t>(option)), 0u);
      bench.bring_to(kEnabled);
      bench.command(0x0F, 50);
      bench.velocity = 0.0;
      bench.put(can_frame(0, {command, 5}));
      bench.wait(45.0);
      EXPECT_EQ(bench.slave.motor_torque(), 0.0) << command << ' ' << option;
      EXPECT_EQ(bench.slave.brake_torque(), 40.0) << command << ' ' << option;
    }
  }
}

TEST(Cia402Slave, GivesTorqueInItsOwnModeOnly) {
  SlaveBench bench;
  ASSERT_EQ(bench.write(0x6060, 0, 1, 0), 0u);
  bench.bring_to(kEnabled);
  bench.command(0x0F, 100);
  EXPECT_EQ(bench.slave.motor_torque(), 0.0);
  EXPECT_EQ(bench.statusword() & 0x1000, 0) << "it does not follow";
  ASSERT_EQ(bench.write(0x6060, 0, 1, 10), 0u);
  bench.update();
  EXPECT_NEAR(bench.slave.motor_torque(), 2.0, 1e-12);
}

TEST(Cia402Slave, TellsItsModeByASecondTpdoWhenItChangesAndByATimer) {
  SlaveBench bench;
  bench.put(can_frame(0, {0x80, 0}));
  for (const auto& [index, sub, bytes, value] : {std::tuple(0x1A01, 1, 4, 0x6061'0008u), std::tuple(0x1A01, 0, 1, 1u),
                                                 std::tuple(0x1801, 5, 2, 100u), std::tuple(0x1801, 1, 4, 0x285u)}) {
    ASSERT_EQ(bench.write(index, sub, bytes, value), 0u) << std::hex << index << ':' << sub;
  }
  bench.put(can_frame(0, {1, 0}));
  const auto told = [](const std::vector<hal::CanFrame>& frames, int mode) {
    return std::ranges::count_if(frames, [mode](const hal::CanFrame& f) { return is(f, 0x285, {mode}); });
  };
  EXPECT_EQ(told(bench.put(test::sdo_request(5, 0x6060, 0, 1, 0)), 0), 1);
  EXPECT_EQ(told(bench.put(test::sdo_request(5, 0x6060, 0, 1, 10)), 10), 1);
  bench.slave.slip_mode(8);
  bench.slave.slip_mode(8);
  EXPECT_EQ(told(bench.sent(), 8), 1) << "once";
  EXPECT_EQ(bench.read(0x6061), 8u);
  bench.slave.run_timers(bench.now_ns + 100 * kMs);
  EXPECT_EQ(told(bench.sent(), 8), 1);
  bench.slave.slip_mode(10);
  EXPECT_EQ(told(bench.sent(), 10), 1);
}

TEST(Cia402Slave, LimitsTorqueAndSaysSo) {
  SlaveBench bench;
  bench.bring_to(kEnabled);
  EXPECT_EQ(bench.read(0x6072), 1000u) << "20 Nm in permille of 2 Nm times 10";
  ASSERT_EQ(bench.write(0x6072, 0, 2, 300), 0u);
  bench.command(0x0F, 301);
  EXPECT_NEAR(bench.slave.motor_torque(), 6.0, 1e-12);
  EXPECT_EQ(bench.statusword() & 0x0800, 0x0800);
  bench.command(0x0F, -32768);
  EXPECT_NEAR(bench.slave.motor_torque(), -6.0, 1e-12);
  bench.command(0x0F, -300);
  EXPECT_EQ(bench.statusword() & 0x0800, 0);
  const auto bytes = bench.tpdo();
  EXPECT_EQ(bytes[6], 0xD4);
  EXPECT_EQ(bytes[7], 0xFE) << "-300";
}

/// 1000 counts a turn of the motor, 10 turns a turn of the joint: 10000 counts in 2 pi.
TEST(Cia402Slave, CountsAsItsEncoderAndGearDo) {
  hal::DriveConfig config = slave_config();
  config.zero = 0.5;
  config.sign = -1.0;
  SlaveBench bench(config);
  bench.position = 0.5 - 2.0 * M_PI * 1234.5 / 10'000.0;
  const auto bytes = bench.tpdo();
  ASSERT_EQ(bytes.size(), 8u);
  EXPECT_EQ(bytes[2] | bytes[3] << 8, 1234);
  bench.bring_to(kEnabled);
  bench.command(0x0F, 100);
  EXPECT_NEAR(bench.slave.motor_torque(), -2.0, 1e-12) << "the motor turns against the joint";
  bench.velocity = -2.0 * M_PI * 77.0 / 10'000.0;
  bench.update();
  EXPECT_EQ(bench.read(0x606C), 77u);
  ASSERT_EQ(bench.write(0x607E, 0, 1, 0xE0), 0u);
  bench.update();
  EXPECT_EQ(bench.read(0x606C), static_cast<std::uint32_t>(-77));
  EXPECT_EQ(bench.read(0x6064), static_cast<std::uint32_t>(-1234));
  EXPECT_NEAR(bench.slave.motor_torque(), 2.0, 1e-12);
  EXPECT_EQ(bench.read(0x6077) & 0xFFFF, 100u) << "as the master sees it";
}

TEST(Cia402Slave, CounterWraps) {
  hal::DriveConfig config = slave_config();
  const double step = 2.0 * M_PI / 10'000.0;
  config.zero = -step * 2'147'483'648.0;  // at q = 0 the counter is beyond its greatest value by one
  SlaveBench bench(config);
  bench.position = -0.5 * step;
  bench.update();
  EXPECT_EQ(bench.read(0x6064), 0x7FFF'FFFFu);
  bench.position = 0.5 * step;
  bench.update();
  EXPECT_EQ(bench.read(0x6064), 0x8000'0000u);
}

TEST(Cia402Slave, EncoderFaultsAreReadNotFelt) {
  SlaveBench bench;
  bench.position = 1.0;
  bench.update();
  const std::uint32_t counts = bench.read(0x6064);
  bench.slave.set_encoder_fault(0.0, true);
  bench.position = 2.0;
  bench.update();
  EXPECT_EQ(bench.read(0x6064), counts);
  bench.slave.set_encoder_fault(2.0 * M_PI / 10'000.0 * 7.0, false);
  bench.position = 1.0;
  bench.update();
  EXPECT_EQ(bench.read(0x6064), counts + 7);
}

TEST(Cia402Slave, WithoutSupplyIsLimpThenBraked) {
  SlaveBench bench;
  bench.bring_to(kEnabled);
  bench.command(0x0F, 100);
  bench.slave.set_supply(false, bench.now_ns);
  bench.update();
  EXPECT_EQ(bench.slave.motor_torque(), 0.0);
  EXPECT_EQ(bench.slave.brake_torque(), 0.0);
  EXPECT_TRUE(bench.tpdo().empty());
  bench.wait(21.0);
  EXPECT_EQ(bench.slave.brake_torque(), 40.0);
  bench.slave.set_supply(true, bench.now_ns);
  bench.wait(51.0);
  const auto sent = bench.sent();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_TRUE(is(sent[0], 0x705, {0}));
  EXPECT_EQ(bench.slave.state(), kSwitchOnDisabled);
  EXPECT_EQ(bench.read(0x6060), 0u) << "all its parameters are gone";
}

}  // namespace
}  // namespace godobject::sim
