#include "firmware/cycle/sign_test.h"

#include <cmath>

#include "firmware/cycle/cycles_in.h"

namespace godobject::firmware {

SignTest::SignTest(const ArmModel& arm, const Parameters& parameters, double period) noexcept
    : joint_count_(arm.joint_count),
      still_cycles_(cycles_in(1e-3 * kStill_ms, period)),
      push_cycles_(cycles_in(1e-3 * kPush_ms, period)),
      motion_(parameters.motion) {
  for (int i = 0; i < joint_count_; ++i) {
    largest_[i] = parameters.push * arm.joints[static_cast<std::size_t>(i)].torque;
  }
}

void SignTest::restart() noexcept {
  result_ = Result::kRunning;
  joint_ = attempt_ = first_response_ = 0;
  direction_ = 1.0;
  cycle_ = waits_ = 0;
}

SignTest::Result SignTest::update(const JointVector& q, JointVector& torque) noexcept {
  torque.setZero();
  if (result_ != Result::kRunning) return result_;
  const double position = q[joint_];
  if (cycle_ == 0) begin_ = position;
  if (cycle_ <= still_cycles_) slope_ = cycle_ == 0 ? 0.0 : (position - begin_) / cycle_;
  const double deviation = direction_ * (position - begin_ - slope_ * cycle_);
  ++cycle_;
  if (cycle_ <= still_cycles_) return result_;
  // a joint that springs back from the push before is on no straight line: wait for it, but not for a steady drift
  if (cycle_ == still_cycles_ + 1 && std::fabs(position - begin_) > kAtRest * motion_ && ++waits_ < kWaits) {
    cycle_ = 0;
    return result_;
  }
  if (std::fabs(deviation) > motion_) {
    finish_push(deviation > 0.0 ? 1 : -1);
  } else if (cycle_ == still_cycles_ + push_cycles_) {
    finish_push(0);
  } else {
    torque[joint_] = direction_ * largest_[joint_] * (cycle_ - still_cycles_) / push_cycles_;
  }
  return result_;
}

void SignTest::finish_push(int response) noexcept {
  cycle_ = waits_ = 0;
  if (direction_ > 0.0) {
    first_response_ = response;
    direction_ = -1.0;
    return;
  }
  direction_ = 1.0;
  if (first_response_ == 1 && response == 1) {
    attempt_ = 0;
    if (++joint_ == joint_count_) {
      joint_ = joint_count_ - 1;
      result_ = Result::kPassed;
    }
  } else if (first_response_ == -1 && response == -1) {
    result_ = Result::kWrong;
  } else if (++attempt_ == kAttempts) {
    result_ = Result::kUndecided;
  }
}

}  // namespace godobject::firmware
