#include "core/device/passivity.h"

#include <algorithm>
#include <cmath>

namespace godobject {

PassivityObserver::PassivityObserver(double delay_in_periods) noexcept {
  const double delay = std::clamp(delay_in_periods, 0.0, static_cast<double>(kMostDelay));
  whole_ = static_cast<int>(std::floor(delay));
  share_ = delay - whole_;
  reset();
}

void PassivityObserver::reset() noexcept {
  started_ = false;
  absorbed_ = 0.0;
  for (JointVector& torque : sent_) torque.setZero();
}

void PassivityObserver::observe(const JointVector& q) noexcept {
  if (started_) {
    const JointVector held = share_ * sent(whole_ + 1) + (1.0 - share_) * sent(whole_);
    absorbed_ -= held.dot(q - q_);
  }
  q_ = q;
  started_ = true;
}

void PassivityObserver::send(const JointVector& torque) noexcept {
  newest_ = (newest_ + 1) % kRing;
  sent_[static_cast<std::size_t>(newest_)] = torque;
}

void PassivityController::reset() noexcept {
  forgotten_ = 0.0;
  unloaded_ = 0;
  damping_ = 0.0;
}

Wrench PassivityController::apply(double absorbed, const Wrench& F, const Motion& V) noexcept {
  const double length = parameters_.rotation_length;
  const double square = F.force.squaredNorm() + F.torque.squaredNorm() / (length * length);
  const double power = F.force.dot(V.translation) + F.torque.dot(V.rotation);
  damping_ = 0.0;
  unloaded_ = square > 0.0 ? 0 : std::min(unloaded_ + 1, forget_);
  if (unloaded_ == forget_) forgotten_ = std::max(forgotten_, absorbed);
  const double debt = forgotten_ - absorbed;
  if (!(debt > 0.0 && square > 0.0) || power == 0.0) return F;
  // compared before the division, whose divisor may be close to zero
  const double pays_all = debt * square;
  const double square_power = parameters_.period * power * power;
  damping_ = pays_all < parameters_.most_damping * square_power ? pays_all / square_power : parameters_.most_damping;
  const double factor = std::max(0.0, 1.0 - damping_ * power / square);
  return {factor * F.force, factor * F.torque};
}

}  // namespace godobject
