#include "firmware/cycle/supervisor.h"

#include <algorithm>
#include <cmath>

#include "firmware/cycle/cycles_in.h"
#include "hal/joint_drives.h"

namespace godobject::firmware {
namespace {

/// All drives have reported in this cycle that they are at rest. An older state does not count: a drive that has fallen
/// silent may have been enabled since.
bool seen_at_rest(const DriveSummary& drives) noexcept { return drives.none_moves && drives.all_fresh; }

}  // namespace

Supervisor::Durations::Durations(double period) noexcept {
  const auto cycles = [period](std::uint32_t ms, std::uint32_t least = 1) {
    return cycles_in(1e-3 * ms, period, least);
  };
  zero = cycles(kZero_ms);
  enable = cycles(kEnable_ms);
  fade = cycles(kFade_ms, 2);
  hold = cycles(kHold_ms);
  end_ramp = cycles(kEndRamp_ms);
  end_stop = cycles(kEndStop_ms);
  fault_stop = cycles(kFaultStop_ms);
  to_loss = static_cast<std::uint32_t>(hal::cycles_to_loss(period));
}

Supervisor::Supervisor(const ArmModel& arm, const Parameters& parameters) noexcept
    : joint_count_(arm.joint_count),
      parameters_(parameters),
      cycles_(parameters.period),
      sign_tested_(!parameters.sign_test),
      sign_test_(arm, parameters.sign, parameters.period),
      lateness_(parameters.period) {}

Decision Supervisor::step(const Observation& seen) noexcept {
  ++in_mode_;
  // one rule for both: torques of a cycle that computes for longer than planned reach the drives as late as those of
  // one that overruns
  too_late_ = lateness_.update(std::max(seen.overrun_ns, seen.computed_late_ns));
  too_many_jumps_ = jumps_.update(seen.jumps > 0);
  too_many_lost_ = lost_.update(seen.lost > 0 && powered());
  watch_limits(seen);
  // a drive that returns may have been exchanged, or connected differently
  if (!seen.drives.all_answer || seen.drive_restarted) sign_tested_ = !parameters_.sign_test;
  const Fault fault = find_fault(seen);
  if (fault == Fault::kPositionLost && powered()) {
    if (mode_ != Mode::kFade) {
      fault_ = fault;
      enter(Mode::kFade);
    }
  } else if (fault != Fault::kNone) {
    stop(fault, joint_of(fault, seen));
  }
  if (seen.end_requested && !ending_) begin_ending();
  advance(seen);
  const Decision decision = decide(seen);
  last_power_ = decision.power;
  return decision;
}

/// While a drive opens its brake its bit may mean anything; without power it means nothing.
void Supervisor::watch_limits(const Observation& seen) noexcept {
  const bool may_act = powered() && mode_ != Mode::kEnabling;
  limited_joint_ = -1;
  for (int i = joint_count_ - 1; i >= 0; --i) {
    const auto at = static_cast<std::size_t>(i);
    if (!may_act) limits_[at].reset();
    if (limits_[at].update(may_act && seen.limited[at], parameters_.limited_cycles)) limited_joint_ = i;
  }
}

/// Returns the joint that the fault is of; -1: no single one.
int Supervisor::joint_of(Fault fault, const Observation& seen) const noexcept {
  switch (fault) {
    case Fault::kJointLimit: return seen.joint_beyond_limit;
    case Fault::kDriveLimited: return limited_joint_;
    case Fault::kTorqueWrong: return seen.wrong_torque_joint;
    default: return -1;
  }
}

/// Comes after the faults of the cycle, so a stop that has begun continues.
void Supervisor::begin_ending() noexcept {
  ending_ = true;
  end_step_ = share_ / cycles_.end_ramp;
  if (mode_ == Mode::kEngaging || mode_ == Mode::kRunning) {
    enter(Mode::kEnding);
  } else if (powered() && mode_ != Mode::kFade) {
    stop_cycles_ = cycles_.end_stop;
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
  stop_cycles_ = cycles_.fault_stop;
  enter(powered() ? Mode::kStopping : Mode::kStopped);
}

/// The fault of this cycle in this mode.
Fault Supervisor::find_fault(const Observation& seen) const noexcept {
  if (mode_ >= Mode::kStopping && mode_ != Mode::kEnding) return Fault::kNone;
  if (!seen.finite && (mode_ != Mode::kBoot || seen.drives.all_answer)) return Fault::kNotFinite;
  if (mode_ == Mode::kBoot) return Fault::kNone;
  if (seen.alarm) return Fault::kAlarm;
  const Fault fault = powered() ? find_fault_with_power(seen) : find_fault_without_power(seen);
  if (fault != Fault::kNone || !(seen.lost >= cycles_.to_loss || too_many_lost_)) return fault;
  // a bus that takes no frames brings no positions either, and a fade needs a bus that takes them
  const bool cannot_send = powered() && mode_ != Mode::kFade && seen.sends_failed > 0;
  return cannot_send ? Fault::kSendFailed : Fault::kPositionLost;
}

Fault Supervisor::find_fault_with_power(const Observation& seen) const noexcept {
  if (seen.emergency_stop) return Fault::kEmergencyStop;
  if (!seen.enable_switch) return Fault::kEnableReleased;
  if (seen.status != Status::kOk) return Fault::kComputation;
  const bool enabled =
      mode_ == Mode::kEnabling ? seen.drives.all_answer && !seen.drives.any_fault : seen.drives.all_enabled;
  if (!enabled) return Fault::kDriveLeft;
  // before the jumps: a joint that runs away also jumps
  if (seen.too_fast) return before_sign_is_known() ? Fault::kSignWrong : Fault::kTooFast;
  if (jumps_too_often(seen)) return Fault::kPositionJump;
  if (seen.stuck) return Fault::kEncoderStuck;
  if (seen.joint_beyond_limit >= 0) return Fault::kJointLimit;
  if (seen.wrong_torque_joint >= 0) return Fault::kTorqueWrong;
  if (limited_joint_ >= 0) return Fault::kDriveLimited;
  const bool before = mode_ >= Mode::kSignTest && mode_ <= Mode::kEngaging;
  if (seen.drifts && (mode_ == Mode::kRunning || (before && led_out_))) return Fault::kDrifts;
  if (seen.drifts_early && before && !led_out_) return Fault::kNotBalanced;
  if (too_late_) return seen.overrun_ns >= seen.computed_late_ns ? Fault::kOverruns : Fault::kComputedLate;
  return seen.sends_failed >= cycles_.to_loss ? Fault::kSendFailed : Fault::kNone;
}

/// A drive that has power without a request is as bad as one that has tripped.
Fault Supervisor::find_fault_without_power(const Observation& seen) const noexcept {
  if (!seen.drives.all_answer || seen.drives.any_fault || !seen.drives.none_moves) return Fault::kDriveLeft;
  return jumps_too_often(seen) ? Fault::kPositionJump : Fault::kNone;
}

bool Supervisor::moved(const Observation& seen, double more_than) const noexcept {
  return (seen.q - reference_).head(joint_count_).cwiseAbs().maxCoeff() > more_than;
}

/// Changes the mode in a cycle without a fault.
void Supervisor::advance(const Observation& seen) noexcept {
  test_torque_.setZero();
  switch (mode_) {
    case Mode::kBoot: return boot(seen);
    case Mode::kZeroCheck: return check_zero(seen);
    case Mode::kIdle: return wait_for_enable_switch(seen);
    case Mode::kEnabling: return wait_for_power(seen);
    case Mode::kSignTest: return test_sign(seen);
    case Mode::kArmed:
      if (!seen.inside && seen.contact_force < parameters_.engage_force) {
        enter(Mode::kEngaging);
      } else {
        led_out_ = true;
      }
      return;
    case Mode::kEngaging: return raise_share();
    case Mode::kEnding: return lower_share();
    case Mode::kFade:
      if (in_mode_ > cycles_.fade) stop(fault_);
      return;
    case Mode::kStopping: return come_to_rest(seen);
    case Mode::kStopped:
      if (seen.reset_requested && !seen.enable_switch && !seen.emergency_stop) enter(Mode::kResetting);
      return;
    case Mode::kResetting: return reset(seen);
    case Mode::kRunning:
    case Mode::kEnded: return;
  }
}

void Supervisor::raise_share() noexcept {
  share_ = std::min(1.0, (in_mode_ - 1.0) / parameters_.engage_cycles);
  if (share_ >= 1.0) enter(Mode::kRunning);
}

void Supervisor::lower_share() noexcept {
  share_ = std::max(0.0, share_ - end_step_);
  if (in_mode_ <= cycles_.end_ramp) return;
  stop_cycles_ = cycles_.end_stop;
  enter(Mode::kStopping);
}

void Supervisor::come_to_rest(const Observation& seen) noexcept {
  const bool at_rest = in_mode_ > cycles_.hold && seen_at_rest(seen.drives);
  if (at_rest || in_mode_ > stop_cycles_) enter(ending_ ? Mode::kEnded : Mode::kStopped);
}

void Supervisor::boot(const Observation& seen) noexcept {
  if (seen.drives.all_answer && seen.drives.any_fault) {
    stop(Fault::kDriveLeft);  // a tripped drive waits for the operator, also over a restart of the controller
  } else if (seen.drives.all_answer && seen.drives.none_moves && seen.lost == 0) {
    reference_ = seen.q;
    enter(Mode::kZeroCheck);
  } else if (in_mode_ > parameters_.boot_cycles) {
    stop(Fault::kDrivesAbsent);
  }
}

void Supervisor::check_zero(const Observation& seen) noexcept {
  if (seen.joint_beyond_limit >= 0) {
    stop(Fault::kOutsideLimits, seen.joint_beyond_limit);
  } else if (moved(seen, kAtRest)) {
    stop(Fault::kNotAtRest);
  } else if (in_mode_ > cycles_.zero) {
    switch_was_released_ = false;
    enter(Mode::kIdle);
  }
}

void Supervisor::wait_for_enable_switch(const Observation& seen) noexcept {
  if (seen.emergency_stop) {
    switch_was_released_ = false;
  } else if (!seen.enable_switch) {
    switch_was_released_ = true;
  } else if (switch_was_released_) {
    reference_ = seen.q;
    sign_test_.restart();
    led_out_ = false;
    enter(Mode::kEnabling);
  }
}

void Supervisor::wait_for_power(const Observation& seen) noexcept {
  if (moved(seen, kMovesAway)) {
    stop(Fault::kSignWrong);
  } else if (seen.drives.all_enabled) {
    enter(sign_tested_ ? Mode::kArmed : Mode::kSignTest);
  } else if (in_mode_ > parameters_.prepare_cycles + cycles_.enable) {
    stop(Fault::kDriveLeft);
  }
}

void Supervisor::test_sign(const Observation& seen) noexcept {
  const SignTest::Result result = sign_test_.update(seen.q, test_torque_);
  if (result == SignTest::Result::kPassed) {
    sign_tested_ = true;
    enter(Mode::kArmed);
  } else if (result != SignTest::Result::kRunning) {
    stop(result == SignTest::Result::kWrong ? Fault::kSignWrong : Fault::kSignUndecided, sign_test_.joint());
  } else if (moved(seen, kMovesAway)) {
    stop(Fault::kSignWrong);
  }
}

void Supervisor::reset(const Observation& seen) noexcept {
  if (seen.drives.all_answer && !seen.drives.any_fault && last_power_ == hal::PowerRequest::kReset) {
    fault_ = Fault::kNone;
    fault_joint_ = -1;
    enter(Mode::kBoot);
  } else if (in_mode_ > cycles_.fault_stop) {
    enter(Mode::kStopped);
  }
}

/// A stop must not give power to a drive that has lost it, or never had it.
hal::PowerRequest Supervisor::power_to_stop(const DriveSummary& drives, bool may_hold) const noexcept {
  if (last_power_ == hal::PowerRequest::kOff) return hal::PowerRequest::kOff;
  const bool holds = may_hold && drives.all_enabled && last_power_ == hal::PowerRequest::kEnable;
  return holds ? hal::PowerRequest::kEnable : hal::PowerRequest::kQuickStop;
}

/// Until the drives are seen at rest the quick stop continues: a drive that loses its power breaks its ramp off.
hal::PowerRequest Supervisor::power_after_stop(const DriveSummary& drives) const noexcept {
  const bool goes_on = last_power_ == hal::PowerRequest::kQuickStop && !seen_at_rest(drives);
  return goes_on ? hal::PowerRequest::kQuickStop : hal::PowerRequest::kOff;
}

Decision Supervisor::decide(const Observation& seen) const noexcept {
  Decision decision;
  switch (mode_) {
    case Mode::kResetting: {
      // a reset takes the power away, too: it waits for the end of the ramp
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
      decision.share = 1.0 - static_cast<double>(in_mode_) / cycles_.fade;
      decision.of_last = true;
      decision.rate_limited = false;
      break;
    case Mode::kStopping:
      decision.power = power_to_stop(seen.drives, in_mode_ <= cycles_.hold);
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
