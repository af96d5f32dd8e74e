// CanDrives: what it counts, what a start forgets, and its first cycles.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "hal/cia402/can_drives.h"
#include "tests/hal/can_drives_bench.h"
#include "tests/support/random.h"

namespace godobject::hal {
namespace {

class CanDrivesCountsTest : public CanDrivesTest {
 protected:
  /// A cycle in which only these frames come.
  void cycle_of(const std::vector<CanFrame>& frames) {
    drives_.request();
    for (const CanFrame& frame : frames) bus_.receive_next(frame);
    receive();
    drives_.send({});
    bus_.take_sent();
  }

  const CanStatistics& counts() const { return drives_.statistics(); }
};

TEST_F(CanDrivesCountsTest, FramesHandedOverAndReceived) {
  for (std::uint64_t k = 1; k <= 10; ++k) {
    cycle(kOff);
    EXPECT_EQ(counts().sent, 3 * k + 1) << "SYNC, two torques; one heartbeat";
    EXPECT_EQ(counts().received, 3 * k);
  }
  cycle_of({frame(0x7FF, {1}), frame(0x080 + 4, {})});
  EXPECT_EQ(counts().received, 32u) << "of other nodes, too";
  EXPECT_EQ(counts().full + counts().down + counts().malformed + counts().floods + counts().warnings, 0u);
  bus_.result = SendResult::kDown;
  drives_.request();
  drives_.send({});
  EXPECT_EQ(counts().down, 3u);
  EXPECT_EQ(counts().sent, 34u);
}

TEST_F(CanDrivesCountsTest, RefusedFramesByTheirReason) {
  cycle(kOff);
  drives_.request();
  bus_.result = SendResult::kDown;
  receive();
  EXPECT_FALSE(drives_.send({}));
  EXPECT_EQ(counts().down, 2u);
  EXPECT_EQ(counts().full, 0u);
  EXPECT_EQ(counts().sent, 4u + 1u);
  bus_.result = SendResult::kSent;
  EXPECT_EQ(receive().alarm, Alarm::kBusDown);
  EXPECT_EQ(drives_.alarm_detail().bus, 0);
}

TEST_F(CanDrivesCountsTest, EveryKindOfMalformedFrame) {
  cycle(kOff);
  const std::vector<CanFrame> malformed = {
      frame(0x185, {0x50, 0x02, 0, 0, 0, 0, 0}),  // a sample of seven bytes
      frame(0x1A0, {0x03, 0x03}),                 // inputs of two bytes
      frame(0x1A0, {}),
      frame(0x285, {}),            // a mode without a byte
      frame(0x705, {0x01}),        // a heartbeat with a state that CiA 301 does not have
      frame(0x705, {0x05, 0x00}),  // and one of two bytes
      frame(0x720, {}),
      frame(0x585, {0x43, 0, 0, 0}),  // an SDO response of four bytes
  };
  std::uint64_t count = 0;
  for (const CanFrame& one : malformed) {
    cycle_of({one, tpdo(3, kOff, 0, 0)});
    EXPECT_EQ(counts().malformed, ++count) << one;
    cycle(kOff);
  }
  cycle_of({frame(0x181, {1}), frame(0x701, {0x01}), frame(0x581, {1})});
  EXPECT_EQ(counts().malformed, count) << "of nodes that are not ours";
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
}

TEST_F(CanDrivesCountsTest, Warnings) {
  cycle(kOff);
  for (std::uint64_t k = 1; k <= 3; ++k) {
    cycle_of({tpdo(5, kOff, 0, 0), frame(0x085, {0x10, 0x81, 0, 0, 0, 0, 0, 0})});
    EXPECT_EQ(counts().warnings, k);
  }
}

TEST_F(CanDrivesCountsTest, LostAndLateSamplesOfEachJoint) {
  cycle(kOff);
  for (int k = 0; k < 4; ++k) cycle_of({tpdo(3, kOff, 0, 0)});
  EXPECT_EQ(counts().lost[0], 4u);
  EXPECT_EQ(counts().lost[1], 0u);
  bus_.receive_next(tpdo(3, kOff, 0, 0));  // in front of the echo
  bus_.receive_next(tpdo(3, kOff, 0, 0));
  bus_.receive_next(tpdo(5, kOff, 0, 0));
  cycle_of({tpdo(3, kOff, 0, 0)});
  EXPECT_EQ(counts().late[0], 1u);
  EXPECT_EQ(counts().late[1], 2u);
  EXPECT_EQ(counts().lost[0], 5u);
  EXPECT_EQ(counts().lost[1], 0u);
}

// FakeBus stamps frames 0.1 ms apart, the echo first.
TEST_F(CanDrivesCountsTest, RoundTripIsFromTheEchoToTheLastSample) {
  cycle_of({tpdo(5, kOff, 0, 0), frame(0x7FF, {}), tpdo(3, kOff, 0, 0), frame(0x7FF, {})});
  EXPECT_EQ(counts().round_trip_ns, 400'000) << "echo, heartbeat, sample, another frame, sample";
  cycle_of({tpdo(5, kOff, 0, 0)});
  EXPECT_EQ(counts().round_trip_ns, 100'000);
  EXPECT_EQ(counts().longest_round_trip_ns, 400'000);
  cycle_of({frame(0x1A0, {0x03}), frame(0x7FF, {})});
  EXPECT_EQ(counts().round_trip_ns, 100'000) << "the panel answers as well";
  cycle_of({frame(0x7FF, {})});
  EXPECT_EQ(counts().round_trip_ns, 0) << "none";
  EXPECT_EQ(counts().longest_round_trip_ns, 400'000);
  cycle_of({});
  EXPECT_EQ(counts().round_trip_ns, 0);
  cycle_of({tpdo(5, kOff, 0, 0)});
  bus_.echoes = false;
  cycle_of({tpdo(5, kOff, 0, 0)});
  EXPECT_EQ(counts().round_trip_ns, 0) << "of this cycle, not of the one before";
}

TEST_F(CanDrivesCountsTest, ARoundTripNeedsTimeStamps) {
  bus_.time_ns = -100'000;  // the echo has none: 0
  cycle_of({tpdo(5, kOff, 0, 0), tpdo(3, kOff, 0, 0)});
  EXPECT_EQ(reading_.age[0], 0u);
  EXPECT_EQ(counts().round_trip_ns, 0);
  bus_.time_ns = -99'999;
  cycle_of({tpdo(5, kOff, 0, 0)});
  EXPECT_EQ(counts().round_trip_ns, 100'000);
}

// ---------------------------------------------------------------- a start

TEST_F(CanDrivesCountsTest, NothingIsLostDuringTheProbeOfAStart) {
  SleepingClock clock;
  EXPECT_EQ(drives_.bring_up(clock).status, BringUpStatus::kNoBootUp);
  bus_.waiting.clear();
  for (int k = 0; k < CanDrives::kProbeCycles; ++k) {
    drives_.request();
    receive();
    EXPECT_TRUE(drives_.send({})) << "a SYNC that is not sent is no failure";
    EXPECT_EQ(counts().lost[0], 0u);
    EXPECT_EQ(reading_.alarm, Alarm::kNone) << "nor is the panel silent";
    EXPECT_EQ(reading_.state[0], DriveState::kUnavailable);
  }
  for (std::uint64_t k = 1; k <= 3; ++k) {
    drives_.request();
    receive();
    drives_.send({});
    EXPECT_EQ(counts().lost[0], k);
    EXPECT_EQ(reading_.alarm, k < 3 ? Alarm::kNone : Alarm::kPanelSilent);
  }
}

/// After the last of some SYNCs no sample may arrive: one in any of the silent cycles is of a drive that is late.
TEST_F(CanDrivesCountsTest, ASampleInAnySilentCycleOfTheProbeIsOfALateDrive) {
  for (int stray = 0; stray < CanDrives::kProbeCycles; ++stray) {
    SleepingClock clock;
    EXPECT_EQ(drives_.bring_up(clock).status, BringUpStatus::kNoBootUp);
    bus_.waiting.clear();
    for (int k = 0; k < CanDrives::kProbeCycles; ++k) {
      drives_.request();
      if (k == stray) bus_.receive_next(tpdo(3, kOff, 0, 0));
      receive();
      drives_.send({});
    }
    const bool silent = stray >= 4;  // of eight
    EXPECT_EQ(reading_.alarm, silent ? Alarm::kAnswersLate : Alarm::kNone) << stray;
    EXPECT_EQ(reading_.alarm_joint, silent ? 1 : -1);
    EXPECT_EQ(drives_.alarm_detail().id, silent ? 0x183 : 0);
  }
}

TEST_F(CanDrivesCountsTest, ASecondMasterThatComesAfterTheResetKeepsItsNodes) {
  SleepingClock clock;
  clock.each_sleep = [this](std::int64_t now_ns) {
    if (now_ns == 200'000'000) bus_.receive_next(frame(0x080, {}));
  };
  const BringUpResult result = drives_.bring_up(clock);
  EXPECT_EQ(result.status, BringUpStatus::kSecondMaster);
  EXPECT_TRUE(result.began);
  bus_.take_sent();
  drives_.stop_nodes();
  EXPECT_TRUE(bus_.sent.empty());
}

/// Random frames of the nodes, good and bad ones, and commands. With the same seed two objects get the same.
class Traffic {
 public:
  explicit Traffic(unsigned seed) : random_(seed) {}

  JointReading cycle(CanDrives& drives, FakeBus& bus) {
    drives.request();
    for (int k = random_.integer(0, 6); k > 0; --k) bus.receive_next(next());
    JointReading reading;
    drives.receive(reading);
    JointCommand command;
    command.power = static_cast<PowerRequest>(random_.integer(0, 3));
    command.torque[0] = random_.between(-30.0, 30.0);
    command.torque[1] = random_.between(-5.0, 5.0);
    drives.send(command);
    return reading;
  }

 private:
  CanFrame next() {
    constexpr std::array<int, 5> kWords = {kOff, kReady, kEnabled, kBrakeOpens, kFault};
    const int word = kWords.at(static_cast<std::size_t>(random_.integer(0, 4)));
    const int node = random_.integer(0, 1) == 0 ? 5 : 3;
    switch (random_.integer(0, 9)) {
      case 0: return frame(0x1A0, {random_.integer(0, 7)});
      case 1: return frame(static_cast<std::uint16_t>(0x700 + node), {0x05});
      case 2: return frame(static_cast<std::uint16_t>(0x280 + node), {random_.integer(9, 10)});
      case 3: return frame(static_cast<std::uint16_t>(0x180 + node), {0x50, 0x02});
      case 4: return frame(static_cast<std::uint16_t>(0x080 + node), {0x10, 0x81, 0, 0, 0, 0, 0, 0});
      default:
        return tpdo(node, word, random_.integer(-5000, 5000), static_cast<std::int16_t>(random_.integer(-900, 900)));
    }
  }

  test::Random random_;
};

/// Two objects: one has a past, with alarms that last, a joint whose torques are withheld and a reset that goes on.
/// After a start they behave in the same way.
TEST_F(CanDrivesCountsTest, AStartForgetsAllThatWasBefore) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    FakeBus other;
    const std::array<CanBus*, 1> others = {&other};
    CanDrives fresh(layout(), others, {});
    Traffic past(seed);
    for (int k = 0; k < 45 + static_cast<int>(seed); ++k) past.cycle(drives_, bus_);
    alarm_of(frame(0x705, {0x00}));
    drives_.withhold(static_cast<int>(seed % 2));
    drives_.send({JointVector::Zero(), PowerRequest::kReset});
    const auto start = [](CanDrives& drives, FakeBus& bus) {
      SleepingClock clock;
      bus.echoes = true;
      bus.waiting.clear();
      EXPECT_EQ(drives.bring_up(clock).status, BringUpStatus::kNoBootUp);
      bus.take_sent();
      bus.waiting.clear();
      bus.time_ns = 0;
    };
    start(drives_, bus_);
    start(fresh, other);
    Traffic one(100 + seed);
    Traffic two(100 + seed);
    for (int k = 0; k < 60; ++k) {
      const JointReading a = one.cycle(drives_, bus_);
      const JointReading b = two.cycle(fresh, other);
      ASSERT_EQ(a.position, b.position) << k;
      ASSERT_EQ(a.torque, b.torque);
      ASSERT_EQ(a.age, b.age);
      ASSERT_EQ(a.state, b.state);
      ASSERT_EQ(a.emergency_stop, b.emergency_stop);
      ASSERT_EQ(a.enable_switch, b.enable_switch);
      ASSERT_EQ(a.clutch_open, b.clutch_open);
      ASSERT_EQ(a.alarm, b.alarm) << k;
      ASSERT_EQ(a.alarm_joint, b.alarm_joint);
      ASSERT_EQ(bus_.take_sent(), other.take_sent()) << k;
    }
    const CanStatistics& a = drives_.statistics();
    const CanStatistics& b = fresh.statistics();
    EXPECT_EQ(a.sent, b.sent);
    EXPECT_EQ(a.received, b.received);
    EXPECT_EQ(a.malformed, b.malformed);
    EXPECT_EQ(a.warnings, b.warnings);
    EXPECT_EQ(a.lost, b.lost);
    EXPECT_EQ(a.late, b.late);
    EXPECT_EQ(a.longest_round_trip_ns, b.longest_round_trip_ns);
  }
}

/// Power requests are levels; the first one after a start begins, whatever the last one before it was.
TEST_F(CanDrivesCountsTest, AResetMayBeTheFirstRequestAfterAStart) {
  cycle(kOff, PowerRequest::kReset);
  SleepingClock clock;
  EXPECT_EQ(drives_.bring_up(clock).status, BringUpStatus::kNoBootUp);
  bus_.waiting.clear();
  bus_.take_sent();
  bus_.receive_next(frame(0x083, {0x10, 0x23, 1, 0, 0, 0, 0, 0}));
  cycle(kOff, PowerRequest::kReset);
  EXPECT_EQ(reading_.alarm, Alarm::kDriveError);
  cycle(kOff, PowerRequest::kReset);
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
}

// ---------------------------------------------------------------- the first cycles

TEST_F(CanDrivesCountsTest, ASampleThatNobodyAskedForIsLate) {
  answer_all(kEnabled);
  receive();
  EXPECT_EQ(reading_.state[0], DriveState::kUnavailable);
  EXPECT_EQ(reading_.age[0], 1u);
  EXPECT_EQ(counts().late[0], 1u);
  EXPECT_EQ(counts().lost[0], 1u);
  EXPECT_TRUE(reading_.emergency_stop);
  EXPECT_TRUE(drives_.send({})) << "no SYNC has failed";
}

TEST_F(CanDrivesCountsTest, TheFirstThreeBadFramesAreAnAlarm) {
  for (int k = 1; k <= 3; ++k) {
    cycle_of({frame(0x185, {0x50, 0x02}), tpdo(3, kOff, 0, 0), frame(0x1A0, {0x03})});
    EXPECT_EQ(reading_.alarm, k < 3 ? Alarm::kNone : Alarm::kBadFrames);
  }
}

/// A drive that never sends a heartbeat is found one timeout after the first cycle, as one that stops sending.
TEST_F(CanDrivesCountsTest, AHeartbeatThatNeverCameIsMissedAfterItsTimeout) {
  for (int k = 1; k <= 52; ++k) {
    drives_.request();
    bus_.receive_next(frame(0x705, {0x05}));
    answer_all(kOff);
    receive();
    EXPECT_EQ(reading_.alarm, k < 52 ? Alarm::kNone : Alarm::kHeartbeatLost) << k;
    drives_.send({});
  }
  EXPECT_EQ(reading_.alarm_joint, 1);
}

TEST_F(CanDrivesCountsTest, TimesShorterThanACycleCountAsOne) {
  BusLayout fast = layout();
  fast.drive_heartbeat = 0.1e-3;
  fast.heartbeat_timeout = 0.1e-3;
  CanDrives drives(fast, wires_, {});
  for (int k = 0; k < 5; ++k) {
    drives.request();
    EXPECT_EQ(bus_.take_sent(), (std::vector<CanFrame>{frame(0x080, {}), frame(0x77F, {0x05})})) << "in each cycle";
    if (k < 3) answer_all(kOff);
    drives.receive(reading_);
    EXPECT_EQ(reading_.state[0], k < 4 ? DriveState::kOff : DriveState::kUnavailable) << k;
    drives.send({});
    bus_.take_sent();
  }
}

/// Lost cycles of the panel count in a row only.
TEST_F(CanDrivesCountsTest, APanelThatAnswersEveryThirdCycleIsNotLost) {
  for (int k = 0; k < 30; ++k) {
    std::vector<CanFrame> frames = {tpdo(5, kOff, 0, 0), tpdo(3, kOff, 0, 0)};
    if (k % 20 == 0) frames.insert(frames.end(), {frame(0x705, {0x05}), frame(0x703, {0x05})});
    if (k % 3 == 0) frames.push_back(frame(0x1A0, {0x03}));
    cycle_of(frames);
    EXPECT_EQ(reading_.alarm, Alarm::kNone) << k;
    EXPECT_TRUE(reading_.enable_switch) << k;
  }
}

/// A joint without a fresh sample keeps its last values, also over the beginning of a reset.
TEST(CanDrivesOfSevenJoints, KeepTheirValuesOverAReset) {
  BusLayout layout;
  layout.joint_count = 7;
  for (int i = 0; i < 7; ++i) {
    layout.drives[static_cast<std::size_t>(i)] = {.node = i + 1, .counts = 1000, .rated_torque = 1.0};
  }
  layout.panel = {.bus = 0, .node = 32};
  FakeBus bus;
  const std::array<CanBus*, 1> wires = {&bus};
  CanDrives drives(layout, wires, {});
  JointReading reading;
  for (int k = 0; k < 4; ++k) {
    drives.request();
    if (k == 0) {
      for (int i = 0; i < 7; ++i) bus.receive_next(tpdo(i + 1, kFault, 100 + i, static_cast<std::int16_t>(10 + i)));
    }
    bus.receive_next(frame(0x1A0, {0x07}));
    drives.receive(reading);
    for (int i = 0; i < 7; ++i) {
      EXPECT_DOUBLE_EQ(reading.position[i], 2.0 * M_PI / 1000 * (100 + i)) << k;
      EXPECT_DOUBLE_EQ(reading.torque[i], 0.001 * (10 + i));
      EXPECT_EQ(reading.state[static_cast<std::size_t>(i)], DriveState::kFault);
      EXPECT_EQ(reading.age[static_cast<std::size_t>(i)], static_cast<std::uint32_t>(k));
    }
    EXPECT_TRUE(reading.enable_switch && reading.clutch_open && !reading.emergency_stop);
    drives.send({JointVector::Zero(), k == 1 ? PowerRequest::kReset : PowerRequest::kOff});
  }
}

}  // namespace
}  // namespace godobject::hal
