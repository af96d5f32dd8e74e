#pragma once

#include "core/device/arm_model.h"
#include "firmware/cycle/supervisor.h"

namespace godobject::firmware {

/// Limits of the torque limiter. The defaults are those of the controller file, whose ranges stand in
/// firmware/configuration/controller_file.cc.
struct TorqueLimits {
  /// Largest change in a cycle: share of a joint's torque limit. Chosen: the full torque in 20 cycles, below the cycles
  /// of `prepare_cycles`; it is also the largest value of the controller file.
  double rate = 0.05;
  double joint_speed = 0.8;       ///< share of a joint's speed limit above which torque along the motion fades out
  double joint_speed_stop = 1.0;  ///< share at which that torque is zero, and above which a joint is too fast: a fault
};

/// The computed torques of a cycle. The supervisor decides which of them are sent.
struct ComputedTorque {
  JointVector holding = JointVector::Zero();   ///< torques that hold the arm [Nm]
  JointVector rendered = JointVector::Zero();  ///< torques in addition to them [Nm]
};

/// The last step of a cycle, whatever produced the torques: granted share, joint speed, torque limit, rate, finite
/// check.
class TorqueLimiter {
 public:
  TorqueLimiter(const ArmModel& arm, const TorqueLimits& limits) noexcept;

  /// The torques to send [Nm]: finite, within the joints' limits and, if the decision is rate-limited, within `rate` of
  /// the last ones. If a computed torque is not finite the last finite holding torque holds the arm. `qd`: joint
  /// velocities [rad/s]. Cost: 50 ns. Real-time safe.
  JointVector apply(const Decision& decision, const ComputedTorque& computed, const JointVector& qd) noexcept;

  /// True if a joint is above its stop speed: a fault.
  bool too_fast(const JointVector& qd) const noexcept { return too_fast_joint(qd) >= 0; }

  /// The first joint above its stop speed; -1: none.
  int too_fast_joint(const JointVector& qd) const noexcept;

  const JointVector& pushed() const noexcept {
    return pushed_;
  }  ///< last sent torques without those that hold the arm [Nm]
  bool rate_limited() const noexcept { return rate_limited_; }  ///< in the last cycle

 private:
  JointVector slowed(JointVector rendered, const JointVector& qd) const noexcept;

  TorqueLimits limits_;
  JointVector torque_limit_ = JointVector::Zero();
  JointVector speed_limit_ = JointVector::Zero();
  JointVector sent_ = JointVector::Zero();
  JointVector pushed_ = JointVector::Zero();
  JointVector holding_ = JointVector::Zero();
  JointVector faded_ = JointVector::Zero();  // torques at the beginning of a FADE
  bool rate_limited_ = false;
};

}  // namespace godobject::firmware
