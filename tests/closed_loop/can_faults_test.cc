// The table of faults over the wire: each is put on the simulated buses while the ball is pressed on a plate and moved
// along; reaction and cycles are counted. With GODOBJECT_FAULT_TABLE=FILE in the environment they are written there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "tests/closed_loop/can_run.h"
#include "tests/support/random.h"
#include "tests/support/small_scenes.h"

namespace godobject::firmware {
namespace {

using hal::Alarm;
using sim::BusFault;
using sim::BusFaultKind;
using sim::DriveFault;
using sim::FaultKind;

constexpr std::int64_t kBegin = 1720;  ///< period of the fault
constexpr std::int64_t kForGood = 100'000;

const test::SceneImage& plate() {
  static const test::SceneImage image = test::ball_over_plate();
  return image;
}

/// Down on the plate, 20 mm into it, and along in circles.
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

void write_row(const std::string& injected, const std::string& seen, int cycles, int most) {
  const char* file = std::getenv("GODOBJECT_FAULT_TABLE");
  if (file == nullptr) return;
  const bool fresh = !std::ifstream(file).good();
  std::ofstream table(file, std::ios::app);
  if (fresh) table << "injected,seen,cycles,at_most\n";
  std::string what = seen.substr(0, seen.find(';'));
  std::replace(what.begin(), what.end(), ',', ' ');
  table << injected << ',' << what << ',' << cycles << ',' << most << '\n';
}

void start(CanRun& run) {
  const hal::BringUpResult result = run.bring_up();
  ASSERT_EQ(result.status, hal::BringUpStatus::kOk) << describe(result.status) << ' ' << result.node;
  run.run(kBegin - run.device().now_ns() / 1'000'000 - 1);
  ASSERT_EQ(run.cycles.back().record.fault, Fault::kNone) << describe(run.cycles.back().record.fault);
  ASSERT_GT(run.cycles.back().record.wrench_R.force.norm(), 2.0) << "the fault is to meet a contact";
}

struct Row {
  std::string name;
  std::vector<BusFault> buses;
  std::vector<DriveFault> drives;
  std::set<Fault> faults;  ///< any of them
  std::set<Alarm> alarms;  ///< any of them; of Fault::kAlarm
  int most;                ///< cycles, of the table
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

class CanFault : public testing::TestWithParam<Row> {};

TEST_P(CanFault, StopsInTime) {
  const Row& row = GetParam();
  CanRun::Options options = pressing();
  options.bus_faults = row.buses;
  options.drive_faults = row.drives;
  CanRun run(plate(), options);
  start(run);
  run.run(std::max(row.most + 20, 750));
  const int cycles = run.cycles_to_stop(kBegin);
  EXPECT_GT(cycles, 0) << "never";
  EXPECT_LE(cycles, row.most);
  const CycleRecord& end = run.cycles.back().record;
  EXPECT_TRUE(row.faults.contains(end.fault)) << describe(end.fault) << " " << describe(end.alarm);
  std::string seen = describe(end.fault);
  if (end.fault == Fault::kAlarm) {
    seen = describe(end.alarm);
    EXPECT_TRUE(row.alarms.contains(end.alarm)) << seen;
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
  write_row(row.name, seen, cycles, row.most);
  std::printf("%-32s %4d cycles of %4d: %s\n", row.name.c_str(), cycles, row.most, seen.c_str());
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
        Row{"mode_left",
            {changed(0, 1, 0x6060, 0, 0.0)},
            {},
            {Fault::kAlarm, Fault::kDriveLeft},
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

class CanNuisance : public testing::TestWithParam<Row> {};

TEST_P(CanNuisance, IsGoneOnWith) {
  CanRun::Options options = pressing();
  for (int i = 0; i < 8; ++i) {
    for (BusFault fault : GetParam().buses) {
      fault.first_cycle = kBegin + 100 * i;
      options.bus_faults.push_back(fault);
    }
  }
  CanRun run(plate(), options);
  start(run);
  run.run(800);
  const CycleRecord& end = run.cycles.back().record;
  EXPECT_EQ(end.fault, Fault::kNone) << describe(end.fault) << ' ' << describe(end.alarm);
  EXPECT_EQ(end.share, 1.0);
  write_row(GetParam().name, "goes on", 0, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, CanNuisance,
    testing::Values(Row{"sample_lost_once", {of_frames(K::kFrameDropped, 0, 0x182, 1)}, {}, {}, {}, 0},
                    Row{"sample_lost_twice", {of_frames(K::kFrameDropped, 1, 0x185, 2)}, {}, {}, {}, 0},
                    Row{"sample_late_once", {of_frames(K::kFrameDelayed, 0, 0x183, 1, 0.5)}, {}, {}, {}, 0},
                    Row{"sample_twice", {of_frames(K::kFrameDuplicated, 0, 0x183, 40)}, {}, {}, {}, 0},
                    Row{"samples_reordered", {of_frames(K::kFrameReordered, 0, 0x181, 40)}, {}, {}, {}, 0},
                    Row{"wrong_length_once", {of_frames(K::kFrameLength, 0, 0x181, 1, 3.0)}, {}, {}, {}, 0},
                    Row{"torque_lost_twice", {of_frames(K::kFrameDropped, 2, 0x206, 2)}, {}, {}, {}, 0},
                    Row{"panel_lost_twice", {of_frames(K::kFrameDropped, 2, 0x1A0, 2)}, {}, {}, {}, 0},
                    Row{"foreign_chatter", {foreign(1, frame(0x7A0, {1, 2, 3, 4}), 1.0, 40)}, {}, {}, {}, 0},
                    Row{"transmit_queue_full_once", {bus_fault(K::kTransmitQueueFull, 1, 1)}, {}, {}, {}, 0}),
    [](const testing::TestParamInfo<Row>& row) { return row.param.name; });

TEST(CanStart, WaitsForADriveThatBootsLateAndRefusesOneThatNeverDoes) {
  CanRun::Options options = pressing();
  options.drive_faults = {{FaultKind::kSupplyLost, 3, 0, 500}};
  CanRun late(plate(), options);
  EXPECT_EQ(late.bring_up().status, hal::BringUpStatus::kOk);
  EXPECT_GT(late.device().now_ns(), 550'000'000);
  write_row("node_boots_late", "waits", 0, 0);

  options.drive_faults = {{FaultKind::kSupplyLost, 3, 0, kForGood}};
  CanRun never(plate(), options);
  const hal::BringUpResult result = never.bring_up();
  EXPECT_EQ(result.status, hal::BringUpStatus::kNoBootUp);
  EXPECT_EQ(result.joint, 3);
  write_row("node_never_boots", describe(result.status), 0, 0);
}

TEST(CanStart, RefusesWhatMustNotBe) {
  struct Start {
    std::string name;
    BusFault fault;
    hal::BringUpStatus status;
  };
  BusFault other = foreign(1, frame(0x080, {}), 1.0, kForGood);
  BusFault refuses = of_node(K::kSdoRefused, 0, 2, kForGood, 0x06090030);
  BusFault down = bus_fault(K::kInterfaceDown, 2, kForGood);
  BusFault full = bus_fault(K::kTransmitQueueFull, 0, kForGood);
  for (BusFault* fault : {&other, &refuses, &down, &full}) fault->first_cycle = 60;
  for (const Start& row : {Start{"second_master_at_start", other, hal::BringUpStatus::kSecondMaster},
                           {"sdo_refused", refuses, hal::BringUpStatus::kRefused},
                           {"interface_down_at_start", down, hal::BringUpStatus::kBusDown},
                           {"transmit_queue_full_at_start", full, hal::BringUpStatus::kCannotSend}}) {
    CanRun::Options options = pressing();
    options.bus_faults = {row.fault};
    CanRun run(plate(), options);
    const hal::BringUpResult result = run.bring_up();
    EXPECT_EQ(result.status, row.status) << row.name << ": " << describe(result.status);
    for (int i = 0; i < 7; ++i) EXPECT_EQ(run.device().nodes().drive(i).commands(), 0u) << "no torque was ever sent";
    write_row(row.name, describe(result.status), 0, 0);
  }
}

TEST(CanLoop, DoesNotFeelACounterThatWraps) {
  CanRun plain(plate(), pressing());
  start(plain);
  CanRun::Options options = pressing();
  // joint 2's counter passes its greatest value a little from where the joint begins
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
  write_row("counter_wraps", "no effect", 0, 0);
}

/// SIGKILL at an instant of a cycle: every drive stops by itself, and ends without torque and with its brake closed.
TEST(CanLoop, DrivesStopThemselvesWhenTheControllerIsKilled) {
  test::Random random(11);
  CanRun run(plate(), pressing());
  start(run);
  const std::int64_t begin_ns = (run.device().now_ns() / 1'000'000 + 1) * 1'000'000;
  run.device().advance_to(begin_ns);
  run.drives().request();
  run.device().advance_to(begin_ns + random.integer(0, 999'999));
  const std::int64_t deadline_ns = std::llround(1e9 * run.layout().command_deadline);
  run.device().advance_to(begin_ns + deadline_ns + 1);
  for (int i = 0; i < 7; ++i) EXPECT_NE(run.device().nodes().drive(i).state(), sim::PowerState::kEnabled) << i;
  run.go_on_alone(0.6);
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(run.device().nodes().drive(i).motor_torque(), 0.0);
    EXPECT_GT(run.device().nodes().drive(i).brake_torque(), 0.0);
  }
  EXPECT_TRUE(run.plant().velocities().isZero(1e-6));
  write_row("controller_killed", "drives stop by themselves", 4, 10);
}

}  // namespace
}  // namespace godobject::firmware
