#include "toolchain/report/extremes/led_arm.h"

#include <memory>

#include <Eigen/LU>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/aligned_bytes.h"

namespace godobject::report {
namespace {

using namespace firmware;

constexpr int kStartCycles = 400;  ///< more than the drives need to get power

/// Drives whose joints are at given positions; they are enabled at once.
class LedDrives final : public hal::JointDrives {
 public:
  explicit LedDrives(int joint_count) : joint_count_(joint_count) {}

  int joint_count() const noexcept override { return joint_count_; }
  void request() noexcept override {}
  std::int64_t collect_ns() const noexcept override { return 0; }
  double delay() const noexcept override { return CycleSetup().period; }

  /// The enable switch is held once it was seen released.
  void receive(hal::JointReading& reading) noexcept override {
    reading.position = position;
    reading.torque = sent;
    reading.state.fill(state_);
    reading.enable_switch = ++cycles_ > kStartCycles / 2;
  }

  bool send(const hal::JointCommand& command) noexcept override {
    sent = command.torque;
    state_ = command.power == hal::PowerRequest::kEnable ? hal::DriveState::kEnabled : hal::DriveState::kOff;
    return true;
  }

  JointVector position = JointVector::Zero();
  JointVector sent = JointVector::Zero();

 private:
  int joint_count_;
  int cycles_ = 0;
  hal::DriveState state_ = hal::DriveState::kOff;
};

/// Returns joint positions with the tool at H_RM, by Newton's method from a near posture.
JointVector reached(const ArmModel& model, JointVector q, const Pose& H_RM) {
  constexpr double kSingular = 1e-6;  // keeps the step finite at singular postures
  for (int i = 0; i < 3; ++i) {
    const ArmKinematics kinematics = forward_kinematics(model, q);
    Eigen::Matrix<double, 6, 1> off;
    off << H_RM.translation - kinematics.H_RM.translation,
        log_rotation(H_RM.rotation * kinematics.H_RM.rotation.conjugate());
    const Jacobian J = geometric_jacobian(kinematics, kinematics.H_RM.translation);
    Eigen::Matrix<double, 6, 6> A = J * J.transpose();
    A.diagonal().array() += kSingular;
    q += J.transpose() * A.inverse() * off;
  }
  return q;
}

/// The controller without its supervisor; it renders fully from the first cycle on.
class Unsupervised {
 public:
  Unsupervised(const LedArm& arm, const CycleSetup& setup)
      : setup_(setup), limiter_(*setup.arm, setup.torque), reports_(arm.fault) {
    if (god_object_.start(*arm.scene, arm.solver, arm.friction) != Status::kOk) {
      throw command::Failure(command::ExitCode::kInternal, "the scene lacks the solver");
    }
  }

  /// Runs a cycle at the positions of the controller's record.
  void cycle(LedCycle& cycle) {
    TorqueRequest request;
    request.q = cycle.record.q;
    request.qd = cycle.record.qd;
    request.kinematics = forward_kinematics(*setup_.arm, request.q);
    request.p_RP = request.kinematics.H_RM * setup_.scene->H_MB.translation;
    const Motion velocity = tool_velocity(geometric_jacobian(request.kinematics, request.p_RP), request.qd);
    const Status status = god_object_->update({cycle.record.H_WM, velocity}, report_);
    reports_.spoil(report_);
    if (status == Status::kOk) {
      const Wrench& F_G_R = report_.force.total_W;  // this workspace is neither turned nor scaled
      request.F_P_R = limit_at_hand(setup_.hand, F_G_R, velocity).F_G_R;
    }
    JointTorque torque;
    static_cast<void>(joint_torque(*setup_.arm, *setup_.joint_torque, request, torque));
    Decision all;
    all.holds_arm = true;
    all.share = 1.0;
    cycle.computed_at_once = torque.torque;
    cycle.sent_at_once = limiter_.apply(all, {torque.gravity, torque.torque - torque.gravity}, request.qd);
    cycle.F_B_W = report_.force.total_W;
    cycle.outcome = report_.outcome;
    cycle.contacts = report_.contacts;
  }

 private:
  CycleSetup setup_;
  OwnedGodObject god_object_;
  TorqueLimiter limiter_;
  FaultyReports reports_;
  CycleReport report_;
};

ControllerConfig::Workspace workspace(const Pose& start) {
  ControllerConfig::Workspace workspace;
  workspace.posture << 0.0, -0.5, 0.0, 1.4, 0.0, -1.2, 0.0;  // bent, far from the joints' limits
  workspace.start = start;
  return workspace;
}

}  // namespace

std::vector<LedCycle> lead(const LedArm& arm, std::span<const Pose> path) {
  const ControllerConfig::Workspace at_start = workspace(path.front());
  const Placement placement = place(at_start, *arm.device, arm.scene->H_MB.translation);
  const ArmModel& model = placement.device.model;
  files::AlignedBytes memory(GodObject::memory_size(Scene::of(*arm.scene)));
  CycleSetup setup;
  setup.scene = arm.scene;
  setup.solver = arm.solver;
  setup.friction = arm.friction;
  setup.memory = memory.span();
  setup.arm = &model;
  setup.joint_torque = &placement.device.torque;
  setup.mapping = placement.mapping;
  setup.torque = arm.torque;
  setup.supervisor.sign_test = false;   // the joints do not yield
  setup.supervisor.engage_cycles = 20;  // full rendering soon
  LedDrives drives(model.joint_count);
  const auto controller = std::make_unique<ControlCycle>(setup, drives);
  Unsupervised unsupervised(arm, setup);
  if (controller->start() != Status::kOk) {
    throw command::Failure(command::ExitCode::kInternal, "the scene lacks the solver");
  }

  drives.position = at_start.posture;
  const Pose H_RW = placement.mapping.H_WR.inverse();
  std::vector<LedCycle> cycles(kStartCycles + path.size());
  for (std::size_t k = 0; k < cycles.size(); ++k) {
    if (k >= kStartCycles) drives.position = reached(model, drives.position, H_RW * path[k - kStartCycles]);
    controller->run_once({});
    cycles[k].record = controller->record();
    cycles[k].sent = drives.sent;
    unsupervised.cycle(cycles[k]);
  }
  return cycles;
}

}  // namespace godobject::report
