#include "firmware/cycle/control_cycle.h"

#include <algorithm>

namespace godobject::firmware {

namespace {

std::uint8_t joint_bits(const std::array<bool, kMaxJoints>& flags) noexcept {
  static_assert(kMaxJoints <= 8);
  unsigned bits = 0;
  for (std::size_t i = 0; i < flags.size(); ++i) bits |= flags[i] ? 1u << i : 0u;
  return static_cast<std::uint8_t>(bits);
}

}  // namespace

ControlCycle::ControlCycle(const CycleSetup& setup, hal::JointDrives& drives) noexcept
    : setup_(setup),
      drives_(drives),
      position_check_(*setup.arm, setup.stuck_torque, setup.period),
      velocity_(setup.velocity_window, setup.period),
      model_(*setup.arm, setup.period),
      supervisor_(*setup.arm, setup.supervisor),
      limiter_(*setup.arm, setup.torque),
      observer_(drives.delay() / setup.period),
      passivity_(setup.passivity, drives.delay() / setup.period) {}

Status ControlCycle::start(Solver solver, bool friction) noexcept {
  const Pose before = god_object_.mesh_pose();
  const Status status = god_object_.start(Scene::of(*setup_.scene), solver, friction, setup_.memory);
  if (status != Status::kOk) return status;
  setup_.solver = solver;
  setup_.friction = friction;
  god_object_.set_work_budget(setup_.work_budget);
  if (!mapping_ || !supervisor_.renders()) return status;
  CycleReport ignored;  // of a cycle that begins and ends where the god object was: from there it goes on
  static_cast<void>(god_object_.update({before, {}}, ignored));  // refused: it begins at the device pose
  return status;
}

// clang-format off: the steps stand in a column
void ControlCycle::run_once(const LoopEvents& events) noexcept {
  drives_.receive(reading_);
  if (!supervisor_.follows_positions()) begin_positions_anew();
  position_check_.update(reading_, qd_, limiter_.pushed(), events.skipped, positions_);
  Status status = estimate_velocity(events.skipped);
  observe_energy();
  const ArmKinematics kinematics = forward_kinematics(*setup_.arm, positions_.q);
  watch_model(kinematics, events.skipped);
  if (status == Status::kOk) status = render(kinematics);          // mapping, #1 - #7, limits at the hand
  if (status == Status::kOk) status = compute_torque(kinematics);  // J^T
  const Decision decision = supervisor_.step(observe(events, status));
  const JointVector torque = limiter_.apply(decision, computed_, qd_);
  const bool sent = drives_.send({torque, decision.power});
  observer_.send(limiter_.pushed());
  // clang-format on
  sends_failed_ = sent ? 0 : sends_failed_ + 1;
  record_.torque = torque;
  record_.status = status;
  record_.H_RM = kinematics.H_RM;
  keep(decision);
  count(events);
}

/// Takes the next reading as it is, with the joints at rest: readings before it may not have been positions at all.
void ControlCycle::begin_positions_anew() noexcept {
  position_check_.restart();
  velocity_.reset();
  last_q_ = reading_.position;
}

/// Counts the energy of rendered torques only.
void ControlCycle::observe_energy() noexcept {
  if (!supervisor_.renders()) {
    observer_.reset();
    passivity_.reset();
  }
  if (positions_.finite) observer_.observe(positions_.q);
}

/// Compares the arm with its model while all drives give torque.
void ControlCycle::watch_model(const ArmKinematics& kinematics, std::uint32_t skipped) noexcept {
  const bool enabled = summarize(reading_, setup_.arm->joint_count).all_enabled;
  if (!enabled || !supervisor_.follows_positions()) return model_.reset();
  const bool free = record_.share == 0.0 || contact_force() < setup_.supervisor.engage_force;
  model_.update(kinematics, qd_, reading_, record_.torque, free, 1 + skipped);
}

/// Interpolates positions for periods without a cycle, since the estimator needs one a period.
Status ControlCycle::estimate_velocity(std::uint32_t skipped) noexcept {
  if (!positions_.finite) return Status::kNotFinite;
  if (skipped >= VelocityEstimator::kMaxWindow) {
    velocity_.reset();
  } else {
    for (std::uint32_t k = 1; k <= skipped; ++k) {
      const double share = static_cast<double>(k) / (skipped + 1);
      const Status status = velocity_.update(last_q_ + share * (positions_.q - last_q_), qd_);
      if (status != Status::kOk) return status;
    }
  }
  last_q_ = positions_.q;
  return velocity_.update(positions_.q, qd_);
}

/// The clutch stays closed while the hand leans on something: otherwise the contact would give way under the hand, and
/// push it when the clutch closes again. It stays closed, too, before the joints' positions are known.
bool ControlCycle::opens_clutch() noexcept {
  const bool leans = contact_force() >= setup_.supervisor.engage_force || report_.outcome == Outcome::kStartInside;
  const bool may_open = supervisor_.follows_positions() && (clutch_is_open_ || !leans);
  clutch_is_open_ = reading_.clutch_open && may_open;
  return clutch_is_open_;
}

/// Size of the wrench at the hand; torques count as forces at the rotation length [N].
double ControlCycle::contact_force() const noexcept {
  return at_hand_.F_G_R.force.norm() + at_hand_.F_G_R.torque.norm() / setup_.joint_torque->rotation_length;
}

/// From the tool's pose to the wrench at the hand. G, the grip, has the axes of M at the centre of mass, so R_WG is
/// R_WM. The mapping maps G and not M: otherwise, after the clutch has rotated the mesh against the tool, forces would
/// act on the hand with other levers than in the scene and give it energy.
Status ControlCycle::render(const ArmKinematics& kinematics) noexcept {
  const Pose& H_RM = kinematics.H_RM;
  const Vector3& p_MB = setup_.scene->H_MB.translation;
  p_MG_R_ = H_RM.rotation._transformVector(p_MB) / setup_.mapping.scale;
  const Pose H_RG{H_RM.rotation, H_RM.translation + p_MG_R_};
  if (!mapping_) mapping_.emplace(setup_.mapping, H_RG);
  if (const Status status = mapping_->update(H_RG, !opens_clutch(), setup_.period); status != Status::kOk)
    return status;
  const Motion velocity_R = tool_velocity(geometric_jacobian(kinematics, H_RG.translation), qd_);

  const Pose& H_WG = mapping_->scene_pose();
  H_WM_ = {H_WG.rotation, H_WG.translation - H_WG.rotation._transformVector(p_MB)};  // G's origin is B's
  if (!supervisor_.renders()) {
    at_hand_ = limit_at_hand(setup_.hand, {}, velocity_R);
    return god_object_.follow(H_WM_, report_);
  }
  const Motion velocity_W = mapping_->velocity_in_scene(velocity_R);
  if (const Status status = god_object_.update({H_WM_, velocity_W}, report_); status != Status::kOk) return status;

  const Wrench& F_G_W = report_.force.total_W;  // about the centre of mass
  const Wrench F_G_R = passivity_.apply(observer_.absorbed(), mapping_->wrench_at_hand(F_G_W), velocity_R);
  at_hand_ = limit_at_hand(setup_.hand, F_G_R, velocity_R);
  return Status::kOk;
}

Status ControlCycle::compute_torque(const ArmKinematics& kinematics) noexcept {
  TorqueRequest request;
  request.q = positions_.q;
  request.qd = qd_;
  request.kinematics = kinematics;
  const Wrench& F_G_R = at_hand_.F_G_R;
  const Wrench F_M_R{F_G_R.force, F_G_R.torque + p_MG_R_.cross(F_G_R.force)};
  request.F_P_R = F_M_R;
  request.p_RP = kinematics.H_RM.translation;
  const Status status = joint_torque(*setup_.arm, *setup_.joint_torque, request, joint_torque_);
  computed_.holding = joint_torque_.gravity;
  computed_.rendered = joint_torque_.torque - joint_torque_.gravity;
  return status;
}

Observation ControlCycle::observe(const LoopEvents& events, Status status) const noexcept {
  Observation seen;
  seen.drives = summarize(reading_, setup_.arm->joint_count);
  seen.emergency_stop = reading_.emergency_stop;
  seen.enable_switch = reading_.enable_switch;
  seen.alarm = reading_.alarm != hal::Alarm::kNone;
  seen.drive_restarted = reading_.alarm == hal::Alarm::kNodeReset;
  seen.q = positions_.q;
  seen.lost = positions_.predicted;
  seen.jumps = positions_.jumps;
  seen.finite = positions_.finite;
  seen.stuck = positions_.stuck;
  for (int i = 0; i < setup_.arm->joint_count; ++i) {
    const ArmJoint& joint = setup_.arm->joints[static_cast<std::size_t>(i)];
    if (positions_.q[i] < joint.lower || positions_.q[i] > joint.upper) seen.joint_beyond_limit = i;
  }
  seen.limited = reading_.limited;
  seen.too_fast = at_hand_.too_fast || limiter_.too_fast(qd_) || positions_.runs_away;
  seen.status = status;
  seen.drifts = model_.drifts();
  seen.drifts_early = model_.drifts_early();
  seen.wrong_torque_joint = model_.wrong_torque_joint();
  seen.contact_force = contact_force();
  seen.inside = report_.outcome == Outcome::kStartInside;
  seen.overrun_ns = events.overrun_ns;
  seen.computed_late_ns = events.computed_late_ns;
  seen.sends_failed = sends_failed_;
  seen.end_requested = events.end_requested;
  seen.reset_requested = events.reset_requested;
  return seen;
}

/// Returns the drives that are enabled as requested and limit their torque, one bit a joint.
std::uint8_t ControlCycle::limited_drives(hal::PowerRequest power) const noexcept {
  std::array<bool, kMaxJoints> limited{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(setup_.arm->joint_count); ++i) {
    const bool enabled = power == hal::PowerRequest::kEnable && reading_.state[i] == hal::DriveState::kEnabled;
    limited[i] = enabled && reading_.limited[i];
  }
  return joint_bits(limited);
}

/// The joint that this cycle's reading shows the fault of; -1: none.
int ControlCycle::joint_of(Fault fault) const noexcept {
  const auto first = [this](auto has_it) {
    for (int i = 0; i < setup_.arm->joint_count; ++i) {
      if (has_it(static_cast<std::size_t>(i))) return i;
    }
    return -1;
  };
  switch (fault) {
    case Fault::kPositionLost: return positions_.lost_joint;
    case Fault::kPositionJump: return positions_.jump_joint;
    case Fault::kNotFinite: return positions_.not_finite_joint;
    case Fault::kEncoderStuck: return positions_.stuck_joint;
    case Fault::kAlarm: return reading_.alarm_joint;
    case Fault::kDrivesAbsent:
      return first([&](std::size_t i) { return reading_.state[i] == hal::DriveState::kUnavailable; });
    case Fault::kDriveLeft: return first([&](std::size_t i) { return reading_.state[i] != hal::DriveState::kEnabled; });
    case Fault::kTooFast: {
      const int joint = limiter_.too_fast_joint(qd_);
      return joint < 0 && positions_.runs_away ? positions_.jump_joint : joint;
    }
    case Fault::kNone: return -1;
    default: return supervisor_.fault_joint();
  }
}

void ControlCycle::keep(const Decision& decision) noexcept {
  record_.mode = supervisor_.mode();
  if (record_.fault != supervisor_.fault()) record_.fault_joint = joint_of(supervisor_.fault());
  record_.fault = supervisor_.fault();
  record_.alarm = reading_.alarm;
  record_.alarm_joint = reading_.alarm_joint;
  record_.q = positions_.q;
  record_.qd = qd_;
  record_.H_WM = H_WM_;
  record_.god_object_W = god_object_.mesh_pose();
  record_.share = decision.share;
  record_.absorbed = observer_.absorbed();
  record_.injected_damping = passivity_.damping();
  if (!decision.of_last) {
    const Wrench& F_M_R = joint_torque_.rendered_P_R;  // P is M's origin
    rendered_G_R_ = {decision.share * F_M_R.force, decision.share * (F_M_R.torque - p_MG_R_.cross(F_M_R.force))};
  }
  const double share = decision.of_last ? decision.share : 1.0;
  record_.F_G_R = {share * rendered_G_R_.force, share * rendered_G_R_.torque};
  record_.penetration = report_.penetration;
  record_.contacts = report_.contacts;
  record_.lost = positions_.lost;
  record_.limited = limited_drives(decision.power);
  record_.warm = joint_bits(reading_.warm);
  record_.temperature_lost = joint_bits(reading_.temperature_lost);
  record_.clutch_is_open = clutch_is_open_;
  record_.outcome = report_.outcome;
}

void ControlCycle::count(const LoopEvents& events) noexcept {
  const auto add = [](bool happened) -> std::uint64_t { return happened ? 1 : 0; };
  const bool rendering = record_.share > 0.0;
  counters_.cycles += 1;
  counters_.lost += add(positions_.lost > 0 && record_.mode != Mode::kBoot);  // in kBoot none is expected
  counters_.jumps += add(positions_.jumps > 0);
  counters_.overruns += add(events.overrun_ns > 0);
  counters_.skipped += events.skipped;
  counters_.sends_failed += add(sends_failed_ > 0);
  counters_.clipped += add(rendering && at_hand_.clipped);
  counters_.slowed += add(rendering && at_hand_.slowed);
  counters_.scaled += add(rendering && joint_torque_.scale < 1.0);
  counters_.rate_limited += add(limiter_.rate_limited());
  counters_.unconverged += add(rendering && report_.unconverged);
  counters_.limited += add(record_.limited != 0);
  counters_.warm += add(record_.warm != 0);
  counters_.temperature_lost += add(record_.temperature_lost != 0);
  record_.behind = rendering && report_.out_of_work ? record_.behind + 1 : 0;
  counters_.out_of_work += add(record_.behind > 0);
  counters_.most_out_of_work = std::max<std::uint64_t>(counters_.most_out_of_work, record_.behind);
}

}  // namespace godobject::firmware
