#pragma once

#include <array>

#include "core/device/arm_model.h"

namespace godobject {

/// Joint velocity from the last N positions, one a period T: the slope of the least-squares line.
///
///   v = sum_k w_k q_k,  w_k = 12 (k - (N-1)/2) / (T N (N^2 - 1)),  k = 0 .. N-1 from the oldest on
///
/// - Constant velocity: exact from the second position on.
/// - Delay (N-1) T/2: for constant acceleration the estimate is exactly the velocity at that time.
/// - Noise: independent errors of standard deviation s give s sqrt(12 / (N (N^2 - 1))) / T.
/// - An encoder of quantum h, rounding to nearest, gives at most h/2 sum |w_k|: 1.5 h / (T N) for odd N,
///   1.5 h N / (T (N^2 - 1)) for even N.
///
/// N = 2 is the plain difference. The estimator accumulates nothing, so it does not drift.
class VelocityEstimator {
 public:
  static constexpr int kMaxWindow = 32;

  /// `window`: N, clamped to 2 .. kMaxWindow; `period`: T [s].
  VelocityEstimator(int window, double period) noexcept;

  /// Takes the position q [rad] of this period and returns the velocity qd [rad/s]; zero at the first call. Uses the
  /// positions that there are until there are N. `kNotFinite`: q is not finite; nothing changes.
  /// Cost: N multiplications a joint, 150 ns for N = 16. Real-time safe.
  Status update(const JointVector& q, JointVector& qd) noexcept;

  /// Forgets all positions: after a pause, or after lost positions.
  void reset() noexcept { count_ = 0; }

  /// Delay of the estimate with N positions [s].
  double delay() const noexcept { return 0.5 * (window_ - 1) * period_; }

 private:
  int window_;
  double period_;
  int count_ = 0;  // positions in the ring
  int newest_{};   // index of the newest
  std::array<JointVector, kMaxWindow> positions_;
};

}  // namespace godobject
