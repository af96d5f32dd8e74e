// CanDrives: when it uses the wire for heartbeats and SDO requests, and what it takes from other nodes.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "hal/cia402/can_drives.h"
#include "tests/hal/can_drives_bench.h"

namespace godobject::hal {
namespace {

/// Two buses: joint 0 as node 5 on the first; joint 1 as node 3 and the panel as node 32 on the second.
class TwoBusesTest : public testing::Test {
 protected:
  static constexpr int kHeartbeat = 20;  // cycles

  TwoBusesTest() {
    layout_.bus_count = 2;
    layout_.joint_count = 2;
    layout_.read_back_interval = 10e-3;
    layout_.drives[0] = {.bus = 0, .node = 5, .counts = 1000, .rated_torque = 2.0};
    layout_.drives[1] = {.bus = 1, .node = 3, .counts = 1000, .rated_torque = 2.0};
    layout_.panel = {.bus = 1, .node = 32};
  }

  struct Phases {
    int joint_0;  // cycle of its first heartbeat; -1: it has none
    int joint_1;
    int panel;
  };

  /// True if a node with this phase sends a heartbeat in cycle k.
  static bool beats(int phase, int k) { return phase >= 0 && k >= phase && (k - phase) % kHeartbeat == 0; }

  /// True in the two cycles before the next heartbeat of a node, in its cycle, and until it comes if it is overdue.
  static bool is_due(int phase, int k) {
    if (phase < 0 || k <= phase) return k > kHeartbeat - 3;
    return (k - phase - 1) % kHeartbeat + 1 > kHeartbeat - 3;
  }

  /// Runs cycles and returns those in which an SDO request was sent, for each bus. Nobody answers them.
  std::array<std::vector<int>, 2> requests(const Phases& phases, int cycles) {
    CanDrives drives(layout_, wires_, {});
    std::array<std::vector<int>, 2> found;
    for (int k = 0; k < cycles; ++k) {
      drives.request();
      for (std::size_t b = 0; b < 2; ++b) {
        for (const CanFrame& sent : buses_[b].take_sent()) {
          if (sent.id > 0x600 && sent.id < 0x680) found[b].push_back(k);
          EXPECT_TRUE(sent.id != 0x77F || k % kHeartbeat == 0);
        }
      }
      buses_[0].receive_next(tpdo(5, kOff, 0, 0));
      buses_[1].receive_next(tpdo(3, kOff, 0, 0));
      buses_[1].receive_next(frame(0x1A0, {0x03}));
      if (beats(phases.joint_0, k)) buses_[0].receive_next(frame(0x705, {0x05}));
      if (beats(phases.joint_1, k)) buses_[1].receive_next(frame(0x703, {0x05}));
      if (beats(phases.panel, k)) buses_[1].receive_next(frame(0x720, {0x05}));
      JointReading reading;
      drives.receive(reading);
      drives.send({});
    }
    return found;
  }

  /// The cycles by the rules: an interval after the last request, not in a cycle of the controller's heartbeat, nor
  /// where one of a node of this bus is due, unless it has waited for a period of heartbeats.
  std::vector<int> expected(const std::vector<int>& phases, int cycles) const {
    std::vector<int> found;
    int last = -1;
    for (int k = 0; k < cycles; ++k) {
      if (k % kHeartbeat == 0 || k - last < interval()) continue;
      bool due = false;
      for (const int phase : phases) due = due || is_due(phase, k);
      if (due && k - last < interval() + kHeartbeat) continue;
      found.push_back(k);
      last = k;
    }
    return found;
  }

  int interval() const { return static_cast<int>(std::lround(1e3 * layout_.read_back_interval)); }

  BusLayout layout_;
  std::array<FakeBus, 2> buses_;
  std::array<CanBus*, 2> wires_ = {&buses_[0], &buses_[1]};
};

TEST_F(TwoBusesTest, SdoRequestsKeepAwayFromTheHeartbeatsOfTheirBus) {
  for (int phase = 0; phase < kHeartbeat; ++phase) {
    const Phases phases{phase, (phase + 7) % kHeartbeat, (phase + 13) % kHeartbeat};
    const std::array<std::vector<int>, 2> found = requests(phases, 300);
    EXPECT_EQ(found[0], expected({phases.joint_0}, 300)) << phase;
    EXPECT_EQ(found[1], expected({phases.joint_1, phases.panel}, 300)) << phase;
    EXPECT_GT(found[0].size(), 12u);
    for (const int k : found[0]) {
      EXPECT_FALSE(k > phase && (beats(phase, k) || beats(phase, k + 1))) << k;  // before, nobody knows its phase
    }
  }
}

TEST_F(TwoBusesTest, SdoRequestsWaitAPeriodForOverdueHeartbeatsAndNotLonger) {
  const int interval = this->interval();
  const std::array<std::vector<int>, 2> found = requests({-1, -1, -1}, 200);
  EXPECT_EQ(found[0], expected({-1}, 200));
  EXPECT_EQ(found[1], expected({-1, -1}, 200));
  for (std::size_t i = 1; i < found[0].size(); ++i) {
    EXPECT_GE(found[0][i] - found[0][i - 1], interval + kHeartbeat);
    EXPECT_LE(found[0][i] - found[0][i - 1], interval + kHeartbeat + 1);
  }
  // a silent panel holds up its own bus only
  const std::array<std::vector<int>, 2> one = requests({3, 3, -1}, 200);
  EXPECT_EQ(one[0], expected({3}, 200));
  EXPECT_EQ(one[1], expected({3, -1}, 200));
}

TEST_F(TwoBusesTest, SevenJointsWaitForTheHeartbeatsOfTheirBusOnly) {
  layout_.joint_count = 7;
  layout_.panel.bus = -1;
  for (int i = 0; i < 7; ++i) {
    layout_.drives[static_cast<std::size_t>(i)] = {.bus = 0, .node = 10 + i, .counts = 1000, .rated_torque = 2.0};
  }
  CanDrives drives(layout_, wires_, {});
  std::vector<int> found;
  for (int k = 0; k < 200; ++k) {
    drives.request();
    for (const CanFrame& sent : buses_[0].take_sent()) {
      if (sent.id > 0x600 && sent.id < 0x680) found.push_back(k);
    }
    for (int i = 0; i < 7; ++i) {
      buses_[0].receive_next(tpdo(10 + i, kOff, 100 + i, 10));
      if (beats(5, k)) buses_[0].receive_next(frame(static_cast<std::uint16_t>(0x70A + i), {0x05}));
    }
    JointReading reading;
    drives.receive(reading);
    drives.send({});
  }
  EXPECT_EQ(found, expected({5}, 200));
}

/// A node that nobody has heard yet is due 18 cycles after the start: 17 cycles after it the wire is still free.
TEST_F(TwoBusesTest, SdoRequestsGoOutJustBeforeAHeartbeatIsDue) {
  for (const int interval : {17, 18, 19}) {
    layout_.read_back_interval = 1e-3 * interval;
    const std::array<std::vector<int>, 2> found = requests({-1, 19, 19}, 200);
    EXPECT_EQ(found[0], expected({-1}, 200)) << interval;
    EXPECT_EQ(found[1], expected({19, 19}, 200)) << interval;
    EXPECT_EQ(found[1].at(0) == interval - 1, interval < 19);
  }
}

/// Without a panel on it, a bus does not wait for the panel's heartbeats.
TEST_F(TwoBusesTest, ABusWaitsForItsOwnNodesOnly) {
  layout_.panel.bus = -1;
  const std::array<std::vector<int>, 2> found = requests({5, 11, -1}, 200);
  EXPECT_EQ(found[0], expected({5}, 200));
  EXPECT_EQ(found[1], expected({11}, 200));
}

/// At every place in the pattern of heartbeats and requests: behind a SYNC that has not returned nothing is queued.
TEST_F(TwoBusesTest, NothingIsQueuedOnABusThatHoldsWhateverIsDue) {
  for (int begin = 0; begin < 2 * kHeartbeat; ++begin) {
    CanDrives drives(layout_, wires_, {});
    JointReading reading;
    int others = 0;
    for (int k = 0; k < begin + CanDrives::kHeldCycles; ++k) {
      buses_[0].echoes = k < begin;
      for (FakeBus& bus : buses_) bus.take_sent();
      drives.request();
      drives.receive(reading);
      drives.send({});
      if (k > begin) {
        EXPECT_TRUE(buses_[0].sent.empty()) << begin << ' ' << k;
      }
      if (k > begin) others += static_cast<int>(buses_[1].sent.size());
    }
    EXPECT_GE(others, 2 * (CanDrives::kHeldCycles - 1)) << "the other bus goes on";
    for (FakeBus& bus : buses_) {
      bus.waiting.clear();
      bus.take_sent();
    }
  }
}

/// The first alarm of an object that was given frames of the second bus in one cycle.
TEST_F(TwoBusesTest, AlarmsNameTheirBus) {
  struct Row {
    CanFrame frame;
    Alarm alarm;
    int joint;
  };
  for (const Row& row :
       {Row{frame(0x703, {0x00}), Alarm::kNodeReset, 1}, Row{frame(0x720, {0x7F}), Alarm::kWrongMode, -1},
        Row{frame(0x283, {0x03}), Alarm::kWrongMode, 1},
        Row{frame(0x083, {0x50, 0x82, 1, 0, 0, 0, 0, 0}), Alarm::kDriveError, 1},
        Row{frame(0x0A0, {0x50, 0x82, 1, 0, 0, 0, 0, 0}), Alarm::kDriveError, -1},
        Row{frame(0x603, {0x40, 0, 0x10, 0, 0, 0, 0, 0}), Alarm::kForeignMaster, 1},
        Row{frame(0x603, {0x2F, 0, 0x10, 0, 0, 0, 0, 0}), Alarm::kForeignWrite, 1},
        Row{frame(0x000, {0x02, 0x03}), Alarm::kForeignWrite, 1}, Row{frame(0x080, {}), Alarm::kForeignMaster, -1},
        Row{frame(0x705, {0x00}), Alarm::kNone, -1}}) {
    CanDrives drives(layout_, wires_, {});
    drives.request();
    buses_[1].receive_next(row.frame);
    JointReading reading;
    drives.receive(reading);
    EXPECT_EQ(reading.alarm, row.alarm) << row.frame;
    EXPECT_EQ(reading.alarm_joint, row.joint) << row.frame;
    EXPECT_EQ(drives.alarm_detail().bus, row.alarm == Alarm::kNone ? -1 : 1) << row.frame;
  }
}

TEST_F(TwoBusesTest, AnAlarmOfMissingFramesNamesItsBus) {
  layout_.read_back_interval = 100e-3;  // nobody answers them
  const auto run = [this](int cycles, bool panel, bool heartbeats) {
    CanDrives drives(layout_, wires_, {});
    JointReading reading;
    for (int k = 0; k < cycles && reading.alarm == Alarm::kNone; ++k) {
      drives.request();
      if (panel) buses_[1].receive_next(frame(0x1A0, {0x03}));
      buses_[0].receive_next(frame(0x705, {0x05}));
      if (heartbeats) buses_[1].receive_next(frame(0x703, {0x05}));
      drives.receive(reading);
      drives.send({});
    }
    for (FakeBus& bus : buses_) bus.waiting.clear();
    return std::tuple(reading.alarm, reading.alarm_joint, drives.alarm_detail().bus);
  };
  EXPECT_EQ(run(60, true, true), std::tuple(Alarm::kNone, -1, -1));
  EXPECT_EQ(run(60, false, true), std::tuple(Alarm::kPanelSilent, -1, 1));
  EXPECT_EQ(run(60, true, false), std::tuple(Alarm::kHeartbeatLost, 1, 1));
  buses_[1].state.bus_off = true;
  EXPECT_EQ(run(1, true, true), std::tuple(Alarm::kBusDown, -1, 1));
  buses_[1].state.bus_off = false;
  buses_[1].result = SendResult::kDown;
  EXPECT_EQ(run(1, true, true), std::tuple(Alarm::kBusDown, -1, 1));
}

/// A SYNC is given up after ten cycles, and the next one as well; their echoes may come in the end.
TEST_F(CanDrivesTest, WaitsForEachLostEchoAsLong) {
  cycle(kOff);
  for (int loss = 0; loss < 3; ++loss) {
    bus_.echoes = false;
    cycle(kOff);
    bus_.echoes = true;
    for (int k = 1; k < 10; ++k) {
      drives_.request();
      EXPECT_TRUE(bus_.take_sent().empty()) << loss << ' ' << k;
      receive();
      drives_.send({});
      bus_.take_sent();
    }
    drives_.request();
    EXPECT_EQ(bus_.take_sent().at(0), frame(0x080, {}));
    bus_.receive_next(frame(0x080, {}), true);  // the echo that was given up
    answer_all(kOff);
    EXPECT_EQ(receive().age[0], 0u);
    drives_.send({});
    bus_.take_sent();
    cycle(kOff);
    EXPECT_EQ(reading_.age[0], 0u) << "in step";
  }
}

TEST_F(CanDrivesTest, EveryJointHasAModeAndAnEmergencyOfItsOwn) {
  constexpr std::array<int, 2> kNodes = {5, 3};
  for (int i = 0; i < 2; ++i) {
    const int node = kNodes.at(static_cast<std::size_t>(i));
    struct Row {
      CanFrame frame;
      Alarm alarm;
    };
    for (const Row& row :
         {Row{frame(static_cast<std::uint16_t>(0x280 + node), {0x08}), Alarm::kWrongMode},
          Row{frame(static_cast<std::uint16_t>(0x280 + node), {0xFF}), Alarm::kWrongMode},
          Row{frame(static_cast<std::uint16_t>(0x080 + node), {0x10, 0x23, 1, 0, 0, 0, 0, 0}), Alarm::kDriveError},
          Row{frame(static_cast<std::uint16_t>(0x700 + node), {0x00}), Alarm::kNodeReset}}) {
      FakeBus bus;
      const std::array<CanBus*, 1> wires = {&bus};
      CanDrives drives(layout(), wires, {});
      drives.request();
      bus.receive_next(row.frame);
      drives.receive(reading_);
      EXPECT_EQ(reading_.alarm, row.alarm) << row.frame;
      EXPECT_EQ(reading_.alarm_joint, i) << row.frame;
      EXPECT_EQ(drives.alarm_detail().bus, 0);
    }
  }
}

/// An emergency message of another length has no code; its sender has a problem nevertheless.
TEST_F(CanDrivesTest, AMalformedEmergencyIsAnAlarmWithoutACode) {
  EXPECT_EQ(alarm_of(frame(0x083, {0x10, 0x81, 0x11})), Alarm::kDriveError);
  EXPECT_EQ(reading_.alarm_joint, 1);
  EXPECT_EQ(drives_.alarm_detail().found, 0u);
  EXPECT_EQ(drives_.statistics().warnings, 0u);
}

/// An NMT command of two bytes names a node. One of another length names nobody, not even node 1.
TEST_F(CanDrivesTest, AForeignCommandNamesTheJointThatItIsFor) {
  BusLayout first = layout();
  first.drives[0].node = 1;
  for (const auto& [command, joint] :
       {std::pair(frame(0x000, {0x80, 0x01}), 0), std::pair(frame(0x000, {0x80, 0x03}), 1),
        std::pair(frame(0x000, {0x80, 0x20}), -1), std::pair(frame(0x000, {0x80, 0x00}), -1),
        std::pair(frame(0x000, {0x80}), -1), std::pair(frame(0x000, {0x80, 0x01, 0x00}), -1),
        std::pair(frame(0x000, {0x80, 0x03, 0x00, 0, 0, 0, 0, 0}), -1)}) {
    FakeBus bus;
    const std::array<CanBus*, 1> wires = {&bus};
    CanDrives drives(first, wires, {});
    drives.request();
    bus.receive_next(command);
    drives.receive(reading_);
    EXPECT_EQ(reading_.alarm, Alarm::kForeignWrite) << command;
    EXPECT_EQ(reading_.alarm_joint, joint) << command;
    EXPECT_EQ(drives.alarm_detail().id, 0);
    EXPECT_EQ(drives.alarm_detail().bus, 0);
  }
}

}  // namespace
}  // namespace godobject::hal
