#include "core/device/velocity_estimator.h"

#include <algorithm>

namespace godobject {

VelocityEstimator::VelocityEstimator(int window, double period) noexcept
    : window_(std::clamp(window, 2, kMaxWindow)), period_(period) {}

Status VelocityEstimator::update(const JointVector& q, JointVector& qd) noexcept {
  if (!q.allFinite()) return Status::kNotFinite;
  newest_ = (newest_ + 1) % window_;
  positions_[static_cast<std::size_t>(newest_)] = q;
  count_ = std::min(count_ + 1, window_);
  qd.setZero();
  if (count_ < 2) return Status::kOk;

  // the weights sum to zero, so differences to the newest position will do: no digits are lost far from zero
  const double n = count_;
  for (int age = 1; age < count_; ++age) {
    const auto slot = static_cast<std::size_t>((newest_ - age + window_) % window_);
    qd += (0.5 * (n - 1.0) - age) * (positions_[slot] - q);
  }
  qd *= 12.0 / (period_ * n * (n * n - 1.0));
  return Status::kOk;
}

}  // namespace godobject
