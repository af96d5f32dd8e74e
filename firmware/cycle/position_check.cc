#include "firmware/cycle/position_check.h"

#include <algorithm>
#include <cmath>

#include "firmware/cycle/cycles_in.h"

namespace godobject::firmware {

PositionCheck::PositionCheck(const ArmModel& arm, double stuck_torque, double period) noexcept
    : joint_count_(arm.joint_count), period_(period), cycles_a_sample_(cycles_in(1e-3, period)) {
  for (int i = 0; i < joint_count_; ++i) {
    const ArmJoint& joint = arm.joints[static_cast<std::size_t>(i)];
    largest_step_[i] = kJumpOfVelocity * joint.velocity * period;
    stuck_torque_[i] = stuck_torque * joint.torque;
    speed_step_[i] = joint.velocity * period * cycles_a_sample_;
  }
}

void PositionCheck::update(const hal::JointReading& reading, const JointVector& qd, const JointVector& pushed,
                           std::uint32_t skipped, CheckedPositions& checked) noexcept {
  checked = CheckedPositions();
  const std::uint32_t periods = 1 + skipped;
  for (int i = 0; i < joint_count_; ++i) {
    const auto joint = static_cast<std::size_t>(i);
    const double position = reading.position[i];
    const bool finite = std::isfinite(position) && std::isfinite(reading.torque[i]);
    checked.finite = checked.finite && finite;
    if (!finite) checked.not_finite_joint = i;
    // a constant lateness is as bad as a missing position; an age also counts skipped cycles
    lost_[joint] = reading.age[joint] == 0 ? 0 : lost_[joint] + 1;
    const std::uint32_t lost = std::max(lost_[joint], reading.age[joint]);
    if (lost > checked.lost) checked.lost_joint = i;
    checked.lost = std::max(checked.lost, lost);
    if (!started_) {
      accepted_[i] = q_[i] = position;
      fresh_[i] = position;
      periods_[joint] = jumps_[joint] = predicted_[joint] = 0;
      motion_[joint] = Motion();
      motion_[joint].last.fill(position);  // no motion from zero to the first position
      continue;
    }
    periods_[joint] += periods;
    const bool fresh = reading.age[joint] == 0;
    // false for a NaN
    const bool possible = std::fabs(position - accepted_[i]) <= largest_step_[i] * periods_[joint];
    if (fresh && possible) {
      accepted_[i] = q_[i] = position;
      periods_[joint] = jumps_[joint] = predicted_[joint] = 0;
    } else {
      const double first = fresh_[i] - accepted_[i];  // zero without a jump before
      const double second = position - fresh_[i];
      const double far = largest_step_[i] * periods;
      const bool far_on = std::fabs(first) > far && std::fabs(second) > far && first * second > 0.0;
      checked.runs_away = checked.runs_away || (fresh && far_on);
      if (fresh) ++jumps_[joint];
      ++predicted_[joint];
      q_[i] += qd[i] * period_ * periods;
    }
    if (fresh) fresh_[i] = position;
    if (jumps_[joint] > checked.jumps) checked.jump_joint = i;
    checked.jumps = std::max(checked.jumps, jumps_[joint]);
    checked.predicted = std::max(checked.predicted, predicted_[joint]);
  }
  checked.predicted = std::max(checked.predicted, checked.lost);
  started_ = checked.finite;
  checked.q = q_;
  if (++since_sample_ < cycles_a_sample_) return;
  since_sample_ = 0;
  const int abruptly = stops_abruptly(reading);
  const int pushed_in_vain = rests_though_pushed(reading, pushed);
  checked.stuck_joint = pushed_in_vain >= 0 ? pushed_in_vain : abruptly;
  checked.stuck = checked.stuck_joint >= 0;
}

/// Returns the joint; -1: none.
int PositionCheck::stops_abruptly(const hal::JointReading& reading) noexcept {
  int found = -1;
  for (int i = 0; i < joint_count_; ++i) {
    if (reading.age[static_cast<std::size_t>(i)] > 0) continue;
    Motion& motion = motion_[static_cast<std::size_t>(i)];
    const double position = reading.position[i];
    if (position == motion.last[0]) {
      if (motion.still == 0) {
        motion.abrupt =
            motion.moving >= kMoving && std::fabs(position - motion.last[kMoving]) > kMotion * kMoving * speed_step_[i];
      }
      ++motion.still;
      motion.moving = 0;
    } else {
      ++motion.moving;
      motion.still = 0;
    }
    for (std::size_t k = kMoving; k > 0; --k) motion.last[k] = motion.last[k - 1];
    motion.last[0] = position;
    if (found < 0 && motion.abrupt && motion.still >= kStill) found = i;
  }
  return found;
}

/// Returns the joint; -1: none.
int PositionCheck::rests_though_pushed(const hal::JointReading& reading, const JointVector& pushed) noexcept {
  if (in_window_ == 0) {
    window_start_ = reading.position;
    rests_.fill(true);
    moved_ = false;
  }
  for (int i = 0; i < joint_count_; ++i) {
    const double motion = std::fabs(reading.position[i] - window_start_[i]);
    moved_ = moved_ || motion > kOtherMotion * kWindow * speed_step_[i];
    bool& rests = rests_[static_cast<std::size_t>(i)];
    rests = rests && motion == 0.0 && std::fabs(pushed[i]) > stuck_torque_[i] &&
            reading.age[static_cast<std::size_t>(i)] == 0;
  }
  if (++in_window_ < kWindow) return -1;
  in_window_ = 0;
  const auto* const first = rests_.begin();
  const auto* const end = first + joint_count_;
  const auto* const found = std::find(first, end, true);
  return moved_ && found != end ? static_cast<int>(found - first) : -1;
}

}  // namespace godobject::firmware
