#pragma once

#include <array>

#include "core/device/arm_model.h"

namespace godobject {

/// Joint velocity from the last N positions, one a period T: the slope of the straight line of least squares.
///
///   v = sum_k w_k q_k,  w_k = 12 (k - (N-1)/2) / (T N (N^2 - 1)),  k = 0 .. N-1 from the oldest on
///
/// - Constant velocity: exact once two positions are there.
/// - Delay (N-1) T/2: for constant acceleration the estimate is the velocity of that moment, exactly.
/// - Noise: independent errors of standard deviation s give s sqrt(12 / (N (N^2 - 1))) / T.
/// - An encoder of quantum h, rounding to nearest, gives at most h/2 sum |w_k|: 1.5 h / (T N) for odd N,
///   1.5 h N / (T (N^2 - 1)) for even N.
///
/// N = 2 is the plain difference. Nothing is summed up over time, so nothing drifts.
class VelocityEstimator {
 public:
  static constexpr int kMaxWindow = 16;

  /// `window` N is brought into 2 .. kMaxWindow; `period` T [s].
  VelocityEstimator(int window, double period) noexcept;

  /// Takes the position q [rad] of this period and gives the velocity qd [rad/s]; zero at the first call. Until N
  /// positions are there, it uses those that are. `kNotFinite`: q is not; nothing has changed.
  /// Cost: N multiplications a joint, 150 ns for N = 16. Real-time safe.
  Status update(const JointVector& q, JointVector& qd) noexcept;

  /// Forgets all positions: after a pause, or when positions were lost.
  void reset() noexcept { count_ = 0; }

  /// Delay once the window is full [s].
  double delay() const noexcept { return 0.5 * (window_ - 1) * period_; }

 private:
  int window_;
  double period_;
  int count_ = 0;   // positions that are there
  int newest_ = 0;  // where the newest is
  std::array<JointVector, kMaxWindow> positions_;
};

}  // namespace godobject
