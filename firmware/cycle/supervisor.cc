#include "firmware/cycle/supervisor.h"

#include <algorithm>
#include <cmath>

namespace godobject::firmware {

const char* name(Mode mode) noexcept {
  switch (mode) {
    case Mode::kBoot: return "boot";
    case Mode::kZeroCheck: return "zero_check";
    case Mode::kIdle: return "idle";
    case Mode::kEnabling: return "enabling";
    case Mode::kSignTest: return "sign_test";
    case Mode::kArmed: return "armed";
    case Mode::kEngaging: return "engaging";
    case Mode::kRunning: return "running";
    case Mode::kFade: return "fade";
    case Mode::kStopping: return "stopping";
    case Mode::kStopped: return "stopped";
    case Mode::kResetting: return "resetting";
    case Mode::kEnding: return "ending";
    case Mode::kEnded: return "ended";
  }
  return "unknown";
}

const char* describe(Fault fault) noexcept {
  switch (fault) {
    case Fault::kNone: return "none";
    case Fault::kDrivesAbsent: return "not all drives answered; check power and wiring";
    case Fault::kNotAtRest: return "a joint moved with its brake closed; check the brakes";
    case Fault::kPositionLost: return "a joint's position was lost three times in a row; check wiring and bus load";
    case Fault::kPositionJump: return "a joint's position jumped; check its encoder";
    case Fault::kNotFinite: return "a reading was not a finite number; check the drives' scaling";
    case Fault::kEncoderStuck: return "a joint's position rested though it should have moved; check its encoder";
    case Fault::kComputation: return "the cycle could not be computed; look at the telemetry's last rows";
    case Fault::kOverruns: return "the loop was late too often; run godobject-controller doctor";
    case Fault::kDriveLeft: return "a drive is not enabled; look at its own error";
    case Fault::kAlarm: return "a bus or a drive raised an alarm";
    case Fault::kSendFailed: return "torques could not be sent three times in a row; check the bus";
    case Fault::kEmergencyStop: return "emergency stop; release it and reset";
    case Fault::kEnableReleased: return "the enable switch was released; reset and hold it again";
    case Fault::kJointLimit:
      return "a joint is beyond its position limit; release its brake with the drive's own tool, move it back, and "
             "reset";
    case Fault::kTooFast: return "hand or joint was faster than the speed to stop at; reset";
    case Fault::kSignWrong:
      return "a joint moved against its torque, or the arm moved away by itself; check polarities and encoders";
    case Fault::kSignUndecided:
      return "a joint did not move when pushed; keep the hand still, check its brake and encoder";
    case Fault::kOutsideLimits:
      return "a joint stands beyond its limits before the start; release its brake with the drive's own tool and move "
             "it "
             "back, or check its zero";
  }
  return "unknown fault";
}

const char* describe(hal::Alarm alarm) noexcept {
  switch (alarm) {
    case hal::Alarm::kNone: return "none";
    case hal::Alarm::kBusDown:
      return "a CAN interface is down or bus-off; check wiring and termination, set it up again";
    case hal::Alarm::kBadFrames: return "three frames in a row that its drive cannot have sent; check the PDO mapping";
    case hal::Alarm::kNodeReset: return "the drive started anew; check its supply, then start the controller again";
    case hal::Alarm::kHeartbeatLost: return "the drive's heartbeat stayed away; check its supply and the bus";
    case hal::Alarm::kDriveError: return "the drive sent an emergency message; look its code up in its manual";
    case hal::Alarm::kWrongMode: return "the drive left cyclic synchronous torque or the operational state";
    case hal::Alarm::kForeignMaster:
      return "somebody else sends frames that only this controller may; stop the other master";
    case hal::Alarm::kForeignWrite: return "somebody else wrote to a drive; disconnect the tool and start again";
    case hal::Alarm::kParameterChanged:
      return "a parameter of the drive is not what was written at the start; start again";
    case hal::Alarm::kAnswersLate:
      return "the drive answers a SYNC only after the next one; its samples would be a period late";
    case hal::Alarm::kPanelLost: return "the operator's panel does not answer any more; check its wiring";
    case hal::Alarm::kPanelSilent:
      return "the operator's panel has not told its inputs since the start; check that it answers SYNC with its TPDO1";
  }
  return "unknown alarm";
}

DriveSummary summarize(const hal::JointReading& reading, int joint_count) noexcept {
  using hal::DriveState;
  DriveSummary drives{
      .all_answer = true, .all_enabled = true, .none_moves = true, .any_fault = false, .all_fresh = true};
  for (int i = 0; i < joint_count; ++i) {
    const DriveState state = reading.state[static_cast<std::size_t>(i)];
    drives.all_answer = drives.all_answer && state != DriveState::kUnavailable;
    drives.all_enabled = drives.all_enabled && state == DriveState::kEnabled;
    drives.none_moves = drives.none_moves && (state == DriveState::kOff || state == DriveState::kFault);
    drives.any_fault = drives.any_fault || state == DriveState::kFault;
    drives.all_fresh = drives.all_fresh && reading.age[static_cast<std::size_t>(i)] == 0;
  }
  return drives;
}

namespace {

/// Not what a drive said before it fell silent: it may have been enabled since.
bool seen_at_rest(const DriveSummary& drives) noexcept { return drives.none_moves && drives.all_fresh; }

}  // namespace

Supervisor::Supervisor(const ArmModel& arm, const Parameters& parameters) noexcept
    : joint_count_(arm.joint_count),
      parameters_(parameters),
      sign_tested_(!parameters.sign_test),
      sign_test_(arm, parameters.sign) {}

Decision Supervisor::step(const Observation& seen) noexcept {
  ++in_mode_;
  too_many_overruns_ = overruns_.update(seen.overrun_ns);
  too_many_jumps_ = jumps_.update(seen.jumps > 0);
  // who comes back may have been exchanged, or connected anew
  if (!seen.drives.all_answer || seen.drive_restarted) sign_tested_ = !parameters_.sign_test;
  const Fault fault = find_fault(seen);
  if (fault == Fault::kPositionLost && powered()) {
    if (mode_ != Mode::kFade) {
      fault_ = fault;
      enter(Mode::kFade);
    }
  } else if (fault != Fault::kNone) {
    stop(fault, fault == Fault::kJointLimit ? seen.joint_beyond_limit : -1);
  }
  if (seen.end_requested && !ending_) begin_ending();
  advance(seen);
  const Decision decision = decide(seen);
  last_power_ = decision.power;
  return decision;
}

/// After the faults of the cycle: a stop goes on as it is.
void Supervisor::begin_ending() noexcept {
  ending_ = true;
  end_step_ = share_ / kEndRamp;
  if (mode_ == Mode::kEngaging || mode_ == Mode::kRunning) {
    enter(Mode::kEnding);
  } else if (powered() && mode_ != Mode::kFade) {
    stop_cycles_ = kEndStop;
    enter(Mode::kStopping);
  } else if (mode_ != Mode::kFade && mode_ != Mode::kStopping) {
    enter(Mode::kEnded);
  }
}

void Supervisor::enter(Mode mode) noexcept {
  mode_ = mode;
  in_mode_ = 1;
}

void Supervisor::stop(Fault fault, int joint) noexcept {
  if (fault_ == Fault::kNone) {
    fault_ = fault;
    fault_joint_ = joint;
  }
  share_ = 0.0;
  stop_cycles_ = kFaultStop;
  enter(powered() ? Mode::kStopping : Mode::kStopped);
}

/// What is wrong in this cycle, as far as it matters in this mode.
Fault Supervisor::find_fault(const Observation& seen) const noexcept {
  if (mode_ >= Mode::kStopping && mode_ != Mode::kEnding) return Fault::kNone;
  if (!seen.finite && (mode_ != Mode::kBoot || seen.drives.all_answer)) return Fault::kNotFinite;
  if (mode_ == Mode::kBoot) return Fault::kNone;
  if (seen.alarm) return Fault::kAlarm;
  if (powered()) {
    if (seen.emergency_stop) return Fault::kEmergencyStop;
    if (!seen.enable_switch) return Fault::kEnableReleased;
    if (seen.status != Status::kOk) return Fault::kComputation;
    const bool enabled =
        mode_ == Mode::kEnabling ? seen.drives.all_answer && !seen.drives.any_fault : seen.drives.all_enabled;
    if (!enabled) return Fault::kDriveLeft;
    // before the jumps, which a joint that runs away makes as well
    if (seen.too_fast) return before_sign_is_known() ? Fault::kSignWrong : Fault::kTooFast;
    if (seen.jumps >= 2 || too_many_jumps_) return Fault::kPositionJump;
    if (seen.stuck) return Fault::kEncoderStuck;
    if (seen.joint_beyond_limit >= 0) return Fault::kJointLimit;
    if (too_many_overruns_) return Fault::kOverruns;
    if (seen.sends_failed >= 3) return Fault::kSendFailed;
  } else {
    // a drive that has power unasked is as bad as one that has tripped
    if (!seen.drives.all_answer || seen.drives.any_fault || !seen.drives.none_moves) return Fault::kDriveLeft;
    if (seen.jumps >= 2 || too_many_jumps_) return Fault::kPositionJump;
  }
  if (seen.lost < 3) return Fault::kNone;
  // a bus that takes no frames brings no positions: fading out needs one that does
  const bool cannot_send = powered() && mode_ != Mode::kFade && seen.sends_failed > 0;
  return cannot_send ? Fault::kSendFailed : Fault::kPositionLost;
}

bool Supervisor::moved(const Observation& seen, double more_than) const noexcept {
  return (seen.q - reference_).head(joint_count_).cwiseAbs().maxCoeff() > more_than;
}

/// From mode to mode without a fault of `find_fault`.
void Supervisor::advance(const Observation& seen) noexcept {
  test_torque_.setZero();
  switch (mode_) {
    case Mode::kBoot:
      if (seen.drives.all_answer && seen.drives.any_fault) {
        stop(Fault::kDriveLeft);  // what has tripped waits for the operator, also over a restart
      } else if (seen.drives.all_answer && seen.drives.none_moves && seen.lost == 0) {
        reference_ = seen.q;
        enter(Mode::kZeroCheck);
      } else if (in_mode_ > parameters_.boot_cycles) {
        stop(Fault::kDrivesAbsent);
      }
      break;
    case Mode::kZeroCheck:
      if (seen.joint_beyond_limit >= 0) {
        stop(Fault::kOutsideLimits, seen.joint_beyond_limit);
      } else if (moved(seen, kAtRest)) {
        stop(Fault::kNotAtRest);
      } else if (in_mode_ > kZeroCycles) {
        switch_was_released_ = false;
        enter(Mode::kIdle);
      }
      break;
    case Mode::kIdle:
      if (seen.emergency_stop) {
        switch_was_released_ = false;
      } else if (!seen.enable_switch) {
        switch_was_released_ = true;
      } else if (switch_was_released_) {
        reference_ = seen.q;
        sign_test_.restart();
        enter(Mode::kEnabling);
      }
      break;
    case Mode::kEnabling:
      if (moved(seen, kMovesAway)) {
        stop(Fault::kSignWrong);
      } else if (seen.drives.all_enabled) {
        enter(sign_tested_ ? Mode::kArmed : Mode::kSignTest);
      } else if (in_mode_ > parameters_.prepare_cycles + kEnableCycles) {
        stop(Fault::kDriveLeft);
      }
      break;
    case Mode::kSignTest: {
      const SignTest::Result result = sign_test_.update(seen.q, test_torque_);
      if (result == SignTest::Result::kPassed) {
        sign_tested_ = true;
        enter(Mode::kArmed);
      } else if (result != SignTest::Result::kRunning) {
        stop(result == SignTest::Result::kWrong ? Fault::kSignWrong : Fault::kSignUndecided, sign_test_.joint());
      } else if (moved(seen, kMovesAway)) {
        stop(Fault::kSignWrong);
      }
      break;
    }
    case Mode::kArmed:
      if (!seen.inside && seen.contact_force < parameters_.engage_force) enter(Mode::kEngaging);
      break;
    case Mode::kEngaging:
      share_ = std::min(1.0, (in_mode_ - 1.0) / parameters_.engage_cycles);
      if (share_ >= 1.0) enter(Mode::kRunning);
      break;
    case Mode::kEnding:
      share_ = std::max(0.0, share_ - end_step_);
      if (in_mode_ > kEndRamp) {
        stop_cycles_ = kEndStop;
        enter(Mode::kStopping);
      }
      break;
    case Mode::kFade:
      if (in_mode_ > kFadeCycles) stop(fault_);
      break;
    case Mode::kStopping:
      if ((in_mode_ > kHoldCycles && seen_at_rest(seen.drives)) || in_mode_ > stop_cycles_) {
        enter(ending_ ? Mode::kEnded : Mode::kStopped);
      }
      break;
    case Mode::kStopped:
      if (seen.reset_requested && !seen.enable_switch && !seen.emergency_stop) enter(Mode::kResetting);
      break;
    case Mode::kResetting:
      if (seen.drives.all_answer && !seen.drives.any_fault && last_power_ == hal::PowerRequest::kReset) {
        fault_ = Fault::kNone;
        fault_joint_ = -1;
        enter(Mode::kBoot);
      } else if (in_mode_ > kFaultStop) {
        enter(Mode::kStopped);
      }
      break;
    case Mode::kRunning:
    case Mode::kEnded: break;
  }
}

/// A drive that has lost its power, or has not been given any yet, must not be given it by a stop.
hal::PowerRequest Supervisor::power_to_stop(const DriveSummary& drives, bool may_hold) const noexcept {
  if (last_power_ == hal::PowerRequest::kOff) return hal::PowerRequest::kOff;
  const bool holds = may_hold && drives.all_enabled && last_power_ == hal::PowerRequest::kEnable;
  return holds ? hal::PowerRequest::kEnable : hal::PowerRequest::kQuickStop;
}

/// A stop that was not seen to end goes on: disabled, a drive would break off its ramp.
hal::PowerRequest Supervisor::power_after_stop(const DriveSummary& drives) const noexcept {
  const bool goes_on = last_power_ == hal::PowerRequest::kQuickStop && !seen_at_rest(drives);
  return goes_on ? hal::PowerRequest::kQuickStop : hal::PowerRequest::kOff;
}

Decision Supervisor::decide(const Observation& seen) const noexcept {
  Decision decision;
  switch (mode_) {
    case Mode::kResetting: {
      // a reset takes power away, too
      const bool on_ramp = power_after_stop(seen.drives) == hal::PowerRequest::kQuickStop;
      decision.power = on_ramp ? hal::PowerRequest::kQuickStop : hal::PowerRequest::kReset;
      break;
    }
    case Mode::kEnabling:
      if (in_mode_ > parameters_.prepare_cycles) decision.power = hal::PowerRequest::kEnable;
      decision.holds_arm = true;
      break;
    case Mode::kSignTest:
    case Mode::kArmed:
    case Mode::kEngaging:
    case Mode::kRunning:
    case Mode::kEnding:
      decision.power = hal::PowerRequest::kEnable;
      decision.holds_arm = true;
      decision.share = share_;
      decision.test_torque = test_torque_;
      break;
    case Mode::kFade:
      decision.power = power_to_stop(seen.drives, true);
      decision.holds_arm = true;
      decision.share = 1.0 - static_cast<double>(in_mode_) / kFadeCycles;
      decision.of_last = true;
      decision.rate_limited = false;
      break;
    case Mode::kStopping:
      decision.power = power_to_stop(seen.drives, in_mode_ <= kHoldCycles);
      decision.holds_arm = true;
      decision.rate_limited = false;
      break;
    case Mode::kBoot:
    case Mode::kZeroCheck:
    case Mode::kIdle: decision.rate_limited = false; break;
    case Mode::kStopped:
    case Mode::kEnded:
      decision.power = power_after_stop(seen.drives);
      decision.rate_limited = false;
      break;
  }
  return decision;
}

}  // namespace godobject::firmware
