#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/device/joint_torque.h"
#include "core/device/passivity.h"
#include "core/device/velocity_estimator.h"
#include "core/device/workspace_mapping.h"
#include "core/scene/scene_view.h"
#include "firmware/cycle/hand_limits.h"
#include "firmware/cycle/model_watch.h"
#include "firmware/cycle/position_check.h"
#include "firmware/cycle/supervisor.h"
#include "firmware/cycle/torque_limiter.h"
#include "godobject/god_object.h"
#include "hal/joint_drives.h"

namespace godobject::firmware {

/// Events that the loop reports to the cycle.
struct LoopEvents {
  std::int64_t overrun_ns = 0;        ///< time by which the previous cycle ended late
  std::int64_t computed_late_ns = 0;  ///< time by which the previous cycle computed for longer than planned
  std::uint32_t skipped = 0;          ///< periods without a cycle since the previous one
  bool end_requested = false;
  bool reset_requested = false;
};

/// Counts of cycles with a disturbance or an active limit.
struct CycleCounters {
  std::uint64_t cycles = 0;
  std::uint64_t lost = 0;   ///< cycles in which a joint had no fresh position
  std::uint64_t jumps = 0;  ///< cycles with an impossible position
  std::uint64_t overruns = 0;
  std::uint64_t skipped = 0;           ///< periods without a cycle
  std::uint64_t sends_failed = 0;      ///< cycles in which torques could not be handed over
  std::uint64_t clipped = 0;           ///< cycles with a force or torque at the hand beyond its limit
  std::uint64_t slowed = 0;            ///< cycles with a hand above its speed limit
  std::uint64_t scaled = 0;            ///< cycles in which the joints could not give the whole wrench
  std::uint64_t rate_limited = 0;      ///< cycles in which a torque changed at the rate limit
  std::uint64_t unconverged = 0;       ///< cycles in which the friction solver did not converge
  std::uint64_t out_of_work = 0;       ///< cycles that the budget of work ended
  std::uint64_t most_out_of_work = 0;  ///< the most of them in a row
  std::uint64_t warm = 0;              ///< cycles in which a drive was warm
  std::uint64_t temperature_lost = 0;  ///< cycles in which the last request for a drive's temperature was not answered
  std::uint64_t limited = 0;           ///< cycles with power in which a drive limited its torque by itself
};

/// The results of a cycle for telemetry and report.
struct CycleRecord {
  Mode mode = Mode::kBoot;
  Fault fault = Fault::kNone;
  hal::Alarm alarm = hal::Alarm::kNone;
  int alarm_joint = -1;
  int fault_joint = -1;  ///< joint of the fault, as of its first cycle; -1: not known, or no single joint
  Status status = Status::kOk;
  std::uint8_t warm = 0;                     ///< drives that are warm, one bit a joint
  std::uint8_t temperature_lost = 0;         ///< drives that did not answer for their temperature, one bit a joint
  JointVector q = JointVector::Zero();       ///< checked [rad]
  JointVector qd = JointVector::Zero();      ///< [rad/s]
  JointVector torque = JointVector::Zero();  ///< sent [Nm]
  Pose H_RM;                                 ///< the tool in the room
  Pose H_WM;                                 ///< the moving mesh at the device pose
  Pose god_object_W;                         ///< the moving mesh at the god object's pose
  Wrench F_G_R;                              ///< rendered on the hand, with the share [N, Nm]
  double share = 0.0;                        ///< share of the computed wrench that is rendered [0, 1]
  /// Energy that the rendered torques have taken from arm and hand since rendering began; below zero: given [J]
  double absorbed = 0.0;
  double injected_damping = 0.0;  ///< damping of the passivity controller along the wrench [Ns/m]
  double penetration = 0.0;       ///< as in CycleReport [m]
  std::uint32_t contacts = 0;
  std::uint32_t lost = 0;       ///< cycles in a row without a fresh position, of the worst joint
  std::uint32_t behind = 0;     ///< rendering cycles in a row that the budget of work ended
  std::uint8_t limited = 0;     ///< drives with power that limit their torque by themselves, one bit a joint
  bool clutch_is_open = false;  ///< the tool moves, the mesh rests
  Outcome outcome = Outcome::kFree;
};

/// Constants of a session. Scene, arm and torque parameters are validated and outlive the cycle.
struct CycleSetup {
  double period = 1e-3;  ///< T [s], as in the scene's settings
  const SceneView* scene = nullptr;
  Solver solver = Solver::kContact;
  bool friction = false;
  std::span<std::byte> memory;  ///< GodObject::memory_size(*scene) bytes, or at least GodObject::least_memory_size()
  std::uint64_t work_budget = GodObject::kNoBudget;  ///< as GodObject::set_work_budget [units]
  const ArmModel* arm = nullptr;
  const JointTorqueParameters* joint_torque = nullptr;
  WorkspaceMappingParameters mapping;
  int velocity_window = 4;
  double stuck_torque = 0.005;  ///< as in PositionCheck
  PassivityController::Parameters passivity;
  HandLimits hand;
  TorqueLimits torque;
  Supervisor::Parameters supervisor;
};

/// One period of the controller: from the drives' positions to their torques. The same code runs in virtual time
/// and on the real-time thread. A request to open the clutch is deferred until the contact force is below
/// `supervisor.engage_force`. 12 KiB; the god object works in `CycleSetup::memory`. No allocation, no exceptions, no
/// locks.
class ControlCycle {
 public:
  /// `setup` and `drives` outlive the cycle.
  ControlCycle(const CycleSetup& setup, hal::JointDrives& drives) noexcept;

  /// Starts the god object, before the first `run_once`. kNotInImage: the scene was compiled without this solver, or
  /// without friction; kNotInBuild: this build is.
  Status start() noexcept { return start(setup_.solver, setup_.friction); }

  /// Starts the god object again, before the first `run_once` or between two of them, with the gains that the scene has
  /// now. While it renders the god object goes on from its place. Statuses as above; then nothing is changed. Not for a
  /// real-time loop: it takes milliseconds.
  Status start(Solver solver, bool friction) noexcept;
  Solver solver() const noexcept { return setup_.solver; }
  bool friction() const noexcept { return setup_.friction; }

  /// Begins a cycle: requests the joints' positions, which `run_once` takes `collect_ns` later.
  void request() noexcept { drives_.request(); }
  std::int64_t collect_ns() const noexcept { return drives_.collect_ns(); }

  /// The rest of the cycle. Cost: GodObject::update and about 10 us. Real-time safe.
  void run_once(const LoopEvents& events) noexcept;

  const CycleRecord& record() const noexcept { return record_; }
  const CycleCounters& counters() const noexcept { return counters_; }
  const Supervisor& supervisor() const noexcept { return supervisor_; }

 private:
  void begin_positions_anew() noexcept;
  void observe_energy() noexcept;
  void watch_model(const ArmKinematics& kinematics, std::uint32_t skipped) noexcept;
  Status estimate_velocity(std::uint32_t skipped) noexcept;
  bool opens_clutch() noexcept;
  double contact_force() const noexcept;
  Status render(const ArmKinematics& kinematics) noexcept;
  Status compute_torque(const ArmKinematics& kinematics) noexcept;
  Observation observe(const LoopEvents& events, Status status) const noexcept;
  void count(const LoopEvents& events) noexcept;
  std::uint8_t limited_drives(hal::PowerRequest power) const noexcept;
  int joint_of(Fault fault) const noexcept;
  void keep(const Decision& decision) noexcept;

  CycleSetup setup_;
  hal::JointDrives& drives_;
  PositionCheck position_check_;
  VelocityEstimator velocity_;
  ModelWatch model_;
  Supervisor supervisor_;
  TorqueLimiter limiter_;
  std::optional<WorkspaceMapping> mapping_;  // made at the first posture
  GodObject god_object_;

  hal::JointReading reading_;
  CheckedPositions positions_;
  JointVector qd_ = JointVector::Zero();
  JointVector last_q_ = JointVector::Zero();
  CycleReport report_;
  Pose H_WM_;                         // the moving mesh at the device pose
  Vector3 p_MG_R_ = Vector3::Zero();  // from M's origin to the grip, the body's centre of mass [m]
  LimitedWrench at_hand_;
  bool clutch_is_open_ = false;
  Wrench rendered_G_R_;  // on the hand, of the last cycle before a FADE
  PassivityObserver observer_;
  PassivityController passivity_;
  JointTorque joint_torque_;
  ComputedTorque computed_;
  std::uint32_t sends_failed_ = 0;
  CycleRecord record_;
  CycleCounters counters_;
};
static_assert(sizeof(ControlCycle) <= 12 * 1024);

}  // namespace godobject::firmware
