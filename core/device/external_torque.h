#pragma once

#include <cstdint>

#include "core/device/dynamics.h"

namespace godobject {

/// Estimates the joint torques that act on an arm besides those of its motors: a hand, a load that the model does not
/// have, dry friction. A disturbance observer of the generalized momentum (De Luca and Mattone 2003): it needs neither
/// accelerations nor the inverse of the mass matrix.
///
/// r = K (p - integral of (tau + dT/dq - gravity - damping qd + r) dt - p(0)), so that r' = K (tau_e - r): the estimate
/// follows the true torque tau_e with the time constant 1/K, if the model is right.
class ExternalTorqueObserver {
 public:
  /// `bandwidth`: K [1/s]; `period`: T [s].
  ExternalTorqueObserver(double bandwidth, double period) noexcept : bandwidth_(bandwidth), period_(period) {}

  /// Forgets everything. The next `update` starts with no external torque.
  void reset() noexcept { started_ = false; }

  /// A cycle, `periods` after the last one: since then the motors had the torque [Nm], and now the joints move with
  /// `qd` [rad/s]. `kinematics`: of the present positions. An argument that is not finite starts the observer again.
  /// Cost: 1 us for seven joints. Real-time safe.
  void update(const ArmModel& model, const ArmKinematics& kinematics, const JointVector& qd, const JointVector& torque,
              std::uint32_t periods = 1) noexcept;

  /// The estimate r [Nm]; zero from the joint count on.
  const JointVector& torque() const noexcept { return estimate_; }

 private:
  double bandwidth_;
  double period_;
  bool started_ = false;
  JointVector integral_ = JointVector::Zero();  // p(0) and what the model accounts for since then
  JointVector estimate_ = JointVector::Zero();
};

}  // namespace godobject
