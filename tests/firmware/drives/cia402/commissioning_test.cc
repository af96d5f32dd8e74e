#include "firmware/drives/cia402/commissioning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "hal/cia402/bus_plan.h"
#include "sim/can_device.h"
#include "tests/sim/small_master.h"
#include "tests/support/arms.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware {
namespace {

using command::Failure;

/// The drives of the light-weight robot, started; what a test has spoilt in them acts in the trial.
class CommissioningTest : public testing::Test {
 protected:
  void start(std::span<const sim::DriveFault> faults = {}) {
    plant_.emplace(arm_, JointVector::Constant(0.3));
    device_ = std::make_unique<sim::CanDevice>(*plant_, layout_, hardware_, sim::CanScript{.faults = faults});
    clock_ = std::make_unique<sim::VirtualClock>(*device_);
    wires_ = {&device_->bus(0), &device_->bus(1), &device_->bus(2)};
    drives_.emplace(layout_, wires_, hal::plan_buses(layout_).timing);
    ASSERT_EQ(drives_->bring_up(*clock_).status, hal::BringUpStatus::kOk);
  }
  std::vector<JointTrial> run() {
    return try_drives(*drives_, layout_, wires_, *clock_, {"can0", "can1", "can2"}, end_);
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
    EXPECT_EQ(trial.vendor, 0u);
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

}  // namespace
}  // namespace godobject::firmware
