#include "firmware/cycle/torque_limiter.h"

#include <algorithm>
#include <cmath>

namespace godobject::firmware {

TorqueLimiter::TorqueLimiter(const ArmModel& arm, const TorqueLimits& limits) noexcept : limits_(limits) {
  for (int i = 0; i < arm.joint_count; ++i) {
    torque_limit_[i] = arm.joints[static_cast<std::size_t>(i)].torque;
    speed_limit_[i] = arm.joints[static_cast<std::size_t>(i)].velocity;
  }
}

int TorqueLimiter::too_fast_joint(const JointVector& qd) const noexcept {
  for (int i = 0; i < static_cast<int>(kMaxJoints); ++i) {
    if (std::fabs(qd[i]) > limits_.joint_speed_stop * speed_limit_[i]) return i;
  }
  return -1;
}

/// Fades out the torque along the motion of a fast joint.
JointVector TorqueLimiter::slowed(JointVector rendered, const JointVector& qd) const noexcept {
  for (int i = 0; i < kMaxJoints; ++i) {
    const double begin = limits_.joint_speed * speed_limit_[i];
    const double end = limits_.joint_speed_stop * speed_limit_[i];
    const double speed = std::fabs(qd[i]);
    if (rendered[i] * qd[i] > 0.0 && speed > begin) rendered[i] *= std::max(0.0, (end - speed) / (end - begin));
  }
  return rendered;
}

JointVector TorqueLimiter::apply(const Decision& decision, const ComputedTorque& computed,
                                 const JointVector& qd) noexcept {
  if (computed.holding.allFinite()) holding_ = computed.holding;
  if (!decision.of_last) faded_ = pushed_;
  const JointVector holding = decision.holds_arm ? holding_ : JointVector::Zero();
  JointVector wanted = holding;
  if (decision.of_last) {
    wanted += decision.share * faded_;
  } else {
    wanted += decision.test_torque;
    if (decision.share > 0.0) wanted += decision.share * slowed(computed.rendered, qd);
  }
  if (!wanted.allFinite()) wanted = holding;  // before the clamp, which would turn a NaN into a number
  JointVector torque = wanted.cwiseMax(-torque_limit_).cwiseMin(torque_limit_);
  rate_limited_ = false;
  if (decision.rate_limited) {
    const JointVector step = limits_.rate * torque_limit_;
    const JointVector near = torque.cwiseMax(sent_ - step).cwiseMin(sent_ + step);
    rate_limited_ = near != torque;
    torque = near;
  }
  if (!torque.allFinite()) torque.setZero();
  pushed_ = torque - holding;
  sent_ = torque;
  return torque;
}

}  // namespace godobject::firmware
