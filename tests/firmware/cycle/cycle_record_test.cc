#include "firmware/cycle/control_cycle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/device/dynamics.h"
#include "core/device/kinematics.h"
#include "core/device/velocity_estimator.h"
#include "tests/firmware/cycle/control_cycle_fixture.h"

namespace godobject::firmware::cycle_record_test {
namespace {

class CycleRecordTest : public ControlCycleTest {
 protected:
  const CycleRecord& record() const { return cycle_->record(); }
  const CycleCounters& counters() const { return cycle_->counters(); }
};

TEST_F(CycleRecordTest, HasWhatWasReadComputedAndSent) {
  make();
  run_to(Mode::kRunning);
  press(0.033);
  for (int i = 0; i < 8; ++i) {  // soon: joints that rest for longer after this motion would be stuck
    drives_.reading.position[0] += 1e-4;
    step();
  }
  EXPECT_EQ(record().q, drives_.reading.position);
  EXPECT_NEAR(record().qd[0], 0.1, 1e-9);
  EXPECT_LT(record().qd.tail<6>().norm(), 1e-9);
  EXPECT_EQ(record().torque, drives_.sent.torque);
  EXPECT_EQ(record().status, Status::kOk);
  EXPECT_EQ(record().fault, Fault::kNone);
  EXPECT_EQ(record().alarm, hal::Alarm::kNone);
  EXPECT_EQ(record().alarm_joint, -1);
  EXPECT_EQ(record().lost, 0u);
  EXPECT_EQ(record().share, 1.0);
  EXPECT_FALSE(record().clutch_is_open);
  EXPECT_GT(record().contacts, 0u);
  const Pose H_RM = forward_kinematics(arm_.model, drives_.reading.position).H_RM;
  EXPECT_LT((record().H_RM.translation - H_RM.translation).norm(), 1e-15);
  EXPECT_LT(record().H_RM.rotation.angularDistance(H_RM.rotation), 1e-7);
  const Vector3 p_RW = setup_.mapping.H_WR.translation;  // scene and room have the same axes
  EXPECT_LT((record().H_WM.translation - (H_RM.translation + p_RW)).norm(), 1e-12);

  drives_.reading.age[4] = 2;
  drives_.reading.alarm = hal::Alarm::kHeartbeatLost;
  drives_.reading.alarm_joint = 4;
  step();
  EXPECT_EQ(record().alarm, hal::Alarm::kHeartbeatLost);
  EXPECT_EQ(record().alarm_joint, 4);
  EXPECT_EQ(record().fault, Fault::kAlarm);
  EXPECT_EQ(record().mode, Mode::kStopping);
  EXPECT_EQ(record().lost, 2u);
}

/// The wrench of the record is what the arm's torques give at the hand: with the share, while it rises and while it
/// fades.
/// Only drives that have power as requested count.
TEST_F(CycleRecordTest, CountsCyclesInWhichADriveLimitsItsTorque) {
  make();
  drives_.reading.limited = {true, false, true};
  for (int k = 0; k < 100; ++k) step();
  EXPECT_EQ(record().limited, 0u) << "without power";
  EXPECT_EQ(counters().limited, 0u);
  drives_.reading.limited.fill(false);
  run_to(Mode::kRunning);
  EXPECT_EQ(counters().limited, 0u);
  for (int k = 0; k < 20; ++k) {
    drives_.reading.limited.fill(false);
    if (k % 2 == 0) drives_.reading.limited = {true, false, false, false, false, false, true};
    step();
    EXPECT_EQ(record().limited, k % 2 == 0 ? 0b1000001u : 0u);
  }
  EXPECT_EQ(counters().limited, 10u);
  EXPECT_EQ(record().fault, Fault::kNone);
  drives_.reading.limited[3] = true;
  for (int k = 0; k < 51; ++k) step();
  EXPECT_EQ(record().fault, Fault::kDriveLimited);
  EXPECT_EQ(cycle_->supervisor().fault_joint(), 3);
}

/// With and without power: a warm drive stays one.
TEST_F(CycleRecordTest, CountsCyclesWithAWarmOrASilentDrive) {
  make();
  drives_.reading.warm[6] = true;
  for (int k = 0; k < 5; ++k) step();
  EXPECT_EQ(record().warm, 0b1000000u);
  EXPECT_EQ(record().temperature_lost, 0u);
  drives_.reading.warm[6] = false;
  drives_.reading.temperature_lost = {true, true};
  for (int k = 0; k < 3; ++k) step();
  EXPECT_EQ(record().warm, 0u);
  EXPECT_EQ(record().temperature_lost, 0b11u);
  EXPECT_EQ(counters().warm, 5u);
  EXPECT_EQ(counters().temperature_lost, 3u);
  EXPECT_EQ(record().fault, Fault::kNone);
}

TEST_F(CycleRecordTest, HasTheWrenchThatIsRendered) {
  scene_.H_MB.translation = Vector3(0.0, 0.03, 0.0);
  make();
  run_to(Mode::kRunning);
  press(0.034);
  const auto pushed = [&] {
    return JointVector(drives_.sent.torque -
                       gravity_torque(arm_.model, forward_kinematics(arm_.model, drives_.reading.position)));
  };
  const auto expect_rendered = [&](const char* when) {
    const ArmKinematics kinematics = forward_kinematics(arm_.model, drives_.reading.position);
    const Jacobian J = geometric_jacobian(kinematics, kinematics.H_RM * scene_.H_MB.translation);
    Eigen::Matrix<double, 6, 1> F;
    F << record().F_G_R.force, record().F_G_R.torque;
    EXPECT_LT((J.transpose() * F - pushed()).norm(), 1e-6) << when;
  };
  const double whole = record().F_G_R.force.norm();
  ASSERT_GT(whole, 2.0);
  expect_rendered("running");
  for (std::uint32_t k = 1; k <= 7; ++k) {
    drives_.reading.age[1] = k;
    step();
    expect_rendered("fading");
    if (k >= 3) {
      EXPECT_NEAR(record().F_G_R.force.norm(), (1.0 - 0.2 * (k - 2)) * whole, 0.02 * whole) << k;
      EXPECT_NEAR(record().share, 1.0 - 0.2 * (k - 2), 1e-12);
    }
  }
  EXPECT_EQ(record().F_G_R.force.norm(), 0.0);
}

/// Counters of events in cycles by hand; a count of one event leaves the others.
TEST_F(CycleRecordTest, CountsEachEventOnce) {
  make();
  drives_.reading.state.fill(hal::DriveState::kUnavailable);
  drives_.reading.age.fill(1);
  for (int i = 0; i < 5; ++i) step();
  EXPECT_EQ(counters().cycles, 5u);
  EXPECT_EQ(counters().lost, 0u) << "in boot none is expected";
  drives_.reading.state.fill(hal::DriveState::kOff);
  drives_.reading.age.fill(0);
  run_to(Mode::kRunning);
  for (int i = 0; i < 10; ++i) step();
  const CycleCounters before = counters();
  auto expect_counted = [&, last = before](std::uint64_t CycleCounters::*counter, std::uint64_t by) mutable {
    ++last.cycles;
    last.*counter += by;
    EXPECT_EQ(counters().cycles, last.cycles);
    EXPECT_EQ(counters().lost, last.lost);
    EXPECT_EQ(counters().jumps, last.jumps);
    EXPECT_EQ(counters().overruns, last.overruns);
    EXPECT_EQ(counters().skipped, last.skipped);
    EXPECT_EQ(counters().sends_failed, last.sends_failed);
    EXPECT_EQ(counters().clipped, last.clipped);
    EXPECT_EQ(counters().slowed, last.slowed);
    EXPECT_EQ(counters().scaled, last.scaled);
    EXPECT_EQ(counters().rate_limited, last.rate_limited);
    EXPECT_EQ(counters().unconverged, last.unconverged);
  };
  LoopEvents late;
  late.overrun_ns = 1;
  step(late);
  expect_counted(&CycleCounters::overruns, 1);
  LoopEvents skips;
  skips.skipped = 2;
  step(skips);
  expect_counted(&CycleCounters::skipped, 2);
  drives_.reading.age[6] = 1;
  step();
  expect_counted(&CycleCounters::lost, 1);
  drives_.reading.age[6] = 0;
  step();
  expect_counted(&CycleCounters::lost, 0);
  drives_.reading.position[6] += 0.05;
  step();
  expect_counted(&CycleCounters::jumps, 1);
  drives_.reading.position[6] -= 0.05;
  drives_.fails_to_send = true;
  step();
  expect_counted(&CycleCounters::sends_failed, 1);
  drives_.fails_to_send = false;
  step();
  expect_counted(&CycleCounters::sends_failed, 0);
}

/// Limits count only while something is rendered.
TEST_F(CycleRecordTest, CountsLimitsOnlyWhileItRenders) {
  setup_.hand.speed = 0.01;
  setup_.hand.turn = 0.01;
  setup_.hand.force = 0.5;
  const auto sway = [&](int cycles) {
    for (int i = 0; i < cycles; ++i) {
      drives_.reading.position[0] += (i / 10) % 2 == 0 ? 2e-4 : -2e-4;
      step();
    }
  };
  setup_.supervisor.engage_force = 1e-6;
  make();
  run_to(Mode::kEnabling);
  sway(100);
  EXPECT_EQ(record().share, 0.0);
  EXPECT_EQ(counters().slowed + counters().clipped + counters().scaled, 0u);
  run_to(Mode::kRunning);
  const std::uint64_t before = counters().slowed;
  sway(100);
  EXPECT_GT(counters().slowed, before + 50);
  EXPECT_LE(counters().slowed, before + 100);
}

TEST_F(CycleRecordTest, CountsCyclesInWhichTheJointsCannotGiveTheWholeWrench) {
  for (ArmJoint& joint : arm_.model.joints) joint.torque = std::min(joint.torque, 40.0);
  setup_.hand.force = 140.0;
  scene_.settings.stiffness = 20'000.0;
  make();
  run_to(Mode::kRunning);
  EXPECT_EQ(counters().scaled, 0u);
  press(0.036);
  EXPECT_GT(counters().scaled, 0u);
  EXPECT_LT(counters().scaled, counters().cycles);
}

/// A cycle that finds a fault renders nothing, whatever it has computed before.
TEST_F(CycleRecordTest, CountsNoLimitInTheCycleThatStops) {
  for (ArmJoint& joint : arm_.model.joints) joint.torque = std::min(joint.torque, 40.0);
  setup_.hand.force = 100.0;
  scene_.settings.stiffness = 20'000.0;
  make();
  run_to(Mode::kRunning);
  press(0.036);
  const CycleCounters before = counters();
  step();
  ASSERT_EQ(record().mode, Mode::kRunning);
  const CycleCounters rendering = counters();
  ASSERT_EQ(rendering.scaled, before.scaled + 1) << "the joints cannot give the whole wrench";
  ASSERT_EQ(rendering.clipped, before.clipped + 1) << "the hand may not get it";
  drives_.reading.emergency_stop = true;
  step();
  EXPECT_EQ(record().mode, Mode::kStopping);
  EXPECT_EQ(record().share, 0.0);
  EXPECT_EQ(counters().cycles, rendering.cycles + 1);
  EXPECT_EQ(counters().scaled, rendering.scaled);
  EXPECT_EQ(counters().clipped, rendering.clipped);
  EXPECT_EQ(counters().slowed, rendering.slowed);
  EXPECT_EQ(counters().unconverged, rendering.unconverged);
}

TEST_F(CycleRecordTest, CountsCyclesWithATorqueAtItsRateLimit) {
  setup_.torque.rate = 0.001;
  setup_.supervisor.prepare_cycles = 1005;
  make();
  for (int i = 0; i < 300 && record().mode != Mode::kEnabling; ++i) step();
  const std::uint64_t before = counters().rate_limited;
  EXPECT_EQ(before, 1u) << "the first torque of the mode";
  for (int i = 0; i < 50; ++i) step();
  EXPECT_EQ(counters().rate_limited, 51u);
  for (int i = 0; i < 950; ++i) step();
  const std::uint64_t after = counters().rate_limited;
  for (int i = 0; i < 10; ++i) step();
  EXPECT_EQ(counters().rate_limited, after) << "the arm is held";
}

/// Each joint at each of its limits before the start: at the limit it may begin, beyond it not.
TEST_F(CycleRecordTest, BeginsWithEachJointAtItsLimitAndNotBeyond) {
  for (int joint = 0; joint < 7; ++joint) {
    const ArmJoint& limits = arm_.model.joints[static_cast<std::size_t>(joint)];
    for (const double limit : {limits.lower, limits.upper}) {
      const double outward = limit == limits.lower ? -HUGE_VAL : HUGE_VAL;
      for (const bool beyond : {false, true}) {
        drives_ = FakeDrives(7);
        drives_.reading.position = q0_;
        drives_.reading.position[joint] = beyond ? std::nextafter(limit, outward) : limit;
        make();
        for (int i = 0; i < 3; ++i) step();
        EXPECT_EQ(record().fault, beyond ? Fault::kOutsideLimits : Fault::kNone) << joint << ' ' << limit;
        EXPECT_EQ(cycle_->supervisor().fault_joint(), beyond ? joint : -1);
      }
    }
  }
}

/// A joint's speed, the hand's speed and its turn each stop the run alone.
TEST_F(CycleRecordTest, StopsForEachSpeedAlone) {
  const auto runs_to = [&](double step_of_joint_0) {
    drives_ = FakeDrives(7);
    drives_.reading.position = q0_;
    make();
    run_to(Mode::kRunning);
    for (int i = 0; i < 60 && record().fault == Fault::kNone; ++i) {
      drives_.reading.position[0] += step_of_joint_0;
      step();
    }
    return record().fault;
  };
  // 0.5 rad/s of joint 0, 1.92 rad/s at most; the tool is some 0.5 m from its axis
  ASSERT_EQ(runs_to(5e-4), Fault::kNone);
  setup_.hand.turn = 0.3;
  setup_.hand.turn_stop = 0.4;
  EXPECT_EQ(runs_to(5e-4), Fault::kTooFast) << "the hand turns";
  setup_.hand = {};
  setup_.hand.speed = 0.05;
  setup_.hand.speed_stop = 0.06;
  EXPECT_EQ(runs_to(5e-4), Fault::kTooFast) << "the hand moves";
  setup_.hand = {};
  setup_.torque.joint_speed = 0.1;
  setup_.torque.joint_speed_stop = 0.2;
  EXPECT_EQ(runs_to(5e-4), Fault::kTooFast) << "the joint turns";
}

/// A pause of sixteen periods or more empties the velocity estimate; a shorter one is interpolated.
TEST_F(CycleRecordTest, EstimatesTheVelocityAnewAfterALongPause) {
  for (const std::uint32_t skipped : {1u, 5u, 15u, 16u, 100u}) {
    drives_ = FakeDrives(7);
    drives_.reading.position = q0_;
    make();
    run_to(Mode::kRunning);
    for (int i = 0; i < 20; ++i) {
      drives_.reading.position[0] += 4e-4;
      step();
    }
    ASSERT_NEAR(record().qd[0], 0.4, 1e-9);
    drives_.reading.position[0] += 2e-4 * (1.0 + skipped);
    LoopEvents events;
    events.skipped = skipped;
    step(events);
    if (skipped >= static_cast<std::uint32_t>(VelocityEstimator::kMaxWindow)) {
      EXPECT_EQ(record().qd[0], 0.0) << skipped;
    } else {
      // half as fast in the pause; the estimate is that of the last four positions, one a period
      EXPECT_GE(record().qd[0], 0.2 - 1e-9) << skipped;
      EXPECT_LT(record().qd[0], skipped < 3 ? 0.4 : 0.2 + 1e-9) << skipped;
    }
    for (int i = 0; i < 5; ++i) {
      drives_.reading.position[0] += 2e-4;
      step();
    }
    EXPECT_NEAR(record().qd[0], 0.2, 1e-9) << skipped;
  }
}

/// While the hand leans on the plate a request to open the clutch waits. Once open it stays open until it is closed.
TEST_F(CycleRecordTest, OpensTheClutchOnlyWhereTheHandLeansOnNothing) {
  make();
  run_to(Mode::kRunning);
  press(0.033);
  drives_.reading.clutch_open = true;
  for (int i = 0; i < 5; ++i) step();
  EXPECT_FALSE(record().clutch_is_open);
  EXPECT_NEAR(record().F_G_R.force.z(), 6.0, 0.1) << "the contact does not give way";
  const JointVector pressed = drives_.reading.position;
  for (int i = 1; i <= 200; ++i) {
    drives_.reading.position = pressed + i / 200.0 * (q0_ - pressed);
    step();
    if (record().F_G_R.force.norm() > 0.6) {
      ASSERT_FALSE(record().clutch_is_open) << i;
    }
  }
  EXPECT_TRUE(record().clutch_is_open);
  const Vector3 rests = record().H_WM.translation;
  for (int i = 1; i <= 200; ++i) {
    drives_.reading.position = q0_ + i / 200.0 * (pressed - q0_);
    step();
    ASSERT_TRUE(record().clutch_is_open);
    ASSERT_LT((record().H_WM.translation - rests).norm(), 1e-12) << "the mesh rests";
  }
  drives_.reading.clutch_open = false;
  step();
  EXPECT_FALSE(record().clutch_is_open);
}

/// A mesh that starts in the still body has no force yet, but the clutch may not carry it on from there.
TEST_F(CycleRecordTest, KeepsTheClutchClosedWhileTheMeshIsInside) {
  setup_.mapping.H_WR.translation.z() -= 0.06;
  make();
  run_to(Mode::kArmed);
  for (int i = 0; i < 5; ++i) step();
  drives_.reading.clutch_open = true;
  for (int i = 0; i < 20; ++i) {
    step();
    ASSERT_EQ(record().mode, Mode::kArmed);
    ASSERT_EQ(record().outcome, Outcome::kStartInside);
    ASSERT_EQ(record().F_G_R.force.norm(), 0.0);
    ASSERT_FALSE(record().clutch_is_open) << i;
  }
}

/// A small budget ends cycles that render. Each counts once, no other counts, and the longest row of them is kept.
TEST_F(CycleRecordTest, CountsTheCyclesThatTheBudgetEnds) {
  setup_.work_budget = 8000;
  make();
  std::uint64_t row = 0;
  std::uint64_t longest = 0;
  std::uint64_t rendering = 0;
  const auto step_and_count = [&] {
    const std::uint64_t before = counters().out_of_work;
    step();
    const std::uint64_t more = counters().out_of_work - before;
    ASSERT_LE(more, record().share > 0.0 ? 1u : 0u);
    rendering += record().share > 0.0 ? 1u : 0u;
    row = more > 0 ? row + 1 : 0;
    longest = std::max(longest, row);
    ASSERT_EQ(counters().most_out_of_work, longest);
  };
  while (record().mode != Mode::kRunning && counters().cycles < 1000) step_and_count();
  ASSERT_EQ(record().mode, Mode::kRunning);
  for (int i = 1; i <= 200; ++i) {
    drives_.reading.position = moved(Vector3(0.0, 0.0, -0.033 * i / 200.0));
    step_and_count();
  }
  EXPECT_GT(counters().out_of_work, 0u);
  EXPECT_LE(counters().out_of_work, rendering);
}

/// Drives that count what they are asked for.
TEST_F(CycleRecordTest, AsksTheDrivesForSamplesAndTheirTime) {
  class Counting final : public hal::JointDrives {
   public:
    int joint_count() const noexcept override { return 7; }
    void request() noexcept override { ++requests; }
    std::int64_t collect_ns() const noexcept override { return 123'456; }
    void receive(hal::JointReading&) noexcept override {}
    double delay() const noexcept override { return 1e-3; }
    bool send(const hal::JointCommand&) noexcept override { return true; }
    int requests = 0;
  };
  Counting drives;
  setup_.memory = memory_.span();
  ControlCycle cycle(setup_, drives);
  cycle.request();
  EXPECT_EQ(drives.requests, 1);
  EXPECT_EQ(cycle.collect_ns(), 123'456);
  EXPECT_EQ(cycle.record().mode, Mode::kBoot);
  const CycleRecord& record = cycle.record();
  EXPECT_EQ(record.alarm_joint, -1);
  EXPECT_EQ(record.share + record.absorbed + record.injected_damping + record.penetration, 0.0);
  EXPECT_EQ(record.contacts + record.lost, 0u);
  EXPECT_FALSE(record.clutch_is_open);
}

/// A request to end, and one to reset, reach the supervisor.
TEST_F(CycleRecordTest, PassesTheOperatorsRequestsOn) {
  make();
  run_to(Mode::kRunning);
  drives_.reading.emergency_stop = true;
  run_to(Mode::kStopped);
  drives_.reading.emergency_stop = drives_.reading.enable_switch = false;
  step();
  EXPECT_EQ(record().mode, Mode::kStopped);
  LoopEvents events;
  events.reset_requested = true;
  step(events);
  EXPECT_EQ(record().mode, Mode::kResetting);
  run_to(Mode::kIdle);
  EXPECT_EQ(record().fault, Fault::kNone);
  events = {};
  events.end_requested = true;
  step(events);
  EXPECT_EQ(record().mode, Mode::kEnded);
}

/// Joints that yield to what pushes them beside gravity pass the sign test. After an alarm and a reset it is repeated
/// only if a drive has restarted: that drive may have been exchanged.
TEST_F(CycleRecordTest, RepeatsTheSignTestOnlyAfterADriveHasRestarted) {
  setup_.supervisor.sign_test = true;
  make();
  for (int i = 0; i < 5000 && record().mode != Mode::kRunning; ++i) {
    step();
    JointVector& q = drives_.reading.position;
    const JointVector push = drives_.sent.torque - gravity_torque(arm_.model, forward_kinematics(arm_.model, q));
    for (int k = 0; k < 7; ++k) {
      const double limit = arm_.model.joints[static_cast<std::size_t>(k)].torque;
      const double rest = q0_[k] + (record().mode == Mode::kSignTest ? 2.0 * push[k] / limit : 0.0);
      q[k] += 0.1 * (rest - q[k]);
    }
  }
  ASSERT_EQ(record().mode, Mode::kRunning);
  const auto mode_after = [&](hal::Alarm alarm) {
    drives_.reading.alarm = alarm;
    step();
    EXPECT_EQ(record().fault, Fault::kAlarm);
    drives_.reading.alarm = hal::Alarm::kNone;
    run_to(Mode::kStopped);
    drives_.reading.enable_switch = false;
    LoopEvents events;
    events.reset_requested = true;
    step(events);
    run_to(Mode::kIdle);
    step();
    drives_.reading.enable_switch = true;
    run_to(Mode::kEnabling);
    for (int i = 0; i < 1000 && record().mode == Mode::kEnabling; ++i) step();
    return record().mode;
  };
  EXPECT_EQ(mode_after(hal::Alarm::kHeartbeatLost), Mode::kArmed);
  run_to(Mode::kRunning);
  EXPECT_EQ(mode_after(hal::Alarm::kNodeReset), Mode::kSignTest);
}

/// The record of a stop names the joint that shows the fault, until the fault is reset.
TEST_F(CycleRecordTest, NamesTheJointOfTheFault) {
  using Harm = std::function<void(hal::JointReading&)>;
  struct Case {
    Fault fault;
    int joint;
    Harm harm;
  };
  double far = 0.0;
  const std::vector<Case> cases{
      {Fault::kPositionLost, 2, [](hal::JointReading& reading) { ++reading.age[2]; }},
      {Fault::kNotFinite, 5, [](hal::JointReading& reading) { reading.position[5] = std::nan(""); }},
      {Fault::kNotFinite, 1, [](hal::JointReading& reading) { reading.torque[1] = HUGE_VAL; }},
      {Fault::kPositionJump, 3, [&](hal::JointReading& reading) { reading.position[3] = q0_[3] + (far = 0.1 - far); }},
      {Fault::kDriveLeft, 6, [](hal::JointReading& reading) { reading.state[6] = hal::DriveState::kFault; }},
      {Fault::kAlarm, 4,
       [](hal::JointReading& reading) {
         reading.alarm = hal::Alarm::kDriveError;
         reading.alarm_joint = 4;
       }},
      {Fault::kTooFast, 1, [](hal::JointReading& reading) { reading.position[1] += 2.2e-3; }},
      {Fault::kEmergencyStop, -1, [](hal::JointReading& reading) { reading.emergency_stop = true; }},
  };
  for (const Case& one : cases) {
    drives_ = FakeDrives(7);
    drives_.reading.position = q0_;
    make();
    run_to(Mode::kRunning);
    EXPECT_EQ(record().fault_joint, -1);
    for (int i = 0; i < 50 && record().fault == Fault::kNone; ++i) {
      one.harm(drives_.reading);
      cycle_->run_once({});
    }
    EXPECT_EQ(record().fault, one.fault);
    EXPECT_EQ(record().fault_joint, one.joint) << static_cast<int>(one.fault);
    cycle_->run_once({});
    EXPECT_EQ(record().fault_joint, one.joint) << "it is that of the first cycle";
  }
}

TEST_F(CycleRecordTest, StopsForAnyAlarm) {
  for (int i = 1; i <= static_cast<int>(hal::Alarm::kTemperatureLost); ++i) {
    drives_ = FakeDrives(7);
    drives_.reading.position = q0_;
    make();
    run_to(Mode::kRunning);
    drives_.reading.alarm = static_cast<hal::Alarm>(i);
    step();
    EXPECT_EQ(record().fault, Fault::kAlarm) << i;
    EXPECT_STRNE(describe(drives_.reading.alarm), "unknown alarm");
  }
}

}  // namespace
}  // namespace godobject::firmware::cycle_record_test
