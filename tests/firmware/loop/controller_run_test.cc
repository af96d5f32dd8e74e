#include "firmware/loop/controller_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/device/kinematics.h"
#include "tests/firmware/cycle/fake_drives.h"
#include "tests/support/arms.h"
#include "tests/support/small_scenes.h"
#include "toolchain/files/aligned_bytes.h"

namespace godobject::firmware::controller_run_test {
namespace {

TEST(ControllerRun, RefusesToStartForWhatAResetDoesNotCure) {
  const std::vector<Fault> refusals = {Fault::kDrivesAbsent, Fault::kNotAtRest, Fault::kSignWrong,
                                       Fault::kSignUndecided, Fault::kOutsideLimits};
  for (int i = 0; i <= static_cast<int>(kLastFault); ++i) {
    const auto fault = static_cast<Fault>(i);
    EXPECT_EQ(refuses_to_start(fault), std::count(refusals.begin(), refusals.end(), fault) == 1) << describe(fault);
  }
}

TEST(ControllerRun, ReportsTheLargestOfWhatWasRenderedAndNothingElse) {
  RunReport report;
  CycleRecord record;
  record.mode = Mode::kArmed;
  record.share = 0.0;
  record.F_G_R = {Vector3(9, 9, 9), Vector3(9, 9, 9)};  // computed, not rendered
  record.penetration = 9.0;
  detail::watch(record, report);
  EXPECT_EQ(report.rendering + report.in_contact, 0u);
  EXPECT_EQ(report.largest_force + report.largest_torque + report.deepest, 0.0);

  record.mode = Mode::kRunning;
  record.share = 0.5;
  record.F_G_R = {Vector3(3, 0, 4), Vector3(0, 0.6, 0.8)};
  record.penetration = 0.002;
  detail::watch(record, report);
  record.F_G_R = {Vector3(0, 0, 1), Vector3(2, 0, 0)};
  record.penetration = 0.003;
  detail::watch(record, report);
  record.F_G_R = {};
  record.penetration = 0.001;
  detail::watch(record, report);
  EXPECT_EQ(report.rendering, 3u);
  EXPECT_EQ(report.in_contact, 2u);
  EXPECT_EQ(report.largest_force, 5.0);
  EXPECT_EQ(report.largest_torque, 2.0);
  EXPECT_EQ(report.deepest, 0.003);
  for (std::size_t mode = 0; mode < kModeCount; ++mode) {
    const auto count = static_cast<Mode>(mode) == Mode::kArmed     ? 1u
                       : static_cast<Mode>(mode) == Mode::kRunning ? 3u
                                                                   : 0u;
    EXPECT_EQ(report.in_mode[mode], count) << mode;
  }
}

TEST(ControllerRun, CountsTheCyclesInARowInWhichTheOperatorIsAwaited) {
  RunReport report;
  for (int mode = 0; mode <= static_cast<int>(Mode::kEnded); ++mode) {
    CycleRecord record;
    record.mode = static_cast<Mode>(mode);
    const bool waits = record.mode == Mode::kIdle || record.mode == Mode::kArmed;
    for (std::uint32_t k = 1; k <= 3; ++k) {
      detail::watch(record, report);
      EXPECT_EQ(report.waiting.load(), waits ? k : 0u) << mode;
    }
    CycleRecord other;
    detail::watch(other, report);
    EXPECT_EQ(report.waiting.load(), 0u);
  }
}

TEST(ControllerRun, ShowsOtherThreadsTheStateOfTheLastCycle) {
  RunReport report;
  CycleRecord record;
  record.mode = Mode::kStopped;
  record.fault = Fault::kAlarm;
  record.alarm = hal::Alarm::kNodeReset;
  record.alarm_joint = 5;
  detail::watch(record, report);
  const Standing standing = report.standing.load();
  EXPECT_EQ(standing.mode, Mode::kStopped);
  EXPECT_EQ(standing.fault, Fault::kAlarm);
  EXPECT_EQ(standing.alarm, hal::Alarm::kNodeReset);
  EXPECT_EQ(standing.alarm_joint, 5);
}

TEST(ControllerRun, ShowsOtherThreadsHowLongTheGodObjectStayedBehind) {
  RunReport report;
  CycleRecord record;
  for (const auto& [behind, longest] : {std::pair{2u, 2u}, {0u, 2u}, {1u, 2u}, {3u, 3u}}) {
    record.behind = behind;
    detail::watch(record, report);
    EXPECT_EQ(report.longest_behind, longest);
  }
}

/// Virtual time, in which each look at the clock may take its time; the stopwatch advances by a script.
class StepClock final : public hal::Clock {
 public:
  std::int64_t now_ns() noexcept override { return now += look_ns; }
  void sleep_until(std::int64_t ns) noexcept override { now = std::max(now, ns); }
  std::int64_t now = 0;
  std::int64_t look_ns = 0;
};

class Stopwatch final : public hal::Clock {
 public:
  /// Each cycle reads it twice; the k-th took k microseconds.
  std::int64_t now_ns() noexcept override {
    if (++reads_ % 2 == 0) now_ += 1000 * (reads_ / 2);
    return now_;
  }
  void sleep_until(std::int64_t) noexcept override {}

 private:
  std::int64_t now_ = 0;
  std::int64_t reads_ = 0;
};

class ControllerRunTest : public testing::Test {
 protected:
  ControllerRunTest() : image_(test::ball_over_plate()), scene_(test::open_scene(image_)), drives_(7) {
    drives_.reading.position << 0.0, -0.5, 0.0, 1.4, 0.0, -1.2, 0.0;
    setup_.scene = &scene_;
    setup_.memory = memory_.span();
    setup_.arm = &arm_.model;
    setup_.joint_torque = &arm_.parameters;
    setup_.supervisor.boot_cycles = 50;
    const Pose H_RM = forward_kinematics(arm_.model, drives_.reading.position).H_RM;
    setup_.mapping.H_WR.translation = Vector3(0.0, 0.0, 0.06) - H_RM.translation;
    run_.stopwatch = &stopwatch_;
    run_.compute_ns = 10'000;
  }

  void run() {
    cycle_ = std::make_unique<ControlCycle>(setup_, drives_);
    ASSERT_EQ(cycle_->start(), Status::kOk);
    run_controller(run_, clock_, *cycle_, requests_, ring_, report_, [&] {
      ++reads_;
      if (reads_ == ends_at_) requests_.end = true;
      TelemetryRecord record;
      while (ring_.pop(record)) modes_.push_back(record.cycle.mode);
    });
  }

  test::Arm arm_ = test::lwr();
  test::SceneImage image_;
  SceneView scene_;
  FakeDrives drives_;
  files::AlignedBytes memory_{GodObject::least_memory_size()};
  CycleSetup setup_;
  RunSetup run_;
  StepClock clock_;
  Stopwatch stopwatch_;
  RunRequests requests_;
  TelemetryRing ring_;
  RunReport report_;
  std::unique_ptr<ControlCycle> cycle_;
  std::vector<Mode> modes_;
  std::uint64_t reads_ = 0;
  std::uint64_t ends_at_ = 0;
};

/// In IDLE the run ends in the cycle that is asked to.
TEST_F(ControllerRunTest, EndsAfterItsCycles) {
  drives_.reading.enable_switch = false;
  run_.cycles = 120;
  run();
  EXPECT_EQ(cycle_->record().mode, Mode::kEnded);
  EXPECT_EQ(drives_.sends, 121) << "the last one is told that its time is over";
  EXPECT_EQ(drives_.requests, 121) << "each cycle asks for its own samples";
  EXPECT_EQ(reads_, 121u);
  EXPECT_EQ(modes_.size(), 121u) << "each cycle has a record";
  EXPECT_EQ(report_.computing.count(), 121u);
  EXPECT_EQ(report_.computing.largest_ns(), 121'000);
  EXPECT_EQ(report_.beyond_plan, 111u) << "those above 10 us";
  EXPECT_EQ(clock_.now, 120'000'000);
}

/// The loop looks at its clock before and after a cycle, so each cycle takes one look.
TEST_F(ControllerRunTest, GoesOnWhileCyclesComputeForAsLongAsPlanned) {
  clock_.look_ns = run_.compute_ns;
  run_.cycles = 2000;
  run();
  EXPECT_EQ(cycle_->record().fault, Fault::kNone);
  EXPECT_EQ(report_.loop.compute.largest_ns(), run_.compute_ns);
}

TEST_F(ControllerRunTest, StopsAnArmWithPowerWhenCyclesComputeForLongerThanPlanned) {
  clock_.look_ns = run_.compute_ns + 1;
  run_.cycles = 2000;
  run();
  EXPECT_EQ(cycle_->record().fault, Fault::kComputedLate);
  EXPECT_EQ(std::count(modes_.begin(), modes_.end(), Mode::kRunning), 0);
}

TEST_F(ControllerRunTest, EndsOnRequestAndNotBefore) {
  drives_.reading.enable_switch = false;
  ends_at_ = 300;
  run();
  EXPECT_EQ(cycle_->record().mode, Mode::kEnded);
  EXPECT_EQ(reads_, 301u);
  EXPECT_EQ(modes_.size(), 301u) << "a record each cycle";
}

TEST_F(ControllerRunTest, EndsWhenItRefusesToStart) {
  drives_.reading.state.fill(hal::DriveState::kUnavailable);
  drives_.reading.age.fill(1);
  run();
  EXPECT_EQ(cycle_->record().mode, Mode::kStopped);
  EXPECT_EQ(cycle_->record().fault, Fault::kDrivesAbsent);
  EXPECT_EQ(reads_, 51u);
}

/// Drives that have power are stopped and released before the run ends. The joints do not follow the test of their
/// signs.
TEST_F(ControllerRunTest, StopsTheDrivesBeforeItEndsARefusedStart) {
  setup_.supervisor.sign_test = true;
  run_.cycles = 20'000;
  run();
  EXPECT_EQ(cycle_->record().mode, Mode::kStopped);
  EXPECT_TRUE(refuses_to_start(cycle_->record().fault)) << describe(cycle_->record().fault);
  EXPECT_GT(std::count(modes_.begin(), modes_.end(), Mode::kStopping), 0);
}

/// A fault that the operator can reset does not end the run; each request resets once.
TEST_F(ControllerRunTest, GoesOnAfterAFaultThatCanBeReset) {
  drives_.reading.enable_switch = false;
  drives_.reading.state[3] = hal::DriveState::kFault;
  requests_.reset = true;
  ends_at_ = 2000;
  run();
  EXPECT_EQ(reads_, 2001u);
  EXPECT_FALSE(requests_.reset) << "taken by a cycle";
  EXPECT_EQ(modes_[0], Mode::kStopped);
  EXPECT_EQ(cycle_->record().fault, Fault::kDriveLeft) << "the request came before the fault: it resets nothing later";
}

}  // namespace
}  // namespace godobject::firmware::controller_run_test
