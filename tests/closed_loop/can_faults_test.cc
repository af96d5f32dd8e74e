// The table of faults over the wire. Each fault is injected into the simulated buses while the ball is pressed on a
// plate and moved along it. The tests count the cycles of the reaction and record both for the report.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "tests/closed_loop/can_run.h"
#include "tests/closed_loop/seen_fault.h"
#include "tests/support/random.h"

namespace godobject::firmware {
namespace {

using hal::Alarm;
using sim::BusFault;
using sim::BusFaultKind;
using sim::DriveFault;
using sim::FaultKind;

constexpr std::int64_t kBegin = 2020;  ///< period of the fault
constexpr std::int64_t kForGood = 100'000;

/// Returns options with a path that goes down to the plate, 20 mm into it, and along the plate in circles.
CanRun::Options pressing() {
  const std::vector<Waypoint> waypoints{{0.0, {0.0, 0.0, 0.06}}, {0.4, {0.0, 0.0, 0.01}}};
  CanRun::Options options;
  options.path = path_through(waypoints);
  for (int k = 0; k < 2500; ++k) {
    const double angle = 2.0 * M_PI * k / 1200.0;
    options.path.push_back({0.02 * std::sin(angle), 0.02 - 0.02 * std::cos(angle), 0.01});
  }
  return options;
}

hal::CanFrame frame(int id, std::initializer_list<int> bytes) {
  hal::CanFrame frame;
  frame.id = static_cast<std::uint16_t>(id);
  for (const int byte : bytes) frame.data.at(frame.length++) = static_cast<std::uint8_t>(byte);
  return frame;
}

/// Returns torques and brakes of all drives as text.
std::string rest_of_arm(CanRun& run) {
  return rest_of(
      run.layout().joint_count, [&](int i) -> auto& { return run.device().nodes().drive(i); });
}

void start(CanRun& run) {
  const hal::BringUpResult result = run.bring_up();
  ASSERT_EQ(result.status, hal::BringUpStatus::kOk) << describe(result.status) << ' ' << result.node;
  run.run(kBegin - run.device().now_ns() / 1'000'000 - 1);
  ASSERT_EQ(run.cycles.back().record.fault, Fault::kNone) << describe(run.cycles.back().record.fault);
  ASSERT_GT(run.cycles.back().record.F_G_R.force.norm(), 2.0) << "the fault is to meet a contact";
  ASSERT_EQ(run.controller().counters().lost, 0u) << "those that the probe at the start leaves out do not count";
}

struct Row {
  std::string name;
  std::vector<BusFault> buses;
  std::vector<DriveFault> drives;
  std::set<Fault> faults;     ///< any of them
  std::set<Alarm> alarms;     ///< any of them; of Fault::kAlarm
  int most;                   ///< cycles, of the table
  bool temperatures = false;  ///< the drives' temperatures are read
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

class CanFault : public testing::TestWithParam<Row> {};

TEST_P(CanFault, StopsInTime) {
  const Row& row = GetParam();
  CanRun::Options options = pressing();
  options.bus_faults = row.buses;
  options.drive_faults = row.drives;
  options.temperatures = row.temperatures;
  CanRun run(plate(), options);
  start(run);
  run.run(std::max(row.most + 20, 750));
  const int cycles = run.cycles_to_stop(kBegin);
  EXPECT_GT(cycles, 0) << "never";
  EXPECT_LE(cycles, row.most);
  const CycleRecord& end = run.cycles.back().record;
  EXPECT_TRUE(row.faults.contains(end.fault)) << describe(end.fault) << " " << describe(end.alarm);
  if (end.fault == Fault::kAlarm) {
    EXPECT_TRUE(row.alarms.contains(end.alarm)) << describe(end.alarm);
  }
  for (const CanRun::Cycle& cycle : run.cycles) {
    if (cycle.number >= kBegin + cycles) {
      ASSERT_EQ(cycle.record.share, 0.0) << cycle.number;
    }
  }
  run.go_on_alone(0.6);
  for (int i = 0; i < run.layout().joint_count; ++i) {
    EXPECT_EQ(run.device().nodes().drive(i).motor_torque(), 0.0) << i;
    EXPECT_GT(run.device().nodes().drive(i).brake_torque(), 0.0) << i;
  }
  EXPECT_TRUE(run.plant().velocities().isZero(1e-6)) << "the brakes hold";
  test::SeenFault seen = seen_since(run.cycles, kBegin);
  seen.after += "; " + rest_of_arm(run);
  test::record(seen);
  std::printf("%-32s %4d cycles of %4d: %s\n", row.name.c_str(), cycles, row.most, seen.found.c_str());
}

/// The shoulder gives no torque at all, the worst limit: the arm falls until it stops.
TEST(CanLimited, AShoulderWithoutTorqueFallsLittleUntilTheStop) {
  CanRun::Options options = pressing();
  options.drive_faults = {{FaultKind::kTorqueLimited, 1, kBegin, kForGood, 0.0}};
  CanRun run(plate(), options);
  start(run);
  const Vector3 before = run.cycles.back().record.H_RM.translation;
  run.run(200);
  const int cycles = run.cycles_to_stop(kBegin);
  ASSERT_GT(cycles, 0);
  const auto at = [&](int k) {
    return run.cycles[run.cycles.size() - static_cast<std::size_t>(201 - k)].record.H_RM.translation;
  };
  const double until_stop = (at(cycles) - before).norm();
  double in_all = 0.0;
  for (int k = 1; k <= 200; ++k) in_all = std::max(in_all, (at(k) - before).norm());
  EXPECT_LT(until_stop, 0.03);
  std::printf(
      "[ measured ] a shoulder without torque: STOP after %d cycles, the tool has moved %.1f mm, %.1f mm in all: %s\n",
      cycles, 1e3 * until_stop, 1e3 * in_all, describe(run.cycles.back().record.fault));
}

BusFault bus_fault(BusFaultKind kind, int bus, std::int64_t cycles) {
  return {.kind = kind, .bus = bus, .first_cycle = kBegin, .cycles = cycles};
}
BusFault of_frames(BusFaultKind kind, int bus, int id, std::int64_t cycles, double value = 0.0) {
  BusFault fault = bus_fault(kind, bus, cycles);
  fault.id = static_cast<std::uint16_t>(id);
  fault.value = value;
  return fault;
}
BusFault replaced(int bus, int id, std::int64_t cycles, const hal::CanFrame& by) {
  BusFault fault = of_frames(BusFaultKind::kFrameReplaced, bus, id, cycles);
  fault.frame = by;
  return fault;
}
BusFault foreign(int bus, const hal::CanFrame& frame, double times = 1.0, std::int64_t cycles = 1) {
  BusFault fault = bus_fault(BusFaultKind::kForeignFrame, bus, cycles);
  fault.frame = frame;
  fault.value = times;
  return fault;
}
BusFault of_node(BusFaultKind kind, int bus, int node, std::int64_t cycles, double value = 0.0) {
  BusFault fault = bus_fault(kind, bus, cycles);
  fault.node = node;
  fault.value = value;
  return fault;
}
BusFault changed(int bus, int node, int index, int sub, double value) {
  BusFault fault = of_node(BusFaultKind::kParameterChanged, bus, node, 1, value);
  fault.index = static_cast<std::uint16_t>(index);
  fault.sub = static_cast<std::uint8_t>(sub);
  return fault;
}

BusFault refused_object(int bus, int node, int index) {
  BusFault fault = of_node(BusFaultKind::kSdoRefused, bus, node, kForGood, 0x06020000);
  fault.index = static_cast<std::uint16_t>(index);
  return fault;
}

using K = BusFaultKind;

INSTANTIATE_TEST_SUITE_P(
    Rows, CanFault,
    testing::Values(
        Row{"sample_lost_three_times", {of_frames(K::kFrameDropped, 0, 0x182, 3)}, {}, {Fault::kPositionLost}, {}, 8},
        Row{"sample_lost_for_good",
            {of_frames(K::kFrameDropped, 1, 0x185, kForGood)},
            {},
            {Fault::kPositionLost},
            {},
            8},
        Row{"sync_lost_for_good", {of_frames(K::kFrameDropped, 1, 0x080, kForGood)}, {}, {Fault::kPositionLost}, {}, 8},
        Row{"sample_always_late",
            {of_frames(K::kFrameDelayed, 0, 0x183, kForGood, 0.5)},
            {},
            {Fault::kPositionLost},
            {},
            8},
        Row{"wrong_length",
            {of_frames(K::kFrameLength, 0, 0x181, kForGood, 5.0)},
            {},
            {Fault::kAlarm, Fault::kPositionLost},
            {Alarm::kBadFrames},
            4},
        Row{"impossible_state",
            {replaced(1, 0x184, kForGood, frame(0x184, {0x6B, 0x12, 0, 0, 0, 0, 0, 0}))},
            {},
            {Fault::kAlarm, Fault::kPositionLost},
            {Alarm::kBadFrames},
            4},
        Row{"impossible_position",
            {replaced(1, 0x184, kForGood, frame(0x184, {0x37, 0x12, 0xFF, 0xFF, 0xFF, 0x7F, 0, 0}))},
            {},
            {Fault::kAlarm, Fault::kPositionJump, Fault::kPositionLost},
            {Alarm::kBadFrames},
            4},
        Row{"bus_off", {bus_fault(K::kBusOff, 1, kForGood)}, {}, {Fault::kAlarm}, {Alarm::kBusDown}, 2},
        Row{"interface_down", {bus_fault(K::kInterfaceDown, 2, kForGood)}, {}, {Fault::kAlarm}, {Alarm::kBusDown}, 2},
        Row{"transmit_queue_full",
            {bus_fault(K::kTransmitQueueFull, 0, kForGood)},
            {},
            {Fault::kSendFailed, Fault::kPositionLost},
            {},
            4},
        Row{"node_reset",
            {of_node(K::kNodeReset, 0, 2, 1)},
            {},
            {Fault::kAlarm, Fault::kPositionLost},
            {Alarm::kNodeReset, Alarm::kWrongMode},
            8},
        Row{"boot_up_frame", {foreign(0, frame(0x702, {0}))}, {}, {Fault::kAlarm}, {Alarm::kNodeReset}, 2},
        Row{"emergency_message",
            {of_node(K::kEmergency, 2, 6, 1, 0x4210)},
            {},
            {Fault::kAlarm},
            {Alarm::kDriveError},
            2},
        Row{"drive_trips",
            {},
            {{FaultKind::kDriveTrips, 4, kBegin, 1}},
            {Fault::kDriveLeft, Fault::kAlarm},
            {Alarm::kDriveError},
            2},
        Row{"drive_goes_off",
            {},
            {{FaultKind::kDriveDisabled, 1, kBegin, 1}},
            {Fault::kDriveLeft, Fault::kAlarm},
            {Alarm::kWrongMode},
            2},
        Row{"too_hot",
            {},
            {{FaultKind::kTemperature, 5, kBegin, kForGood, 85.0}},
            {Fault::kAlarm},
            {Alarm::kTooHot},
            1000,
            true},
        Row{"temperature_refused",
            {refused_object(1, 5, 0x2310)},
            {},
            {Fault::kAlarm},
            {Alarm::kTemperatureLost},
            3000,
            true},
        Row{"drive_limited",
            {},
            {{FaultKind::kTorqueLimited, 1, kBegin, kForGood, 30.0}},
            {Fault::kDriveLimited},
            {},
            52},
        Row{"mode_left",
            {changed(0, 1, 0x6060, 0, 0.0)},
            {},
            {Fault::kAlarm, Fault::kDriveLeft},
            {Alarm::kWrongMode},
            2},
        Row{"mode_left_bit_12_stays",
            {},
            {{FaultKind::kModeSlips, 2, kBegin, kForGood, 8.0}},
            {Fault::kAlarm},
            {Alarm::kWrongMode},
            2},
        Row{"supply_of_a_drive_lost",
            {},
            {{FaultKind::kSupplyLost, 3, kBegin, kForGood}},
            {Fault::kPositionLost, Fault::kDriveLeft},
            {},
            8},
        Row{"encoder_jumps_twice", {}, {{FaultKind::kEncoderJump, 3, kBegin, 2, 0.05}}, {Fault::kPositionJump}, {}, 3},
        Row{"encoder_stuck_elbow",
            {},
            {{FaultKind::kEncoderStuck, 3, kBegin, kForGood}},
            {Fault::kEncoderStuck},
            {},
            100},
        Row{"heartbeat_stops",
            {of_node(K::kHeartbeatStops, 1, 4, kForGood)},
            {},
            {Fault::kAlarm},
            {Alarm::kHeartbeatLost},
            52},
        Row{"torques_lost_on_the_wire",
            {of_frames(K::kFrameDropped, 2, 0x207, kForGood)},
            {},
            {Fault::kDriveLeft, Fault::kAlarm},
            {Alarm::kDriveError, Alarm::kWrongMode},
            10},
        Row{"second_master_sync", {foreign(0, frame(0x080, {}))}, {}, {Fault::kAlarm}, {Alarm::kForeignMaster}, 2},
        Row{"second_master_torque",
            {foreign(1, frame(0x204, {0x0F, 0, 0, 0}))},
            {},
            {Fault::kAlarm},
            {Alarm::kForeignMaster},
            2},
        Row{"foreign_nmt_stop",
            {foreign(1, frame(0x000, {0x02, 0x04}))},
            {},
            {Fault::kAlarm},
            {Alarm::kForeignWrite},
            2},
        Row{"foreign_sdo_write",
            {foreign(0, frame(0x601, {0x2B, 0x72, 0x60, 0, 0x10, 0, 0, 0}))},
            {},
            {Fault::kAlarm},
            {Alarm::kForeignWrite},
            2},
        Row{"parameter_changed_by_itself",
            {changed(1, 5, 0x1400, 5, 100.0)},
            {},
            {Fault::kAlarm},
            {Alarm::kParameterChanged},
            1000},
        Row{"emergency_stop",
            {},
            {{FaultKind::kEmergencyStop, sim::kAllJoints, kBegin, 20}},
            {Fault::kEmergencyStop},
            {},
            2},
        Row{"enable_switch_released",
            {},
            {{FaultKind::kEnableReleased, sim::kAllJoints, kBegin, 20}},
            {Fault::kEnableReleased},
            {},
            2},
        Row{"panel_lost",
            {of_frames(K::kFrameDropped, 2, 0x1A0, kForGood)},
            {},
            {Fault::kAlarm, Fault::kEmergencyStop},
            {Alarm::kPanelLost},
            4}),
    [](const testing::TestParamInfo<Row>& row) { return row.param.name; });

/// Returns the counters of losses and disturbances during a run as text.
std::string counted(CanRun& run) {
  const CycleCounters& cycles = run.controller().counters();
  const hal::CanStatistics& bus = run.drives().statistics();
  const auto sum = [](const auto& of_joints) {
    return std::accumulate(of_joints.begin(), of_joints.end(), std::uint64_t{0});
  };
  std::string text;
  const auto add = [&](const char* what, std::uint64_t count) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::string(what) + ' ' + std::to_string(count);
  };
  add("samples lost", sum(bus.lost));
  add("samples late", sum(bus.late));
  add("malformed", bus.malformed);
  add("floods", bus.floods);
  add("queue full", bus.full);
  add("jumps", cycles.jumps);
  add("sends failed", cycles.sends_failed);
  add("internal limit", cycles.limited);
  add("warm", cycles.warm);
  add("temperature not answered", cycles.temperature_lost);
  return text.empty() ? "nothing to count" : text;
}

/// Refused in 99 of each 100 of the 800 cycles: a temperature is read once in a second.
BusFault of_object_shortly(int bus, int node, int index) {
  BusFault fault = refused_object(bus, node, index);
  fault.cycles = 99;
  return fault;
}

class CanNuisance : public testing::TestWithParam<Row> {};

TEST_P(CanNuisance, IsGoneOnWith) {
  CanRun::Options options = pressing();
  options.temperatures = GetParam().temperatures;
  for (int i = 0; i < 8; ++i) {
    for (BusFault fault : GetParam().buses) {
      fault.first_cycle = kBegin + 100 * i;
      options.bus_faults.push_back(fault);
    }
    for (DriveFault fault : GetParam().drives) {
      fault.first_cycle = kBegin + 100 * i;
      options.drive_faults.push_back(fault);
    }
  }
  CanRun run(plate(), options);
  start(run);
  run.run(800);
  const CycleRecord& end = run.cycles.back().record;
  EXPECT_EQ(end.fault, Fault::kNone) << describe(end.fault) << ' ' << describe(end.alarm);
  EXPECT_EQ(end.share, 1.0);
  test::SeenFault seen = seen_since(run.cycles, kBegin);
  seen.found = counted(run);
  test::record(seen);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, CanNuisance,
    testing::Values(Row{"sample_lost_once", {of_frames(K::kFrameDropped, 0, 0x182, 1)}, {}, {}, {}, 0},
                    Row{"sample_lost_twice", {of_frames(K::kFrameDropped, 1, 0x185, 2)}, {}, {}, {}, 0},
                    Row{"sample_late_once", {of_frames(K::kFrameDelayed, 0, 0x183, 1, 0.5)}, {}, {}, {}, 0},
                    Row{"encoder_jumps_once", {}, {{FaultKind::kEncoderJump, 1, kBegin, 1, 0.05}}, {}, {}, 0},
                    Row{"sample_twice", {of_frames(K::kFrameDuplicated, 0, 0x183, 40)}, {}, {}, {}, 0},
                    Row{"samples_reordered", {of_frames(K::kFrameReordered, 0, 0x181, 40)}, {}, {}, {}, 0},
                    Row{"wrong_length_once", {of_frames(K::kFrameLength, 0, 0x181, 1, 3.0)}, {}, {}, {}, 0},
                    Row{"torque_lost_twice", {of_frames(K::kFrameDropped, 2, 0x206, 2)}, {}, {}, {}, 0},
                    Row{"panel_lost_twice", {of_frames(K::kFrameDropped, 2, 0x1A0, 2)}, {}, {}, {}, 0},
                    Row{"foreign_chatter", {foreign(1, frame(0x7A0, {1, 2, 3, 4}), 1.0, 40)}, {}, {}, {}, 0},
                    Row{"warm", {}, {{FaultKind::kTemperature, 5, kBegin, 1, 84.0}}, {}, {}, 0, true},
                    Row{"temperature_refused_shortly", {of_object_shortly(1, 5, 0x2310)}, {}, {}, {}, 0, true},
                    Row{"drive_limited_shortly", {}, {{FaultKind::kTorqueLimited, 1, kBegin, 10, 30.0}}, {}, {}, 0},
                    Row{"transmit_queue_full_once", {bus_fault(K::kTransmitQueueFull, 1, 1)}, {}, {}, {}, 0}),
    [](const testing::TestParamInfo<Row>& row) { return row.param.name; });

/// Starts the nodes and records the result: refused if it failed and no torque was sent.
hal::BringUpResult record_bring_up(CanRun& run) {
  const hal::BringUpResult result = run.bring_up();
  std::uint64_t commands = 0;
  for (int i = 0; i < run.layout().joint_count; ++i) commands += run.device().nodes().drive(i).commands();
  const bool refused = result.status != hal::BringUpStatus::kOk && commands == 0;
  test::record({.reaction = refused ? "REFUSE" : "goes on",
                .found = describe(result.status),
                .after = std::to_string(commands) + " torques sent, after " +
                         std::to_string(run.device().now_ns() / 1'000'000) + " ms",
                .cycles = -1});
  return result;
}

TEST(CanStart, WaitsForADriveThatBootsLate) {
  CanRun::Options options = pressing();
  options.drive_faults = {{FaultKind::kSupplyLost, 3, 0, 500}};
  CanRun run(plate(), options);
  EXPECT_EQ(record_bring_up(run).status, hal::BringUpStatus::kOk);
  EXPECT_GT(run.device().now_ns(), 550'000'000);
}

TEST(CanStart, RefusesADriveThatNeverBoots) {
  CanRun::Options options = pressing();
  options.drive_faults = {{FaultKind::kSupplyLost, 3, 0, kForGood}};
  CanRun run(plate(), options);
  const hal::BringUpResult result = record_bring_up(run);
  EXPECT_EQ(result.status, hal::BringUpStatus::kNoBootUp);
  EXPECT_EQ(result.joint, 3);
}

/// Notes the controlwords on the wires of the controller.
class ControlwordTap final : public hal::FrameTap {
 public:
  void on_frame(int, const hal::ReceivedFrame& received) noexcept override {
    const hal::CanFrame& frame = received.frame;
    const bool command = frame.id > 0x200 && frame.id < 0x280 && frame.length >= 2;
    const bool write = frame.id > 0x600 && frame.id < 0x680 && frame.data[1] == 0x40 && frame.data[2] == 0x60;
    if (received.own && (command || write)) ++count;
  }
  int count = 0;
};

/// Starts an arm of which the drives are spoilt before. It is refused without any controlword.
template <class Spoil>
hal::BringUpResult refused_identity(const Spoil& spoil) {
  CanRun run(plate(), pressing());
  ControlwordTap words;
  run.device().set_tap(&words);
  spoil(run.device().nodes());
  const hal::BringUpResult result = run.bring_up();
  run.go_on_alone(0.05);
  EXPECT_NE(result.status, hal::BringUpStatus::kOk);
  EXPECT_EQ(words.count, 0);
  for (int i = 0; i < run.layout().joint_count; ++i) {
    EXPECT_EQ(run.device().nodes().drive(i).commands(), 0u) << i;
    EXPECT_EQ(run.device().nodes().drive(i).state(), sim::PowerState::kSwitchOnDisabled) << i;
  }
  const bool refused = result.status != hal::BringUpStatus::kOk && words.count == 0;
  test::record({.reaction = refused ? "REFUSE" : "goes on",
                .found = describe(result.status),
                .after = std::to_string(words.count) + " controlwords sent, after " +
                         std::to_string(run.device().now_ns() / 1'000'000 - 50) + " ms",
                .cycles = -1});
  return result;
}

TEST(CanStart, RefusesEachPairOfSwappedDrivesWithoutAControlword) {
  for (int i = 0; i < 7; ++i) {
    for (int j = i + 1; j < 7; ++j) {
      const hal::BringUpResult result = refused_identity([&](sim::CanNodes& nodes) { nodes.swap_drives(i, j); });
      EXPECT_EQ(result.status, hal::BringUpStatus::kDrivesSwapped);
      EXPECT_EQ(result.joint, i);
      EXPECT_EQ(result.other_joint, j);
    }
  }
}

TEST(CanStart, RefusesADriveOfAnotherProductWithoutAControlword) {
  const hal::BringUpResult result =
      refused_identity([](sim::CanNodes& nodes) { nodes.drive(4).set_identity({.product = 2, .serial = 77}); });
  EXPECT_EQ(result.status, hal::BringUpStatus::kWrongDrive);
  EXPECT_EQ(result.joint, 4);
  EXPECT_EQ(result.subindex, 2);
  EXPECT_EQ(result.found, 2u);
}

/// The hazard without serial numbers: the start succeeds, and the arm gets power with two drives swapped.
TEST(CanStart, SwappedDrivesThatAreNotNamedGetPower) {
  CanRun::Options options = pressing();
  options.names_drives = false;
  CanRun run(plate(), options);
  run.device().nodes().swap_drives(0, 1);
  ASSERT_EQ(run.bring_up().status, hal::BringUpStatus::kOk);
  const JointVector before = run.plant().positions();
  run.run(2500);
  const JointVector moved = (run.plant().positions() - before).cwiseAbs();
  EXPECT_NE(run.cycles.back().record.fault, Fault::kNone);
  EXPECT_GT(moved.maxCoeff(), 0.02) << "found after a motion only";
  std::printf("[ measured ] swapped and not named: a joint moves by %.3f rad until: %s\n", moved.maxCoeff(),
              describe(run.cycles.back().record.fault));
}

struct Start {
  std::string name;
  BusFault fault;
  hal::BringUpStatus status;
};

void PrintTo(const Start& row, std::ostream* out) { *out << row.name; }

class CanStartFault : public testing::TestWithParam<Start> {};

TEST_P(CanStartFault, IsRefused) {
  CanRun::Options options = pressing();
  options.bus_faults = {GetParam().fault};
  options.bus_faults[0].first_cycle = 60;
  CanRun run(plate(), options);
  const hal::BringUpResult result = record_bring_up(run);
  EXPECT_EQ(result.status, GetParam().status) << describe(result.status);
  for (int i = 0; i < 7; ++i) EXPECT_EQ(run.device().nodes().drive(i).commands(), 0u) << "no torque was ever sent";
}

INSTANTIATE_TEST_SUITE_P(
    Rows, CanStartFault,
    testing::Values(
        Start{"second_master", foreign(1, frame(0x080, {}), 1.0, kForGood), hal::BringUpStatus::kSecondMaster},
        Start{"sdo_refused", of_node(K::kSdoRefused, 0, 2, kForGood, 0x06090030), hal::BringUpStatus::kRefused},
        Start{"interface_down", bus_fault(K::kInterfaceDown, 2, kForGood), hal::BringUpStatus::kBusDown},
        Start{"transmit_queue_full", bus_fault(K::kTransmitQueueFull, 0, kForGood), hal::BringUpStatus::kCannotSend}),
    [](const testing::TestParamInfo<Start>& row) { return row.param.name; });

/// Returns the largest change of the hand's force in a cycle, from the fault's period on [N].
double largest_force_step(const CanRun& run) {
  double largest = 0.0;
  for (std::size_t i = 1; i < run.cycles.size(); ++i) {
    if (run.cycles[i].number < kBegin) continue;
    const Vector3 step = run.cycles[i].record.F_G_R.force - run.cycles[i - 1].record.F_G_R.force;
    largest = std::max(largest, step.norm());
  }
  return largest;
}

/// Each sample is lost with a probability of 1 %. The seed is such that no joint loses three samples in a row.
TEST(CanLoop, GoesOnWithOneSampleInAHundredLostAtRandom) {
  CanRun plain(plate(), pressing());
  start(plain);
  plain.run(2000);
  CanRun::Options options = pressing();
  test::Random random(3);
  int lost = 0;
  for (int i = 0; i < 7; ++i) {
    const hal::DriveConfig& drive = plain.layout().drives[static_cast<std::size_t>(i)];
    int in_a_row = 0;
    for (int k = 0; k < 2000; ++k) {
      in_a_row = random.integer(0, 99) == 0 ? in_a_row + 1 : 0;
      ASSERT_LT(in_a_row, 3) << "another seed";
      if (in_a_row == 0) continue;
      ++lost;
      options.bus_faults.push_back(of_frames(K::kFrameDropped, drive.bus, 0x180 + drive.node, 1));
      options.bus_faults.back().first_cycle = kBegin + k;
    }
  }
  CanRun run(plate(), options);
  start(run);
  run.run(2000);
  const auto& of_joints = run.drives().statistics().lost;
  EXPECT_EQ(std::accumulate(of_joints.begin(), of_joints.end(), std::uint64_t{0}), static_cast<std::uint64_t>(lost));
  EXPECT_EQ(run.cycles.back().record.fault, Fault::kNone);
  EXPECT_EQ(run.cycles.back().record.share, 1.0);
  const double step = largest_force_step(run);
  const double without = largest_force_step(plain);
  EXPECT_LT(step, without + 0.1) << "a position that is predicted is off by less than 0.05 mm";
  double deviation = 0.0;
  for (std::size_t i = 0; i < run.cycles.size(); ++i) {
    const Vector3 off = run.cycles[i].record.F_G_R.force - plain.cycles[i].record.F_G_R.force;
    deviation = std::max(deviation, off.norm());
  }
  test::SeenFault seen = seen_since(run.cycles, kBegin);
  char text[160];
  std::snprintf(text, sizeof(text), "%s; force changes by %.3f N a cycle at most (%.3f N without), differs by %.3f N",
                counted(run).c_str(), step, without, deviation);
  seen.found = text;
  test::record(seen);
  std::printf("[ measured ] %s\n", text);
}

/// Frames that arrive twice or in another order change nothing: every cycle equals that of the undisturbed run.
class CanEcho : public testing::TestWithParam<Row> {};

TEST_P(CanEcho, ChangesNothing) {
  CanRun plain(plate(), pressing());
  start(plain);
  plain.run(500);
  CanRun::Options options = pressing();
  options.bus_faults = GetParam().buses;
  for (BusFault& fault : options.bus_faults) fault.cycles = 400;
  CanRun run(plate(), options);
  start(run);
  run.run(500);
  ASSERT_EQ(plain.cycles.size(), run.cycles.size());
  double velocity = 0.0;
  for (std::size_t i = 0; i < plain.cycles.size(); ++i) {
    velocity = std::max(velocity, (plain.cycles[i].record.qd - run.cycles[i].record.qd).cwiseAbs().maxCoeff());
    ASSERT_EQ(plain.cycles[i].record.torque, run.cycles[i].record.torque) << i;
  }
  EXPECT_EQ(velocity, 0.0);
  test::SeenFault seen = seen_since(run.cycles, kBegin);
  char text[80];
  std::snprintf(text, sizeof(text), "velocities differ by %g rad/s", velocity);
  seen.found = text;
  test::record(seen);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, CanEcho,
    testing::Values(Row{"samples_twice",
                        {of_frames(K::kFrameDuplicated, 0, 0x181, 1), of_frames(K::kFrameDuplicated, 1, 0x185, 1),
                         of_frames(K::kFrameDuplicated, 2, 0x187, 1)},
                        {},
                        {},
                        {},
                        0},
                    Row{"samples_reordered",
                        {of_frames(K::kFrameReordered, 0, 0x181, 1), of_frames(K::kFrameReordered, 1, 0x184, 1)},
                        {},
                        {},
                        {},
                        0}),
    [](const testing::TestParamInfo<Row>& row) { return row.param.name; });

/// More frames wait on a bus than a cycle may take. A burst does not end the run; an endless flood displaces samples.
TEST(CanFlood, OfABurstIsCountedAndGoneOnWith) {
  CanRun::Options options = pressing();
  options.flood = {.bus = 1, .first_cycle = kBegin, .cycles = 1, .frames = 90};
  CanRun run(plate(), options);
  start(run);
  run.run(500);
  EXPECT_EQ(run.drives().statistics().floods, 1u);
  EXPECT_LE(run.most_taken(), hal::CanDrives::kMostFrames);
  EXPECT_EQ(run.cycles.back().record.fault, Fault::kNone) << describe(run.cycles.back().record.fault);
  EXPECT_EQ(run.cycles.back().record.share, 1.0);
  test::SeenFault seen = seen_since(run.cycles, kBegin);
  seen.found = counted(run) + "; " + std::to_string(run.most_taken()) + " frames taken in a cycle at most";
  test::record(seen);
}

TEST(CanFlood, WithoutEndStopsInTime) {
  CanRun::Options options = pressing();
  options.flood = {.bus = 1, .first_cycle = kBegin, .cycles = kForGood, .frames = 300};
  CanRun run(plate(), options);
  start(run);
  run.run(750);
  EXPECT_GT(run.drives().statistics().floods, 500u);
  EXPECT_LE(run.most_taken(), hal::CanDrives::kMostFrames);
  EXPECT_LE(run.cycles_to_stop(kBegin), 8);
  EXPECT_GT(run.cycles_to_stop(kBegin), 0);
  for (std::size_t i = 1; i < run.cycles.size(); ++i) {
    ASSERT_EQ(run.cycles[i].number, run.cycles[i - 1].number + 1) << "no deadline is missed";
  }
  test::SeenFault seen = seen_since(run.cycles, kBegin);
  seen.found += "; " + std::to_string(run.most_taken()) + " frames taken in a cycle at most";
  seen.after += "; " + rest_of_arm(run);
  test::record(seen);
}

/// The temperatures of seven drives on three full buses are read for four seconds: no sample is lost or late, and
/// the last sample of a cycle comes no later than without them.
TEST(CanLoop, ReadsTemperaturesWithoutDelayingASample) {
  CanRun plain(plate(), pressing());
  start(plain);
  plain.run(4000);
  CanRun::Options options = pressing();
  options.temperatures = true;
  for (int i = 0; i < 7; ++i) {
    options.drive_faults.push_back({FaultKind::kTemperature, i, kBegin + 500 * i, 1, 50.0 + i});
  }
  CanRun run(plate(), options);
  start(run);
  run.run(4000);
  for (const CanRun::Cycle& cycle : run.cycles) {
    if (cycle.number >= kBegin) {
      ASSERT_EQ(cycle.record.lost, 0u) << cycle.number;
    }
  }
  EXPECT_EQ(counted(run), "nothing to count");
  EXPECT_EQ(run.drives().statistics().hottest_joint, 6);
  EXPECT_NEAR(run.drives().statistics().hottest, 56.0, 1e-9);
  EXPECT_EQ(run.drives().statistics().longest_round_trip_ns, plain.drives().statistics().longest_round_trip_ns);
}

/// The clock that stamps the frames is set during the run.
TEST(CanLoop, DoesNotFeelAClockThatIsSet) {
  CanRun plain(plate(), pressing());
  start(plain);
  plain.run(500);
  for (const double hours : {1.0, -1.0}) {
    CanRun::Options options = pressing();
    options.clock_set = {.first_cycle = kBegin, .step_ns = static_cast<std::int64_t>(hours * 3600e9)};
    CanRun run(plate(), options);
    start(run);
    run.run(500);
    ASSERT_EQ(plain.cycles.size(), run.cycles.size());
    for (std::size_t i = 0; i < plain.cycles.size(); ++i) {
      ASSERT_EQ(plain.cycles[i].record.torque, run.cycles[i].record.torque) << hours << " h, " << i;
    }
    if (hours < 0.0) {
      test::SeenFault seen = seen_since(run.cycles, kBegin);
      seen.found = "torques of every cycle as without";
      test::record(seen);
    }
  }
}

TEST(CanLoop, DoesNotFeelACounterThatWraps) {
  CanRun plain(plate(), pressing());
  start(plain);
  CanRun::Options options = pressing();
  // the counter of joint 2 wraps at a position shortly after the joint's start
  options.zero = -0.5 - 1e-3 - 2.0 * M_PI / (1 << 20) * 2'147'483'648.0;
  CanRun wrapped(plate(), options);
  start(wrapped);
  ASSERT_EQ(plain.cycles.size(), wrapped.cycles.size());
  double least = 1e9;
  double most = -1e9;
  for (std::size_t i = 0; i < plain.cycles.size(); ++i) {
    const double q = wrapped.cycles[i].record.q[1];
    ASSERT_NEAR(plain.cycles[i].record.q[1], q, 1e-3) << i;
    least = std::min(least, q);
    most = std::max(most, q);
  }
  EXPECT_LT(least, -0.5 - 2e-3);
  EXPECT_GT(most, -0.5 - 5e-4) << "it is to pass the wrap";
  test::SeenFault seen = seen_since(wrapped.cycles, kBegin - 100);
  seen.found = counted(wrapped);
  test::record(seen);
}

/// Advances without the controller. Returns the number of cycles until no drive is enabled; 0: not within `most`.
int cycles_until_off(CanRun& run, int most) {
  const std::int64_t begin_ns = run.device().now_ns();
  const auto enabled = [&](int i) { return run.device().nodes().drive(i).state() == sim::PowerState::kEnabled; };
  for (std::int64_t ns = 0; ns <= 1'000'000 * most; ns += 10'000) {
    run.device().advance_to(begin_ns + ns);
    bool any = false;
    for (int i = 0; i < run.layout().joint_count; ++i) any = any || enabled(i);
    if (!any) return static_cast<int>((ns + 999'999) / 1'000'000);
  }
  return 0;
}

/// SIGKILL at an instant of a cycle: every drive stops by itself and ends without torque, with its brake closed.
TEST(CanLoop, DrivesStopThemselvesWhenTheControllerIsKilled) {
  test::Random random(11);
  CanRun run(plate(), pressing());
  start(run);
  const std::int64_t begin_ns = (run.device().now_ns() / 1'000'000 + 1) * 1'000'000;
  run.device().advance_to(begin_ns);
  run.drives().request();
  run.device().advance_to(begin_ns + random.integer(0, 999'999));
  const int cycles = cycles_until_off(run, 20);
  EXPECT_GT(cycles, 0);
  EXPECT_LE(cycles, 1 + std::llround(1e3 * run.layout().command_deadline));
  run.go_on_alone(0.6);
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(run.device().nodes().drive(i).motor_torque(), 0.0);
    EXPECT_GT(run.device().nodes().drive(i).brake_torque(), 0.0);
  }
  EXPECT_TRUE(run.plant().velocities().isZero(1e-6));
  test::record({.reaction = cycles > 0 ? "DRIVE" : "none",
                .found = "drives stop by themselves",
                .after = rest_of_arm(run),
                .cycles = cycles});
}

/// SIGSTOP, and SIGCONT 50 ms later: the drives have stopped and are not enabled again.
TEST(CanLoop, DrivesStopThemselvesInAPauseAndStayWithoutPower) {
  CanRun run(plate(), pressing());
  start(run);
  const int cycles = cycles_until_off(run, 20);
  EXPECT_GT(cycles, 0);
  EXPECT_LE(cycles, 10);
  run.go_on_alone(0.05 - 1e-3 * cycles);
  run.run(1, {.overrun_ns = 49'000'000, .skipped = 49});
  for (int k = 0; k < 700; ++k) {
    run.run(1);
    for (int i = 0; i < 7; ++i) ASSERT_NE(run.device().nodes().drive(i).state(), sim::PowerState::kEnabled) << k;
  }
  const test::SeenFault seen = seen_since(run.cycles, kBegin + 2);
  test::record({.reaction = cycles > 0 ? "DRIVE" : "none",
                .found = "drives stop by themselves; then " + seen.reaction + ": " + seen.found,
                .after = seen.after + "; " + rest_of_arm(run),
                .cycles = cycles});
}

/// The controller cannot send a quick stop to the drives of a dead bus.
TEST(CanLoop, DrivesOnADeadBusStopThemselves) {
  CanRun::Options options = pressing();
  options.bus_faults = {bus_fault(K::kBusOff, 1, kForGood)};
  CanRun run(plate(), options);
  start(run);
  int cycles = 0;
  bool enabled = true;
  while (enabled && cycles < 20) {
    run.run(1);
    ++cycles;
    enabled = false;
    for (int i = 0; i < 7; ++i) {
      const bool on_it = run.layout().drives[static_cast<std::size_t>(i)].bus == 1;
      enabled = enabled || (on_it && run.device().nodes().drive(i).state() == sim::PowerState::kEnabled);
    }
  }
  EXPECT_FALSE(enabled);
  EXPECT_LE(cycles, 10);
  run.go_on_alone(0.6);
  test::record({.reaction = enabled ? "none" : "DRIVE",
                .found = "drives on the bus stop by themselves",
                .after = rest_of_arm(run),
                .cycles = cycles});
}

}  // namespace
}  // namespace godobject::firmware
