#include "core/device/external_torque.h"

namespace godobject {

void ExternalTorqueObserver::update(const ArmModel& model, const ArmKinematics& kinematics, const JointVector& qd,
                                    const JointVector& torque) noexcept {
  const ArmMomentum arm = arm_momentum(model, kinematics, qd);
  JointVector known = torque + arm.change - gravity_torque(model, kinematics);
  for (int i = 0; i < model.joint_count; ++i) known[i] -= model.joints[static_cast<std::size_t>(i)].damping * qd[i];
  if (!started_ || !known.allFinite() || !arm.momentum.allFinite()) {
    started_ = arm.momentum.allFinite();
    integral_ = arm.momentum;
    estimate_.setZero();
    return;
  }
  integral_ += period_ * (known + estimate_);
  estimate_ = bandwidth_ * (arm.momentum - integral_);
}

}  // namespace godobject
