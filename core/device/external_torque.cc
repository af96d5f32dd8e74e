#include "core/device/external_torque.h"

namespace godobject {

void ExternalTorqueObserver::update(const ArmModel& model, const ArmKinematics& kinematics, const JointVector& qd,
                                    const JointVector& torque, std::uint32_t periods) noexcept {
  const ArmMomentum arm = arm_momentum(model, kinematics, qd);
  JointVector known = torque + arm.change - gravity_torque(model, kinematics);
  for (int i = 0; i < model.joint_count; ++i) known[i] -= model.joints[static_cast<std::size_t>(i)].damping * qd[i];
  if (!started_ || !known.allFinite() || !arm.momentum.allFinite()) {
    started_ = arm.momentum.allFinite();
    integral_ = arm.momentum;
    estimate_.setZero();
    return;
  }
  // implicit in the estimate, so that it is stable whatever the periods
  const double elapsed = periods * period_;
  integral_ += elapsed * known;
  estimate_ = bandwidth_ / (1.0 + bandwidth_ * elapsed) * (arm.momentum - integral_);
  integral_ += elapsed * estimate_;
}

}  // namespace godobject
