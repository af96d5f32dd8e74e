#include "firmware/cycle/control_cycle.h"

#include <gtest/gtest.h>

#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "core/device/dynamics.h"
#include "core/device/kinematics.h"
#include "tests/firmware/cycle/control_cycle_fixture.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/fault_record.h"

namespace godobject::firmware::control_cycle_test {
namespace {

TEST_F(ControlCycleTest, NeverRendersIfTheGodObjectWasNotStarted) {
  cycle_ = std::make_unique<ControlCycle>(setup_, drives_);
  ASSERT_EQ(cycle_->start(), Status::kMemory);  // refused, and the refusal ignored
  for (int i = 0; i < 1000; ++i) {
    step();
    ASSERT_EQ(cycle_->record().share, 0.0);
  }
  EXPECT_EQ(cycle_->record().fault, Fault::kComputation);
}

TEST_F(ControlCycleTest, SendsNothingButGravityInFreeSpace) {
  make();
  run_to(Mode::kRunning);
  for (int i = 0; i < 50; ++i) step();
  const JointVector gravity = gravity_torque(arm_.model, forward_kinematics(arm_.model, q0_));
  EXPECT_LT((drives_.sent.torque - gravity).norm(), 1e-9);
  EXPECT_EQ(drives_.sent.power, hal::PowerRequest::kEnable);
  EXPECT_LT((cycle_->record().H_WM.translation - Vector3(0.0, 0.0, 0.06)).norm(), 1e-12);
}

TEST_F(ControlCycleTest, RendersTheSpringOfAPressInJointTorques) {
  make();
  run_to(Mode::kRunning);
  press(0.033);  // the ball's surface touches at 30 mm; 3 mm more
  const CycleRecord& record = cycle_->record();
  EXPECT_EQ(record.outcome, Outcome::kContact);
  EXPECT_NEAR(record.F_G_R.force.z(), 2000.0 * 0.003, 0.1);
  EXPECT_NEAR(record.F_G_R.force.head<2>().norm(), 0.0, 0.05);
  const ArmKinematics kinematics = forward_kinematics(arm_.model, drives_.reading.position);
  const Jacobian J = geometric_jacobian(kinematics, kinematics.H_RM.translation);
  Eigen::Matrix<double, 6, 1> F;
  F << record.F_G_R.force, record.F_G_R.torque;
  const JointVector expected = gravity_torque(arm_.model, kinematics) + J.transpose() * F;
  EXPECT_LT((drives_.sent.torque - expected).norm(), 1e-6);
  EXPECT_NEAR(record.god_object_W.translation.z(), 0.03, 1e-4);
}

TEST_F(ControlCycleTest, HasTheHandAtTheCentreOfMassAndDrivesTheToolsOrigin) {
  scene_.H_MB.translation = Vector3(0.0, 0.02, 0.0);  // in M
  make();
  run_to(Mode::kRunning);
  press(0.033);
  const CycleRecord& record = cycle_->record();
  ASSERT_GT(record.F_G_R.force.norm(), 1.0);
  EXPECT_LT(record.F_G_R.torque.norm(), 0.02);
  const ArmKinematics kinematics = forward_kinematics(arm_.model, drives_.reading.position);
  const Vector3 hand = kinematics.H_RM * scene_.H_MB.translation;
  const Jacobian J = geometric_jacobian(kinematics, hand);
  Eigen::Matrix<double, 6, 1> F;
  F << record.F_G_R.force, record.F_G_R.torque;
  const JointVector expected = gravity_torque(arm_.model, kinematics) + J.transpose() * F;
  EXPECT_LT((drives_.sent.torque - expected).norm(), 1e-6);
}

TEST_F(ControlCycleTest, KeepsForceAndTorqueAtTheHandWithinTheirLimits) {
  setup_.hand.force = 4.0;
  make();
  run_to(Mode::kRunning);
  press(0.040);
  EXPECT_NEAR(cycle_->record().F_G_R.force.norm(), 4.0, 1e-9);
  EXPECT_GT(cycle_->counters().clipped, 0u);
}

TEST_F(ControlCycleTest, FeelsTheSquareOfTheScaleAsStiffness) {
  setup_.mapping.scale = 0.5;
  const Pose H_RM = forward_kinematics(arm_.model, q0_).H_RM;
  setup_.mapping.H_WR.translation = Vector3(0.0, 0.0, 0.06) - 0.5 * H_RM.translation;
  make();
  run_to(Mode::kRunning);
  press(0.064);  // 60 mm until it touches, 4 mm more
  EXPECT_NEAR(cycle_->record().F_G_R.force.z(), 0.25 * 2000.0 * 0.004, 0.05);
}

TEST_F(ControlCycleTest, ArmsInContactOnlyOnceTheToolIsWithdrawn) {
  drives_.reading.position = moved(Vector3(0.0, 0.0, -0.035));
  make();
  run_to(Mode::kArmed);
  const JointVector inside = drives_.reading.position;
  for (int i = 0; i < 300; ++i) {
    step();
    ASSERT_EQ(cycle_->record().share, 0.0);
    ASSERT_LT((drives_.sent.torque - gravity_torque(arm_.model, forward_kinematics(arm_.model, inside))).norm(), 1e-9);
  }
  for (int i = 0; i <= 200; ++i) {
    drives_.reading.position = moved(Vector3(0.0, 0.0, -0.035 + 0.035 * i / 200.0));
    step();
  }
  EXPECT_EQ(cycle_->record().mode, Mode::kRunning);
}

/// Through the clutch the mesh is turned against the tool: the hand still holds it by its centre of mass.
TEST_F(ControlCycleTest, ClutchThatTurnsTheMeshGivesNoWorkOnAClosedPath) {
  scene_.H_MB.translation = Vector3(0.0, 0.05, 0.0);  // in M
  scene_.settings.damping = 0.0;
  arm_.parameters.null_damping.setZero();
  make();
  run_to(Mode::kRunning);
  const auto pushed = [&] {
    return JointVector(drives_.sent.torque -
                       gravity_torque(arm_.model, forward_kinematics(arm_.model, drives_.reading.position)));
  };
  double work = 0.0;
  const auto go = [&](const JointVector& to, int cycles) {
    const JointVector from = drives_.reading.position;
    for (int i = 1; i <= cycles; ++i) {
      const JointVector before = pushed();
      const JointVector next = from + (0.5 - 0.5 * std::cos(M_PI * i / cycles)) * (to - from);
      const JointVector motion = next - drives_.reading.position;
      drives_.reading.position = next;
      step();
      work += 0.5 * (before + pushed()).dot(motion);
    }
  };
  JointVector turned = q0_;
  turned[6] += 1.2;
  drives_.reading.clutch_open = true;
  go(turned, 2000);
  drives_.reading.clutch_open = false;
  go(turned, 300);
  ASSERT_EQ(cycle_->record().mode, Mode::kRunning) << describe(cycle_->record().fault);
  const auto hand = [&] {
    return forward_kinematics(arm_.model, drives_.reading.position).H_RM * scene_.H_MB.translation;
  };
  const auto centre = [&] { return cycle_->record().H_WM * scene_.H_MB.translation; };
  const Vector3 away = centre() - hand();
  EXPECT_LT((centre() - Vector3(0.0, 0.05, 0.06)).norm(), 0.1) << "over the plate";

  // down to 4 mm into the plate, 0.2 rad over there, and back
  const auto lowered = [&](JointVector q, double height) {
    for (int i = 0; i < 20; ++i) {
      const ArmKinematics kinematics = forward_kinematics(arm_.model, q);
      const Vector3 at = kinematics.H_RM * scene_.H_MB.translation;
      const Jacobian J = geometric_jacobian(kinematics, at);
      q += J.row(2).transpose() * (height - (at + away).z()) / J.row(2).squaredNorm();
    }
    return q;
  };
  JointVector tilted = turned;
  tilted[5] += 0.1;
  tilted[6] += 0.1;
  const JointVector pressed = lowered(turned, 0.026);
  const JointVector pressed_tilted = lowered(tilted, 0.027);
  go(lowered(turned, 0.032), 500);
  work = 0.0;
  const JointVector begin = drives_.reading.position;
  go(pressed, 500);
  const double stored = -work;
  EXPECT_NEAR(stored, 0.5 * 2000.0 * 0.004 * 0.004, 3e-3) << "[J]";
  EXPECT_LT((centre() - hand() - away).norm(), 1e-9) << "they move alike";
  go(pressed_tilted, 2000);
  EXPECT_LT((centre() - hand() - away).norm(), 1e-9) << "they move alike";
  go(begin, 500);
  std::printf("[ measured ] %.4f mJ stored, %.4f mJ given in a closed path\n", 1e3 * stored, 1e3 * work);
  EXPECT_LT(std::fabs(work), 0.02 * stored);
}

/// In and out of the plate again and again, without b_D: the delay gives energy, which the telemetry tells and the
/// passivity controller pays back.
TEST_F(ControlCycleTest, TellsTheEnergyThatTheDelayGivesAndPaysItBack) {
  scene_.settings.damping = 0.0;
  double given[2] = {};
  for (const bool controlled : {false, true}) {
    setup_.passivity = {controlled ? 50.0 : 0.0, CycleSetup().period, 0.16};
    drives_ = FakeDrives(7);
    drives_.reading.position = q0_;
    make();
    run_to(Mode::kRunning);
    EXPECT_EQ(cycle_->record().absorbed, 0.0);
    std::vector<JointVector> way;
    for (int i = 0; i <= 100; ++i) way.push_back(moved(Vector3(0.0, 0.0, -0.033 * i / 100.0)));
    JointVector sent = JointVector::Zero();
    JointVector acts = JointVector::Zero();  // a period later, as FakeDrives say
    double work = 0.0;
    double injected = 0.0;
    for (int i = 0; i < 4 * 200; ++i) {
      const int at = i % 200;
      const JointVector next = way[static_cast<std::size_t>(at <= 100 ? at : 200 - at)];
      work += acts.dot(next - drives_.reading.position);
      drives_.reading.position = next;
      step();
      acts = sent;
      sent = drives_.sent.torque - gravity_torque(arm_.model, forward_kinematics(arm_.model, next));
      ASSERT_NEAR(cycle_->record().absorbed, -work, 1e-12) << i;
      ASSERT_GE(cycle_->record().F_G_R.force.z(), 0.0) << "it pulls";
      injected = std::max(injected, cycle_->record().injected_damping);
    }
    ASSERT_EQ(cycle_->record().mode, Mode::kRunning) << describe(cycle_->record().fault);
    given[controlled ? 1 : 0] = work;
    EXPECT_EQ(injected > 0.0, controlled);
    EXPECT_LE(injected, 50.0);
  }
  // four presses of 3 mm at 0.33 m/s: K (T/2 + t_d) v x a way, both ways
  EXPECT_NEAR(given[0], 4.0 * 2.0 * 2000.0 * 1.5e-3 * 0.33 * 0.003, 0.2 * given[0]);
  EXPECT_LT(given[1], 0.5 * given[0]);
}

/// Torques act 20 periods after they were sent. Those of a first contact act while the hand is outside again and goes
/// down: they take energy. The hand touches the plate again after 19 periods, while they still act. When it goes up,
/// the torques of the second contact give less than that surplus, so nothing is damped.
TEST_F(ControlCycleTest, RemembersTheEnergyThatTorquesTakeAfterALongDelay) {
  scene_.settings.damping = 0.0;
  setup_.passivity = {50.0, CycleSetup().period, 0.16};
  drives_.torque_delay = 20.0 * CycleSetup().period;
  make();
  run_to(Mode::kRunning);
  struct Stretch {
    int periods;
    double height;  // of the tool over the contact at its end [m]
  };
  double height = 0.03;
  double surplus = 0.0;
  for (const auto& [periods, end] : std::vector<Stretch>{
           {60, 0.001}, {6, -0.002}, {6, 0.001}, {6, 0.004}, {4, 0.004}, {10, -0.001}, {24, -0.001}, {4, -0.0004}}) {
    const double begin = height;
    for (int k = 1; k <= periods; ++k) {
      height = begin + (end - begin) * k / periods;
      drives_.reading.position = moved(Vector3(0.0, 0.0, height - 0.03));
      step();
      surplus = std::max(surplus, cycle_->record().absorbed);
      const bool rounded = surplus < 1e-9;
      EXPECT_TRUE(rounded || cycle_->record().injected_damping == 0.0) << height << ", period " << k;
    }
  }
  EXPECT_GT(surplus, 5e-3) << "[J]";
  EXPECT_NEAR(surplus - cycle_->record().absorbed, 2.0 * 0.6e-3, 1e-4) << "2 N over 0.6 mm are given back";
}

TEST_F(ControlCycleTest, EstimatesTheVelocityOverPeriodsThatWereSkipped) {
  make();
  run_to(Mode::kRunning);
  for (int i = 0; i < 40; ++i) {
    drives_.reading.position[0] += 1e-3 * 0.4;
    step();
  }
  ASSERT_NEAR(cycle_->record().qd[0], 0.4, 1e-9);
  drives_.reading.position[0] += 3e-3 * 0.4;
  LoopEvents late;
  late.overrun_ns = 2'100'000;
  late.skipped = 2;
  step(late);
  EXPECT_NEAR(cycle_->record().qd[0], 0.4, 1e-9);
  EXPECT_EQ(cycle_->counters().overruns, 1u);
  EXPECT_EQ(cycle_->counters().skipped, 2u);
}

TEST_F(ControlCycleTest, ExtrapolatesNothingFromBeforeTheFirstPosition) {
  make();
  drives_.reading.position.setZero();  // no drive has answered yet
  drives_.reading.state.fill(hal::DriveState::kUnavailable);
  drives_.reading.age.fill(9);
  for (int i = 0; i < 5; ++i) step();
  drives_.reading.position = q0_;
  drives_.reading.state.fill(hal::DriveState::kOff);
  drives_.reading.age.fill(0);
  step();
  ASSERT_EQ(cycle_->record().mode, Mode::kZeroCheck);
  drives_.reading.age.fill(1);  // the second one is lost
  step();
  EXPECT_EQ(cycle_->record().q, q0_);
  EXPECT_TRUE(cycle_->record().qd.isZero(0.0));
}

/// An operator's panel may be heard before the drives are.
TEST_F(ControlCycleTest, ClutchThatIsOpenBeforeTheDrivesAnswerDoesNotShiftTheScene) {
  make();
  drives_.reading.position.setZero();
  drives_.reading.state.fill(hal::DriveState::kUnavailable);
  drives_.reading.age.fill(9);
  drives_.reading.clutch_open = true;
  for (int i = 0; i < 5; ++i) step();
  drives_.reading.position = q0_;
  drives_.reading.state.fill(hal::DriveState::kOff);
  drives_.reading.age.fill(0);
  for (int i = 0; i < 5; ++i) step();
  drives_.reading.clutch_open = false;
  run_to(Mode::kRunning);
  EXPECT_LT((cycle_->record().H_WM.translation - Vector3(0.0, 0.0, 0.06)).norm(), 1e-12);
}

TEST_F(ControlCycleTest, StopsInTheCycleOfAReadingThatIsNotFinite) {
  for (int joint = 0; joint < 7; ++joint) {
    drives_ = FakeDrives(7);
    drives_.reading.position = q0_;
    make();
    run_to(Mode::kRunning);
    press(0.033);
    const JointVector q = drives_.reading.position;
    drives_.reading.position[joint] = std::numeric_limits<double>::quiet_NaN();
    step();
    EXPECT_EQ(cycle_->record().fault, Fault::kNotFinite);
    const JointVector gravity = gravity_torque(arm_.model, forward_kinematics(arm_.model, q));
    EXPECT_LT((drives_.sent.torque - gravity).norm(), 1e-9) << "the arm is held, nothing is rendered";
    for (int i = 0; i < 50; ++i) step();
    EXPECT_EQ(drives_.sent.power, hal::PowerRequest::kOff);
  }
}

/// The run ends in a cycle without a position, then a pause follows: over it no velocity is known. The cycle says so;
/// the next one knows its velocity again.
TEST_F(ControlCycleTest, TellsThatAPauseAfterNoPositionHasNoVelocity) {
  for (int joint = 0; joint < 7; ++joint) {
    drives_ = FakeDrives(7);
    drives_.reading.position = q0_;
    make();
    drives_.reading.position[joint] = std::numeric_limits<double>::quiet_NaN();
    LoopEvents end;
    end.end_requested = true;
    step(end);
    ASSERT_EQ(cycle_->record().mode, Mode::kEnded);
    EXPECT_EQ(cycle_->record().status, Status::kNotFinite);
    drives_.reading.position = q0_;
    LoopEvents late;
    late.skipped = 2;
    step(late);
    EXPECT_EQ(cycle_->record().status, Status::kNotFinite) << joint;
    EXPECT_TRUE(cycle_->record().qd.isZero(0.0)) << joint;
    step();
    EXPECT_EQ(cycle_->record().status, Status::kOk) << joint;
    EXPECT_EQ(drives_.sent.power, hal::PowerRequest::kOff);
  }
}

/// Numbers of the arm that spoil the tool's pose, or the gravity torque alone, stand for any error in the computation.
TEST_F(ControlCycleTest, HoldsTheArmAsInTheCycleBeforeWhenItsPoseOrGravityIsNotFinite) {
  for (double* number : {&arm_.model.joints[6].a, &arm_.model.H_RA.translation[0], &arm_.model.H_FM.translation[1],
                         &arm_.model.gravity_R[2]}) {
    drives_ = FakeDrives(7);
    drives_.reading.position = q0_;
    make();
    run_to(Mode::kRunning);
    press(0.033);
    const JointVector gravity = gravity_torque(arm_.model, forward_kinematics(arm_.model, drives_.reading.position));
    ASSERT_GT(gravity.norm(), 1.0);
    const double good = *number;
    *number = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < 2; ++i) {
      step();
      EXPECT_EQ(cycle_->record().status, Status::kNotFinite);
      EXPECT_EQ(cycle_->record().fault, Fault::kComputation);
      EXPECT_LT((drives_.sent.torque - gravity).norm(), 1e-9) << "the arm is held, nothing is rendered";
    }
    *number = good;
  }
}

/// Calls `each` with every number of the arm that a cycle computes with.
template <class Each>
void each_number(ArmModel& arm, Each&& each) {
  for (ArmJoint* joint : {&arm.joints[1], &arm.joints[6]}) {
    for (double* number : {&joint->a, &joint->alpha, &joint->d, &joint->offset, &joint->lower, &joint->upper,
                           &joint->velocity, &joint->torque, &joint->link.mass, &joint->link.com[0]}) {
      each(*number);
    }
  }
  for (double* number : {&arm.gravity_R[2], &arm.payload.mass, &arm.payload.com[1], &arm.H_RA.translation[0],
                         &arm.H_FM.translation[1], &arm.H_FM.rotation.coeffs()[2]}) {
    each(*number);
  }
}

/// Calls `each` with every number of the controller file and the scene that a cycle computes with.
template <class Each>
void each_number(CycleSetup& setup, JointTorqueParameters& torque, SceneView& scene, Each&& each) {
  for (double* number : {&torque.rotation_length,
                         &torque.singular_none,
                         &torque.singular_full,
                         &torque.null_damping[2],
                         &torque.limit_band,
                         &torque.limit_stiffness[3],
                         &torque.limit_damping[3],
                         &setup.mapping.scale,
                         &setup.mapping.fade_time,
                         &setup.mapping.H_WR.translation[0],
                         &setup.mapping.H_WR.rotation.coeffs()[0],
                         &setup.stuck_torque,
                         &setup.passivity.most_damping,
                         &setup.passivity.period,
                         &setup.passivity.rotation_length,
                         &setup.hand.force,
                         &setup.hand.torque,
                         &setup.hand.speed,
                         &setup.hand.speed_stop,
                         &setup.hand.turn,
                         &setup.hand.turn_stop,
                         &setup.torque.rate,
                         &setup.torque.joint_speed,
                         &setup.torque.joint_speed_stop,
                         &setup.supervisor.engage_force,
                         &scene.settings.stiffness,
                         &scene.settings.damping,
                         &scene.settings.coupling_rotation,
                         &scene.H_MB.translation[1]}) {
    each(*number);
  }
}

/// The property is that of the last place before the bus: whatever a cycle computes, the drives get numbers. The start
/// refuses these values; here they stand for any error in the computation.
TEST_F(ControlCycleTest, SendsOnlyFiniteTorquesWhateverItComputes) {
  std::vector<JointVector> path;
  for (int i = 0; i <= 40; ++i) path.push_back(moved(Vector3(0.0, 0.0, -0.033 * i / 40.0)));
  int values = 0;
  int faults = 0;
  const auto runs_with = [&](double& number) {
    const double good = number;
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e308}) {
      drives_ = FakeDrives(7);
      drives_.reading.position = q0_;
      number = bad;
      setup_.memory = memory_.span();
      cycle_ = std::make_unique<ControlCycle>(setup_, drives_);
      const Status started = cycle_->start();
      for (int i = 0; i < 260; ++i) {
        drives_.reading.position = path[static_cast<std::size_t>(std::clamp(i - 210, 0, 40))];
        cycle_->run_once({});
        ASSERT_TRUE(drives_.sent.torque.allFinite()) << "value " << values << " as " << bad << ", cycle " << i;
      }
      faults += started != Status::kOk || cycle_->record().fault != Fault::kNone ? 1 : 0;
    }
    number = good;
    ++values;
  };
  each_number(arm_.model, runs_with);
  each_number(setup_, arm_.parameters, scene_, runs_with);
  std::printf("%d values, each as 4 that are impossible: %d runs stopped\n", values, faults);
  EXPECT_GT(faults, values) << "these values reach the computation";
}

TEST_F(ControlCycleTest, PredictsOverOneJumpAndStopsAtTheSecond) {
  make();
  run_to(Mode::kRunning);
  const double q = drives_.reading.position[3];
  drives_.reading.position[3] = q + 0.01;
  step();
  EXPECT_EQ(cycle_->record().mode, Mode::kRunning);
  EXPECT_NEAR(cycle_->record().q[3], q, 1e-12);
  drives_.reading.position[3] = q;
  step();
  EXPECT_EQ(cycle_->record().fault, Fault::kNone);
  drives_.reading.position[3] = q + 0.01;
  step();
  step();
  EXPECT_EQ(cycle_->record().fault, Fault::kPositionJump);
  EXPECT_EQ(cycle_->record().share, 0.0);
}

TEST_F(ControlCycleTest, FadesWhenAPositionIsLostThreeTimes) {
  make();
  run_to(Mode::kRunning);
  press(0.033);
  const JointVector held = drives_.sent.torque;
  const JointVector gravity = gravity_torque(arm_.model, forward_kinematics(arm_.model, drives_.reading.position));
  for (std::uint32_t k = 1; k <= 8; ++k) {
    drives_.reading.age[2] = k;
    step();
    const double share = k <= 2 ? 1.0 : std::max(0.0, 1.0 - 0.2 * (k - 2));
    EXPECT_LT((drives_.sent.torque - gravity - share * (held - gravity)).norm(), 1e-6) << k;
  }
  EXPECT_EQ(cycle_->record().mode, Mode::kStopping);
}

TEST_F(ControlCycleTest, CountsSendsThatFailAndStopsAtTheThirdInARow) {
  make();
  run_to(Mode::kRunning);
  for (int i = 0; i < 30; ++i) {
    drives_.fails_to_send = i % 3 != 0;
    step();
  }
  EXPECT_EQ(cycle_->record().fault, Fault::kNone);
  EXPECT_EQ(cycle_->counters().sends_failed, 20u);
  drives_.fails_to_send = false;
  step();
  drives_.fails_to_send = true;
  int cycles = 0;
  while (cycle_->record().fault == Fault::kNone && cycles < 10) {
    step();
    ++cycles;
  }
  EXPECT_EQ(cycles, 4);
  EXPECT_EQ(cycle_->record().fault, Fault::kSendFailed);
}

TEST_F(ControlCycleTest, StopsWithTheGodObjectAtTheToolWhereverThatIs) {
  make();
  run_to(Mode::kRunning);
  press(0.035);
  ASSERT_GT((cycle_->record().H_WM.translation - cycle_->record().god_object_W.translation).norm(), 1e-3);
  drives_.reading.emergency_stop = true;
  step();
  drives_.reading.position = moved(Vector3(0.0, 0.0, -0.040));
  step();
  EXPECT_EQ(cycle_->record().fault, Fault::kEmergencyStop);
  EXPECT_LT((cycle_->record().H_WM.translation - cycle_->record().god_object_W.translation).norm(), 1e-15);
  EXPECT_EQ(cycle_->record().outcome, Outcome::kFree) << "nobody looks at the scene any more";
}

/// Some cycles near the plate take more than 80,000 units. Only rendering cycles count: in others nobody feels where
/// the god object stays.
TEST_F(ControlCycleTest, CountsRenderingCyclesInARowThatTheBudgetOfWorkEnded) {
  setup_.work_budget = 80'000;
  make();
  run_to(Mode::kRunning);
  std::uint64_t ended = 0;
  std::uint64_t most = 0;
  int rows = 0;
  const auto watched_step = [&] {
    const std::uint64_t before = cycle_->record().behind;
    step();
    const std::uint64_t behind = cycle_->record().behind;
    EXPECT_TRUE(behind == 0 || behind == before + 1);
    rows += behind == 1 ? 1 : 0;
    ended += behind > 0 ? 1u : 0u;
    most = std::max(most, behind);
    EXPECT_EQ(cycle_->counters().out_of_work, ended);
    EXPECT_EQ(cycle_->counters().most_out_of_work, most);
  };
  for (int i = 0; i < 4000 && (rows < 2 || cycle_->record().behind == 0); ++i) {  // down and up again and again
    drives_.reading.position = moved(Vector3(0.0, 0.0, -0.03 * (1.0 - std::cos(M_PI * i / 100.0))));
    watched_step();
  }
  ASSERT_GE(rows, 2);
  ASSERT_GT(most, 1u);
  drives_.reading.emergency_stop = true;
  watched_step();
  ASSERT_EQ(cycle_->record().share, 0.0);
  EXPECT_EQ(cycle_->record().behind, 0u);
}

TEST_F(ControlCycleTest, IsNotBehindWithoutABudgetOfWork) {
  make();
  run_to(Mode::kRunning);
  press(0.06);
  EXPECT_GT(cycle_->record().contacts, 0u);
  EXPECT_EQ(cycle_->record().behind, 0u);
  EXPECT_EQ(cycle_->counters().out_of_work, 0u);
}

TEST_F(ControlCycleTest, StopsBeyondAJointLimit) {
  make();
  run_to(Mode::kRunning);
  int beyond = 0;  // cycles
  for (int i = 0; i < 5000 && cycle_->record().share > 0.0; ++i) {
    drives_.reading.position[0] += 1e-3;  // 1 rad/s of 1.92
    beyond += drives_.reading.position[0] > arm_.model.joints[0].upper ? 1 : 0;
    step();
  }
  EXPECT_EQ(cycle_->record().fault, Fault::kJointLimit);
  EXPECT_NEAR(drives_.reading.position[0], arm_.model.joints[0].upper, 1.01e-3);
  EXPECT_LE(beyond, 5);
  godobject::test::record({.reaction = cycle_->record().mode == Mode::kStopping ? "STOP" : "none",
                           .found = describe(cycle_->record().fault),
                           .after = name(cycle_->record().mode),
                           .cycles = beyond});
}

TEST_F(ControlCycleTest, StopsBeyondASpeed) {
  make();
  run_to(Mode::kRunning);
  for (int i = 0; i < 100 && cycle_->record().fault == Fault::kNone; ++i) {
    drives_.reading.position[0] += 2e-3;  // 2 rad/s of 1.92
    step();
  }
  EXPECT_EQ(cycle_->record().fault, Fault::kTooFast);
}

/// The hand is too fast, but no joint is. After a stop only what the hand does now counts: the arm runs again.
TEST_F(ControlCycleTest, RunsAgainAfterAHandThatWasTooFast) {
  setup_.hand.speed = 0.05;
  setup_.hand.speed_stop = 0.1;
  make();
  run_to(Mode::kRunning);
  for (int i = 0; i < 100 && cycle_->record().fault == Fault::kNone; ++i) {
    drives_.reading.position[0] += 3e-4;
    step();
  }
  EXPECT_EQ(cycle_->record().fault, Fault::kTooFast);
  run_to(Mode::kStopped);
  drives_.reading.enable_switch = false;
  for (int i = 0; i < 200; ++i) step();
  LoopEvents reset;
  reset.reset_requested = true;
  step(reset);
  run_to(Mode::kIdle);
  for (int i = 0; i < 200; ++i) step();
  drives_.reading.enable_switch = true;
  run_to(Mode::kRunning);
}

/// GODOBJECT_CYCLES=1000000 for a longer look: none in N cycles bounds the rate at 3 / N only.
int cycles_to_look_at() {
  const char* wanted = std::getenv("GODOBJECT_CYCLES");
  return wanted != nullptr ? std::max(1, std::atoi(wanted)) : 100'000;
}

long page_faults() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_majflt + usage.ru_minflt;
}

TEST_F(ControlCycleTest, AsksForNeitherHeapNorPages) {
  if (!test::AllocationGuard::works()) GTEST_SKIP() << "the sanitizer keeps malloc to itself";
  make();
  run_to(Mode::kRunning);
  const JointVector above = moved(Vector3(0.0, 0.0, -0.025));
  const JointVector below = moved(Vector3(0.01, 0.0, -0.035));
  for (int i = 1; i <= 100; ++i) {
    drives_.reading.position = q0_ + i / 100.0 * (above - q0_);
    step();
  }
  const int cycles = cycles_to_look_at();
  const bool locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;  // as on the device
  const test::AllocationGuard guard;
  const long faults_before = page_faults();
  int in_contact = 0;
  for (int i = 0; i < cycles; ++i) {
    drives_.reading.position = above + (0.5 - 0.5 * std::cos(2.0 * M_PI * i / 1000.0)) * (below - above);
    cycle_->run_once({});
    in_contact += cycle_->record().outcome == Outcome::kContact ? 1 : 0;
  }
  const long faults = page_faults() - faults_before;
  const auto calls = static_cast<long>(guard.allocations() + guard.releases());
  std::printf("%d cycles, %d of them in contact: %ld calls of the heap, %ld page faults%s\n", cycles, in_contact, calls,
              faults, locked ? "" : " (not judged: memory could not be locked)");
  EXPECT_EQ(calls, 0);
  EXPECT_TRUE(faults == 0 || !locked);
  EXPECT_GT(in_contact, cycles / 4);
  EXPECT_EQ(cycle_->record().fault, Fault::kNone);
}

/// A thread's stack, painted before it runs, tells afterwards how deep it went.
TEST_F(ControlCycleTest, NeedsLittleStack) {
  if (!test::AllocationGuard::works()) GTEST_SKIP() << "a sanitizer makes stacks of its own";
  constexpr std::size_t kStack = 1024 * 1024;
  static constexpr unsigned char kPaint = 0xA5;
  constexpr std::size_t kMost = 128 * 1024;  // half of what is touched at the start
  make();
  run_to(Mode::kRunning);
  const JointVector above = moved(Vector3(0.0, 0.0, -0.025));
  const JointVector below = moved(Vector3(0.01, 0.0, -0.035));
  const auto cycles = [&] {
    for (int i = 0; i < 3000; ++i) {
      drives_.reading.position = above + (0.5 - 0.5 * std::cos(2.0 * M_PI * i / 1000.0)) * (below - above);
      cycle_->run_once({});
    }
  };
  for (int i = 1; i <= 100; ++i) {
    drives_.reading.position = q0_ + i / 100.0 * (above - q0_);
    step();
  }
  void* memory = mmap(nullptr, kStack, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  const std::span<unsigned char> stack(static_cast<unsigned char*>(memory), kStack);
  const auto deepest = [&](auto&& body) {
    std::fill(stack.begin(), stack.end(), kPaint);
    pthread_attr_t attributes;
    EXPECT_EQ(pthread_attr_init(&attributes), 0);
    EXPECT_EQ(pthread_attr_setstack(&attributes, memory, kStack), 0);
    pthread_t thread{};
    using Body = std::remove_reference_t<decltype(body)>;
    const auto run = [](void* what) -> void* {
      (*static_cast<Body*>(what))();
      return nullptr;
    };
    EXPECT_EQ(pthread_create(&thread, &attributes, run, const_cast<std::remove_const_t<Body>*>(&body)), 0);
    EXPECT_EQ(pthread_join(thread, nullptr), 0);
    pthread_attr_destroy(&attributes);
    const auto first = std::find_if(stack.begin(), stack.end(), [](unsigned char byte) { return byte != kPaint; });
    return static_cast<std::size_t>(stack.end() - first);
  };
  const std::size_t thread_alone = deepest([] {});
  const std::size_t with_cycles = deepest(cycles);
  EXPECT_EQ(munmap(memory, kStack), 0);
  EXPECT_EQ(cycle_->record().fault, Fault::kNone);
  ASSERT_GT(with_cycles, thread_alone);
  std::printf("[ measured ] %zu bytes of stack for 3000 cycles in and out of contact, %zu of them the thread's own\n",
              with_cycles, thread_alone);
  EXPECT_LT(with_cycles, kMost);
}

}  // namespace
}  // namespace godobject::firmware::control_cycle_test
