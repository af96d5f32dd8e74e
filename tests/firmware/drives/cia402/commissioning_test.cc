#include "firmware/drives/cia402/commissioning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/cia402/bus_plan.h"
#include "hal/clock.h"
#include "sim/can_device.h"
#include "sim/virtual_clock.h"
#include "tests/sim/small_master.h"
#include "tests/support/arms.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware::commissioning_test {
namespace {

using command::Failure;

/// The drives of the light-weight robot, started; what a test has spoilt in them acts in the trial.
class CommissioningTest : public testing::Test {
 protected:
  void start(std::span<const sim::DriveFault> faults = {}, std::span<const sim::BusFault> bus_faults = {}) {
    make_device(faults, bus_faults);
    connect();
  }
  void make_device(std::span<const sim::DriveFault> faults = {}, std::span<const sim::BusFault> bus_faults = {}) {
    plant_.emplace(arm_, JointVector::Constant(0.3));
    device_ =
        std::make_unique<sim::CanDevice>(*plant_, layout_, hardware_, sim::CanScript{.faults = faults}, bus_faults);
    clock_ = std::make_unique<sim::VirtualClock>(*device_);
    wires_ = {&device_->bus(0), &device_->bus(1), &device_->bus(2)};
  }
  /// Starts the drives on `wires_`.
  void connect() {
    drives_.emplace(layout_, wires_, hal::plan_buses(layout_).timing);
    ASSERT_EQ(drives_->bring_up(*clock_).status, hal::BringUpStatus::kOk);
  }
  std::vector<JointTrial> run() {
    return try_drives(*drives_, layout_, wires_, *clock_, {"can0", "can1", "can2"}, end_);
  }
  std::int64_t now_ms() const { return device_->now_ns() / 1'000'000; }
  /// The message with which a trial ends; empty if it does not.
  std::string failure() {
    try {
      run();
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), command::ExitCode::kUnavailable);
      return failure.what();
    }
    return {};
  }
  hal::canopen::NmtState state(int joint) { return device_->nodes().drive(joint).nmt_state(); }

  ArmModel arm_ = test::lwr().model;
  hal::BusLayout layout_ = test::layout_of(arm_);
  std::array<sim::JointHardwareParameters, kMaxJoints> hardware_ = sim::usual_hardware(arm_);
  std::optional<sim::Plant> plant_;
  std::unique_ptr<sim::CanDevice> device_;
  std::unique_ptr<sim::VirtualClock> clock_;
  std::array<hal::CanBus*, 3> wires_{};
  std::optional<hal::CanDrives> drives_;
  std::atomic<bool> end_{false};
};

TEST_F(CommissioningTest, SeesTheDeadlineOfEachJointWithoutPower) {
  start();
  const std::vector<JointTrial> trials = run();
  ASSERT_EQ(trials.size(), 7u);
  for (int i = 0; i < 7; ++i) {
    const JointTrial& trial = trials.at(static_cast<std::size_t>(i));
    EXPECT_TRUE(trial.in_time) << i;
    EXPECT_EQ(trial.emergency, 0x8250);
    EXPECT_EQ(trial.after_ms, 5) << "4 ms after the last frame, taken with the next samples";
    EXPECT_EQ(trial.device_type, 0x00020192u);
    EXPECT_EQ(trial.identity.vendor, 0u);
    EXPECT_GE(trial.mode_after_ms, 0);
    EXPECT_LE(trial.mode_after_ms, 2);
    const double rated_mNm = 1e3 * layout_.drives.at(static_cast<std::size_t>(i)).rated_torque;
    EXPECT_NEAR(trial.rated_torque.value_or(0), rated_mNm, 0.5);
    EXPECT_NEAR(trial.position, 0.3, 1e-5);
    EXPECT_EQ(device_->nodes().drive(i).state(), sim::PowerState::kSwitchOnDisabled);
    EXPECT_EQ(device_->nodes().drive(i).motor_torque(), 0.0);
  }
  EXPECT_EQ(trial_objection(trials), "");
  const std::string table = trial_table(layout_, trials);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 8);
  EXPECT_NE(table.find("4 ms  emergency 8250 after 5 ms\n"), std::string::npos) << table;
}

TEST_F(CommissioningTest, NamesTheJointsWhoseDeadlineIsNotSeen) {
  start();
  for (const int joint : {2, 4}) device_->nodes().drive(joint).ignore_deadline();
  const std::vector<JointTrial> trials = run();
  EXPECT_EQ(trials[2].after_ms, -1);
  EXPECT_FALSE(trials[2].in_time);
  EXPECT_FALSE(trials[4].in_time);
  EXPECT_TRUE(trials[3].in_time);
  EXPECT_EQ(trial_objection(trials).substr(0, 12), "joint 3, 5: ");
  EXPECT_NE(trial_table(layout_, trials).find("4 ms  nothing\n"), std::string::npos);
}

TEST_F(CommissioningTest, EndsWithWhatElseGoesWrong) {
  start();
  const std::int64_t started_ms = device_->now_ns() / 1'000'000;
  run();
  const std::int64_t trial_ms = device_->now_ns() / 1'000'000 - 30;
  ASSERT_GT(trial_ms, started_ms + 100);
  const sim::DriveFault trips[] = {{sim::FaultKind::kDriveTrips, 5, trial_ms, 1}};
  start(trips);
  try {
    run();
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kUnavailable);
    EXPECT_NE(std::string(failure.what()).find("joint 6"), std::string::npos) << failure.what();
    EXPECT_NE(std::string(failure.what()).find("2310"), std::string::npos) << failure.what();
  }
}

/// The last joint waits for its deadline in five cycles, four before the end. Another drive that trips meanwhile ends
/// the test at once: its error is neither the joint's nor reset with it.
TEST_F(CommissioningTest, EndsWhenAnotherDriveTripsWhileAJointWaitsForItsDeadline) {
  start();
  const std::int64_t begin = now_ms();
  run();
  const std::int64_t waits = now_ms() - 8;
  for (int k = 0; k < 3; ++k) {
    const sim::DriveFault trips[] = {{sim::FaultKind::kDriveTrips, 2, waits + k, 1}};
    start(trips);
    ASSERT_EQ(now_ms(), begin);
    const std::string message = failure();
    EXPECT_NE(message.find("joint 3"), std::string::npos) << k << ": " << message;
    EXPECT_NE(message.find("2310"), std::string::npos) << k << ": " << message;
    EXPECT_LE(now_ms(), waits + k + 2) << k;
  }
}

TEST_F(CommissioningTest, NamesTheJointsThatDoNotTellTheirModeAtOnce) {
  start();
  device_->nodes().drive(1).objects().set(0x1A01, 0, 0);  // nothing in TPDO2
  std::vector<JointTrial> trials = run();
  EXPECT_EQ(trials[1].mode_after_ms, -1);
  EXPECT_FALSE(trials[1].mode_refused);
  EXPECT_EQ(trial_objection(trials).substr(0, 15), "joint 2: TPDO2 ");
  trials[1].mode_after_ms = kModeAtOnce_ms;
  EXPECT_EQ(trial_objection(trials), "");
  trials[1].mode_after_ms = kModeAtOnce_ms + 1;  // by its timer
  EXPECT_NE(trial_objection(trials), "");
  trials[1].mode_refused = true;  // untried: the watch of the parameters is left
  EXPECT_EQ(trial_objection(trials), "");
  EXPECT_NE(trial_table(layout_, trials).find("refused"), std::string::npos);
}

/// A mode is one byte. A longer frame that begins with the mode does not tell it, and an empty one does not either.
TEST_F(CommissioningTest, TakesNoModeFromATpdo2OfAnotherLength) {
  start();
  const std::int64_t begin = now_ms();
  const hal::DriveConfig& drive = layout_.drives[1];
  for (const double length : {0.0, 2.0}) {
    const sim::BusFault other_length[] = {{.kind = sim::BusFaultKind::kFrameLength,
                                           .bus = drive.bus,
                                           .first_cycle = begin,
                                           .cycles = 100'000,
                                           .id = static_cast<std::uint16_t>(0x280 + drive.node),
                                           .value = length}};
    start({}, other_length);
    ASSERT_EQ(now_ms(), begin);
    const std::vector<JointTrial> trials = run();
    EXPECT_EQ(trials[1].mode_after_ms, -1) << length;
    EXPECT_FALSE(trials[1].mode_refused);
    EXPECT_GE(trials[0].mode_after_ms, 0);
    EXPECT_EQ(trial_objection(trials).substr(0, 15), "joint 2: TPDO2 ");
  }
}

/// A drive that shows the mode in TPDO2 but does not confirm the write has neither told nor refused a mode.
TEST_F(CommissioningTest, WantsTheWriteOfAModeConfirmed) {
  start();
  const std::int64_t begin = now_ms();
  const hal::DriveConfig& drive = layout_.drives[1];
  const sim::BusFault unconfirmed[] = {{.kind = sim::BusFaultKind::kFrameDropped,
                                        .bus = drive.bus,
                                        .first_cycle = begin,
                                        .cycles = 100'000,
                                        .id = static_cast<std::uint16_t>(0x580 + drive.node)}};
  start({}, unconfirmed);
  ASSERT_EQ(now_ms(), begin);
  const std::vector<JointTrial> trials = run();
  EXPECT_EQ(trials[1].mode_after_ms, -1);
  EXPECT_FALSE(trials[1].mode_refused);
  EXPECT_FALSE(trials[1].device_type.has_value());
  EXPECT_GE(trials[0].mode_after_ms, 0);
  EXPECT_GE(trials[2].mode_after_ms, 0);
}

/// A deadline that is longer than what was written shows in the watch of the parameters, too: either way it is no
/// proof.
TEST_F(CommissioningTest, ADeadlineThatIsNotTheLayoutsIsRefused) {
  start();
  device_->nodes().drive(4).objects().set(0x1400, 5, 30);
  EXPECT_THROW(run(), Failure);
}

TEST_F(CommissioningTest, IsNoProofWhenItIsEnded) {
  start();
  end_ = true;
  EXPECT_THROW(run(), Failure);
}

TEST_F(CommissioningTest, CountsWithTheDeadlineOfTheLayout) {
  layout_.command_deadline = 7e-3;
  start();
  const std::vector<JointTrial> trials = run();
  for (const JointTrial& trial : trials) EXPECT_EQ(trial.after_ms, 8);
  EXPECT_NE(trial_table(layout_, trials).find("7 ms  emergency 8250 after 8 ms\n"), std::string::npos);
}

/// A drive whose objects cannot be read or written is still tried; its line says so.
TEST_F(CommissioningTest, TriesTheDeadlineOfADriveThatRefusesObjects) {
  start();
  const std::int64_t begin = now_ms();
  const int node = layout_.drives[0].node;
  const sim::BusFault refuses[] = {{.kind = sim::BusFaultKind::kSdoRefused,
                                    .bus = layout_.drives[0].bus,
                                    .first_cycle = begin,
                                    .cycles = 20,
                                    .node = node,
                                    .value = 0x06010000}};
  start({}, refuses);
  ASSERT_EQ(now_ms(), begin);
  const std::vector<JointTrial> trials = run();
  EXPECT_FALSE(trials[0].device_type || trials[0].identity.vendor || trials[0].identity.product ||
               trials[0].rated_torque);
  EXPECT_TRUE(trials[0].mode_refused);
  EXPECT_EQ(trials[0].mode_after_ms, -1);
  EXPECT_TRUE(trials[0].in_time);
  EXPECT_TRUE(trials[1].device_type && trials[1].identity.vendor && trials[1].identity.product &&
              trials[1].rated_torque);
  EXPECT_FALSE(trials[1].mode_refused);
  EXPECT_NE(trial_table(layout_, trials).find("    1   0    1        -        -        -        - "), std::string::npos)
      << trial_table(layout_, trials);
}

TEST_F(CommissioningTest, WantsAllDrivesOffBeforeTheTest) {
  start();
  for (const int joint : {0, 6}) {
    start();
    device_->nodes().drive(joint).trip(sim::kOverCurrent, device_->now_ns());
    const std::string message = failure();
    EXPECT_NE(message.find("joint " + std::to_string(joint + 1)), std::string::npos) << message;
  }
}

/// Another error of the drive under test, here one that does not watch its deadline, is shown with its code and is no
/// reaction to the deadline. At any other time it ends the test.
TEST_F(CommissioningTest, TakesNoOtherErrorForTheDeadline) {
  start();
  const std::int64_t begin = now_ms();
  run();
  const std::int64_t whole = now_ms() - begin;
  int shown = 0;
  for (std::int64_t ms = 200; ms < whole; ms += 25) {  // a trial without a reaction takes 54 ms
    const sim::BusFault emergency[] = {{.kind = sim::BusFaultKind::kEmergency,
                                        .bus = layout_.drives[0].bus,
                                        .first_cycle = begin + ms,
                                        .cycles = 1,
                                        .node = layout_.drives[0].node,
                                        .value = 0x5000}};
    start({}, emergency);
    device_->nodes().drive(0).ignore_deadline();
    try {
      const std::vector<JointTrial> trials = run();
      EXPECT_EQ(trials[0].emergency, 0x5000);
      EXPECT_GT(trials[0].after_ms, 0);
      EXPECT_FALSE(trials[0].in_time || trials[0].fault);
      EXPECT_TRUE(trials[1].in_time);
      ++shown;
    } catch (const Failure& failure) {
      EXPECT_NE(std::string(failure.what()).find("joint 1"), std::string::npos) << failure.what();
      EXPECT_NE(std::string(failure.what()).find("5000"), std::string::npos) << failure.what();
    }
  }
  EXPECT_GE(shown, 1);
  EXPECT_LE(shown, 3);
}

/// A clock of a machine that pauses once; it counts the calls in a row after which no time has passed since the first.
class PausingClock final : public hal::Clock {
 public:
  PausingClock(sim::World& world, std::span<const sim::LateWake> pauses) : clock_(world, pauses) {}
  std::int64_t now_ns() noexcept override { return clock_.now_ns(); }
  void sleep_until(std::int64_t ns) noexcept override {
    const std::int64_t before_ns = now_ns();
    clock_.sleep_until(ns);
    at_once_ = now_ns() == before_ns ? at_once_ + 1 : 0;
    most_at_once = std::max(most_at_once, at_once_);
  }
  int most_at_once = 0;

 private:
  sim::VirtualClock clock_;
  int at_once_ = 0;
};

/// Cycles that a pause has left out are not made up for in a burst: the next one begins at once, each later one in its
/// time. The drives do not watch their deadline here, so that they let the pause pass.
TEST_F(CommissioningTest, MakesUpForNoCyclesAfterAPause) {
  start();
  for (int joint = 0; joint < 7; ++joint) device_->nodes().drive(joint).ignore_deadline();
  // while it waits for the drives, between request and samples of a cycle
  const sim::LateWake pauses[] = {{(now_ms() + 150) * 1'000'000 + 1, 10'000'000}};
  PausingClock clock(*device_, pauses);
  const std::int64_t begin_ms = now_ms();
  const std::vector<JointTrial> trials = try_drives(*drives_, layout_, wires_, clock, {"can0", "can1", "can2"}, end_);
  EXPECT_GT(now_ms() - begin_ms, 300);
  EXPECT_LE(clock.most_at_once, 1);
  for (const JointTrial& trial : trials) EXPECT_EQ(trial.after_ms, -1);
}

/// A frame of the controller when it is handed over.
struct HandedOver {
  std::int64_t ns;
  int bus;
  int id;
};

/// An end of a bus whose frames of the controller are noted.
class NotingBus final : public hal::CanBus {
 public:
  NotingBus(hal::CanBus& bus, int number, hal::Clock& clock, std::vector<HandedOver>& notes)
      : bus_(bus), number_(number), clock_(clock), notes_(notes) {}
  hal::SendResult send(const hal::CanFrame& frame) noexcept override {
    notes_.push_back({clock_.now_ns(), number_, frame.id});
    return bus_.send(frame);
  }
  bool receive(hal::ReceivedFrame& received) noexcept override { return bus_.receive(received); }
  hal::BusHealth health() const noexcept override { return bus_.health(); }

 private:
  hal::CanBus& bus_;
  int number_;
  hal::Clock& clock_;
  std::vector<HandedOver>& notes_;
};

/// Puts an end that notes its frames before each wire.
std::vector<std::unique_ptr<NotingBus>> note_frames(std::span<hal::CanBus*> wires, hal::Clock& clock,
                                                    std::vector<HandedOver>& notes) {
  std::vector<std::unique_ptr<NotingBus>> ends;
  for (std::size_t b = 0; b < wires.size(); ++b) {
    ends.push_back(std::make_unique<NotingBus>(*wires[b], static_cast<int>(b), clock, notes));
    wires[b] = ends.back().get();
  }
  return ends;
}

/// A cycle on the wires: its SYNC on bus 0, and the joints that get torques after it.
struct WireCycle {
  std::int64_t sync_ns = 0;
  std::vector<int> joints{};
  std::vector<std::int64_t> torques_ns{};
};

std::vector<WireCycle> cycles_of(const std::vector<HandedOver>& frames, const hal::BusLayout& layout) {
  std::vector<WireCycle> cycles;
  for (const HandedOver& frame : frames) {
    if (frame.bus == 0 && frame.id == 0x080) cycles.push_back({.sync_ns = frame.ns});
    for (int i = 0; i < layout.joint_count && !cycles.empty(); ++i) {
      const hal::DriveConfig& drive = layout.drives[static_cast<std::size_t>(i)];
      if (frame.bus != drive.bus || frame.id != 0x200 + drive.node) continue;
      cycles.back().joints.push_back(i);
      cycles.back().torques_ns.push_back(frame.ns);
    }
  }
  return cycles;
}

/// Ten cycles of 1 ms a joint: in one its position is read, five are without its frames (the deadline of 4 ms, seen
/// with the next samples), and four have all frames again, one to reset and three without an alarm. In each the drives
/// get the planned time between SYNC and torques to send their samples.
TEST_F(CommissioningTest, TriesOneJointAfterTheOtherInWholeCycles) {
  make_device();
  std::vector<HandedOver> frames;
  const auto ends = note_frames(wires_, *clock_, frames);
  connect();
  frames.clear();
  run();
  const std::vector<WireCycle> cycles = cycles_of(frames, layout_);
  ASSERT_GT(cycles.size(), 70u);
  const std::size_t first = cycles.size() - 70;
  for (std::size_t k = 0; k < 70; ++k) {
    const WireCycle& cycle = cycles[first + k];
    const bool withheld = k % 10 >= 1 && k % 10 <= 5;
    std::vector<int> joints;
    for (int i = 0; i < 7; ++i) {
      if (!withheld || i != static_cast<int>(k / 10)) joints.push_back(i);
    }
    EXPECT_EQ(cycle.joints, joints) << k;
    EXPECT_EQ(cycle.sync_ns - cycles[first + k - 1].sync_ns, 1'000'000) << k;
    for (const std::int64_t ns : cycle.torques_ns) EXPECT_EQ(ns - cycle.sync_ns, drives_->collect_ns()) << k;
  }
}

/// A drive without a reaction gets no frames for its deadline and kPatience_ms; its test has one cycle before that and
/// four after it. Each other test takes ten cycles, as above.
TEST_F(CommissioningTest, WaitsForAReactionForTheDeadlineAndItsPatience) {
  make_device();
  std::vector<HandedOver> frames;
  const auto ends = note_frames(wires_, *clock_, frames);
  connect();
  frames.clear();
  device_->nodes().drive(2).ignore_deadline();
  EXPECT_EQ(run()[2].after_ms, -1);
  constexpr int kWaits = 4 + kPatience_ms;
  constexpr std::size_t kAll = 6 * 10 + 1 + kWaits + 4;
  const std::vector<WireCycle> cycles = cycles_of(frames, layout_);
  ASSERT_GT(cycles.size(), kAll);
  for (int joint = 0; joint < 7; ++joint) {
    const auto without = std::count_if(cycles.end() - kAll, cycles.end(), [joint](const WireCycle& cycle) {
      return std::find(cycle.joints.begin(), cycle.joints.end(), joint) == cycle.joints.end();
    });
    EXPECT_EQ(without, joint == 2 ? kWaits : 5) << joint;
  }
}

/// Either reaction alone is one, and the table tells which it was.
TEST(CommissioningTable, ShowsOfAReactionOnlyWhatWasSeen) {
  hal::BusLayout layout;
  layout.joint_count = 2;
  std::vector<JointTrial> trials(2);
  trials[0].after_ms = 5;
  trials[0].emergency = 0x8250;
  trials[1].after_ms = 7;
  trials[1].fault = true;
  const std::string table = trial_table(layout, trials);
  EXPECT_NE(table.find(" ms  emergency 8250 after 5 ms\n"), std::string::npos) << table;
  EXPECT_NE(table.find(" ms  fault after 7 ms\n"), std::string::npos) << table;
}

/// The printed lines are keys of a device file: whoever pastes them names the drives that were read.
TEST_F(CommissioningTest, PrintsIdentitiesToPaste) {
  layout_.drives[1].identity = {.vendor = 0x29C, .product = 0xFFFFFFFF, .revision = 0x10002, .serial = 4294967295};
  start();
  const std::vector<JointTrial> trials = run();
  const std::string keys = identity_keys(layout_, trials);
  EXPECT_EQ(std::count(keys.begin(), keys.end(), '\n'), 7);
  EXPECT_EQ(keys.rfind("identity = { vendor = 0x0, product = 0x1, revision = 0x10000, serial = 1 }  # joint 1: bus 0, "
                       "node 1\nidentity = { vendor = 0x29C, product = 0xFFFFFFFF, revision = 0x10002, serial = "
                       "4294967295 }  # joint 2: bus 0, node 2\n",
                       0),
            0u)
      << keys;
}

/// A drive may lack all fields but the vendor; what it does not tell is not printed.
TEST(CommissioningTable, NamesOfAnIdentityOnlyWhatTheDriveTells) {
  hal::BusLayout layout;
  layout.joint_count = 2;
  std::vector<JointTrial> trials(2);
  trials[0].identity.vendor = 0x1A;
  EXPECT_EQ(identity_keys(layout, trials),
            "identity = { vendor = 0x1A }  # joint 1: bus 0, node 1\n"
            "identity = {  }  # joint 2: bus 0, node 1\n");
}

TEST(CommissioningTable, HasEachNumberInItsPlace) {
  hal::BusLayout layout;
  layout.joint_count = 3;
  layout.command_deadline = 6e-3;
  for (std::size_t i = 0; i < 3; ++i) {
    layout.drives[i].bus = static_cast<int>(2 - i);
    layout.drives[i].node = static_cast<int>(10 + i);
    layout.drives[i].sign = i == 1 ? -1.0 : 1.0;
    layout.drives[i].zero = 0.25 * static_cast<double>(i);
  }
  std::vector<JointTrial> trials(3);
  trials[0].device_type = 0x20192;
  trials[0].identity.vendor = 0xAB;
  trials[0].identity.product = 0xCD;
  trials[0].rated_torque = 1760;
  trials[0].position = 1.5;
  trials[0].mode_after_ms = 0;
  trials[0].after_ms = 0;
  trials[0].emergency = 0x8250;
  trials[0].fault = true;
  trials[0].in_time = true;
  trials[1].mode_refused = true;
  trials[1].after_ms = 9;
  trials[1].fault = true;
  trials[1].in_time = true;
  EXPECT_EQ(trial_table(layout, trials),
            "joint bus node     type   vendor  product rated Nm sign     zero position  mode told  expected within  "
            "seen\n"
            "    1   2   10 00020192 000000AB 000000CD     1.76    1   0.0000   1.5000       0 ms             6 ms  "
            "emergency 8250, fault after 0 ms\n"
            "    2   1   11        -        -        -        -   -1   0.2500   0.0000    refused             6 ms  "
            "fault after 9 ms\n"
            "    3   0   12        -        -        -        -    1   0.5000   0.0000         no             6 ms  "
            "nothing\n");
  const std::string late = ": neither emergency 8250 nor a fault in time after the last RPDO;";
  const std::string untold = ": TPDO2 does not show a change of mode at once,";
  EXPECT_EQ(trial_objection(trials).rfind("joint 3" + late, 0), 0u);
  EXPECT_NE(trial_objection(trials).find("firmware/README.md; joint 3" + untold), std::string::npos);
  trials[2].mode_after_ms = 0;
  EXPECT_EQ(trial_objection(trials).find(untold), std::string::npos);
  trials[2].in_time = true;
  EXPECT_EQ(trial_objection(trials), "");
  trials[0].mode_after_ms = kModeAtOnce_ms + 1;
  trials[1].mode_refused = false;
  EXPECT_EQ(trial_objection(trials).rfind("joint 1, 2" + untold, 0), 0u) << trial_objection(trials);
  trials[0].in_time = trials[1].in_time = trials[2].in_time = false;
  EXPECT_EQ(trial_objection(trials).rfind("joint 1, 2, 3" + late, 0), 0u);
}

}  // namespace
}  // namespace godobject::firmware::commissioning_test
