#include "toolchain/live/hand_motion.h"

namespace godobject::live {
namespace {

/// The vector, shortened to `longest`.
Vector3 limited(const Vector3& v, double longest) noexcept {
  const double length = v.norm();
  return length > longest ? Vector3(longest / length * v) : v;
}

/// The goal, not farther from `pulled` than this.
Pose within_reach(const Pose& goal, const Pose& pulled, double stretch, double twist) noexcept {
  const Vector3 turn = log_rotation(goal.rotation * pulled.rotation.conjugate());
  return {exp_rotation(limited(turn, twist)) * pulled.rotation,
          pulled.translation + limited(goal.translation - pulled.translation, stretch)};
}

}  // namespace

void HandMotion::advance(double period, const Pose& pulled, double strength) noexcept {
  const Pose goal = within_reach(goal_, pulled, strength * limits_.stretch, strength * limits_.twist);
  const Vector3 way = goal.translation - pose_.translation;
  const Vector3 turn = log_rotation(goal.rotation * pose_.rotation.conjugate());
  // implicit Euler: stable for any period
  const double f = kFrequency;
  const double share = 1.0 / (1.0 + 2.0 * f * period + f * f * period * period);
  velocity_.translation = limited(share * (velocity_.translation + f * f * period * way), limits_.speed);
  velocity_.rotation = limited(share * (velocity_.rotation + f * f * period * turn), limits_.turn);
  pose_.translation += period * velocity_.translation;
  pose_.rotation = (exp_rotation(period * velocity_.rotation) * pose_.rotation).normalized();
  // a mesh that is thrown back, or a hand that grows weak: the pull must not exceed its bound meanwhile
  pose_ = within_reach(pose_, pulled, strength * limits_.stretch, strength * limits_.twist);
}

}  // namespace godobject::live
