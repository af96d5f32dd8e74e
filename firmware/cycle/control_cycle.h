#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/device/joint_torque.h"
#include "core/device/passivity.h"
#include "core/device/velocity_estimator.h"
#include "core/device/workspace_mapping.h"
#include "core/pipeline/god_object.h"
#include "firmware/cycle/hand_limits.h"
#include "firmware/cycle/position_check.h"
#include "firmware/cycle/supervisor.h"
#include "firmware/cycle/torque_limiter.h"
#include "hal/joint_drives.h"

namespace godobject::firmware {

/// What the loop around the cycle knows of it.
struct LoopEvents {
  std::int64_t overrun_ns = 0;  ///< by how much the cycle before was late to end
  std::uint32_t skipped = 0;    ///< periods without a position since the last cycle
  bool end_requested = false;
  bool reset_requested = false;
};

/// How often it had to be gone on with less than all.
struct CycleCounters {
  std::uint64_t cycles = 0;
  std::uint64_t lost = 0;   ///< cycles without a fresh position of some joint
  std::uint64_t jumps = 0;  ///< cycles with a position that cannot be
  std::uint64_t overruns = 0;
  std::uint64_t skipped = 0;  ///< periods
  std::uint64_t sends_failed = 0;
  std::uint64_t clipped = 0;       ///< cycles with a force or torque at the hand beyond its limit
  std::uint64_t slowed = 0;        ///< with a hand that was too fast
  std::uint64_t scaled = 0;        ///< in which the joints could not give all of the wrench
  std::uint64_t rate_limited = 0;  ///< in which a torque changed by the most that it may
  std::uint64_t unconverged = 0;   ///< in which friction was not found
};

/// What a cycle leaves for others to look at.
struct CycleRecord {
  Mode mode = Mode::kBoot;
  Fault fault = Fault::kNone;
  hal::Alarm alarm = hal::Alarm::kNone;
  int alarm_joint = -1;
  Status status = Status::kOk;
  JointVector q = JointVector::Zero();       ///< checked [rad]
  JointVector qd = JointVector::Zero();      ///< [rad/s]
  JointVector torque = JointVector::Zero();  ///< sent [Nm]
  Pose H_RM;                                 ///< the tool in the room
  Pose H_WM;                                 ///< the moving mesh as the device holds it
  Pose god_object_W;                         ///< the moving mesh as the god object holds it
  Wrench wrench_R;                           ///< on the hand, at the centre of mass, share included [N, Nm]
  double share = 0.0;                        ///< of what is rendered
  /// Taken from arm and hand by what was pushed since rendering began; below zero: given to them [J]
  double absorbed = 0.0;
  double injected_damping = 0.0;  ///< of the passivity controller, along the wrench at the hand [Ns/m]
  double penetration = 0.0;       ///< as CycleReport [m]
  std::uint32_t contacts = 0;
  std::uint32_t lost = 0;
  bool clutch_is_open = false;  ///< the tool moves, the mesh rests
  Outcome outcome = Outcome::kFree;
};

/// Constants of a session; scene, arm and torque parameters are validated and outlive the cycle.
struct CycleSetup {
  const Scene* scene = nullptr;
  Solver solver = Solver::kContact;
  bool friction = false;
  std::span<std::uint32_t> search;  ///< GodObject::memory(*scene) words, or none
  const ArmModel* arm = nullptr;
  const JointTorqueParameters* joint_torque = nullptr;
  WorkspaceMappingParameters mapping;
  int velocity_window = 4;
  double stuck_torque = 0.005;  ///< as PositionCheck
  PassivityController::Parameters passivity;
  HandLimits hand;
  TorqueLimits torque;
  Supervisor::Parameters supervisor;
};

/// One millisecond of the controller: from the drives' positions to their torques. The clutch opens once the contact
/// force is below `supervisor.engage_force`; until then the operator's wish waits. The same lines run in virtual time
/// and in the real-time thread. About 600 KiB: static storage. No allocation, no exceptions, no locks.
class ControlCycle {
 public:
  static constexpr double kPeriod = 1e-3;  ///< T [s], the core's

  /// `setup` and `drives` outlive the cycle.
  ControlCycle(const CycleSetup& setup, hal::JointDrives& drives) noexcept;

  /// kNotInImage: the scene was compiled without that solver, or without friction; kNotInBuild: this build is without.
  /// Before the first `run_once`.
  Status start() noexcept { return god_object_.start(*setup_.scene, setup_.solver, setup_.friction, setup_.search); }

  /// Begins a cycle: the joints are asked for their positions, which `run_once` takes `collect_ns` later.
  void request() noexcept { drives_.request(); }
  std::int64_t collect_ns() const noexcept { return drives_.collect_ns(); }

  /// The rest of the cycle. Cost: that of GodObject::update and about 10 us. Real-time safe.
  void run_once(const LoopEvents& events) noexcept;

  const CycleRecord& record() const noexcept { return record_; }
  const CycleCounters& counters() const noexcept { return counters_; }
  const Supervisor& supervisor() const noexcept { return supervisor_; }

 private:
  void begin_positions_anew() noexcept;
  void observe_energy() noexcept;
  Status estimate_velocity(std::uint32_t skipped) noexcept;
  bool opens_clutch() noexcept;
  double contact_force() const noexcept;
  Status render(const ArmKinematics& kinematics) noexcept;
  Status compute_torque(const ArmKinematics& kinematics) noexcept;
  Observation observe(const LoopEvents& events, Status status) const noexcept;
  void count(const LoopEvents& events) noexcept;
  void keep(const Decision& decision) noexcept;

  CycleSetup setup_;
  hal::JointDrives& drives_;
  PositionCheck position_check_;
  VelocityEstimator velocity_;
  Supervisor supervisor_;
  TorqueLimiter limiter_;
  std::optional<WorkspaceMapping> mapping_;  // from the first posture on
  GodObject god_object_;

  hal::JointReading reading_;
  CheckedPositions positions_;
  JointVector qd_ = JointVector::Zero();
  JointVector last_q_ = JointVector::Zero();
  CycleReport report_;
  Pose H_WM_;                          // the moving mesh as the device holds it
  Vector3 lever_R_ = Vector3::Zero();  // from M's origin to the hand, the body's centre of mass [m]
  LimitedWrench at_hand_;
  bool clutch_is_open_ = false;
  Wrench granted_R_;  // at the hand, in the last cycle that was none of a FADE
  PassivityObserver observer_;
  PassivityController passivity_;
  JointTorque joint_torque_;
  ComputedTorque computed_;
  std::uint32_t sends_failed_ = 0;
  CycleRecord record_;
  CycleCounters counters_;
};

}  // namespace godobject::firmware
