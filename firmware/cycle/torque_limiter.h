#pragma once

#include "core/device/arm_model.h"
#include "firmware/cycle/supervisor.h"

namespace godobject::firmware {

struct TorqueLimits {
  double rate = 0.05;             ///< largest change in a cycle, share of a joint's torque limit
  double joint_speed = 0.8;       ///< share of a joint's speed limit from which on pushing along the motion fades out
  double joint_speed_stop = 1.0;  ///< share at which nothing pushes along; beyond it is a fault
};

/// Torques of a cycle that were computed; what of them is sent is the supervisor's decision.
struct ComputedTorque {
  JointVector holding = JointVector::Zero();   ///< holds the arm [Nm]
  JointVector rendered = JointVector::Zero();  ///< on top of it [Nm]
};

/// Last in the cycle, whatever produced the torques: what is granted, then speed, limit, rate, and the finite check.
class TorqueLimiter {
 public:
  TorqueLimiter(const ArmModel& arm, const TorqueLimits& limits) noexcept;

  /// The torques to send [Nm]: finite, within the joints' limits, and where the decision says so no further from the
  /// last ones than the rate. If what was computed is not finite the arm is held by the last torque that held it.
  /// `qd`: joint velocities [rad/s]. Cost: 50 ns. Real-time safe.
  JointVector apply(const Decision& decision, const ComputedTorque& computed, const JointVector& qd) noexcept;

  /// A joint is faster than it may be: a fault.
  bool too_fast(const JointVector& qd) const noexcept;

  const JointVector& pushed() const noexcept { return pushed_; }  ///< sent last, without what holds the arm [Nm]
  bool rate_limited() const noexcept { return rate_limited_; }    ///< in the last cycle

 private:
  JointVector slowed(JointVector rendered, const JointVector& qd) const noexcept;

  TorqueLimits limits_;
  JointVector torque_limit_ = JointVector::Zero();
  JointVector speed_limit_ = JointVector::Zero();
  JointVector sent_ = JointVector::Zero();
  JointVector pushed_ = JointVector::Zero();
  JointVector holding_ = JointVector::Zero();
  JointVector faded_ = JointVector::Zero();  // what a FADE begins with
  bool rate_limited_ = false;
};

}  // namespace godobject::firmware
