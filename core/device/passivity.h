#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/device/joint_vector.h"
#include "godobject/pose.h"

namespace godobject {

/// Measures the energy that sampled, delayed torques take from the arm and the hand on it (passivity observer:
/// Hannaford and Ryu, IEEE Transactions on Robotics and Automation 18(1), 2002).
///
/// A torque that is sent at sample k acts t_d = (D + s) T later, 0 <= s < 1, and is held for T. So from sample k-1 to
/// sample k
///     E += -(s tau_(k-2-D) + (1 - s) tau_(k-1-D)) . (q_k - q_(k-1)),
/// which is exact for a joint that moves evenly between samples. A negative E means that torques have given energy: a
/// sampled, delayed spring is not passive where K (T/2 + t_d) exceeds the damping. Cost: 20 ns. Real-time safe.
class PassivityObserver {
 public:
  /// Longest delay in periods. A ring of 44 torques then holds all that may still act. Derived: the longest delay of a
  /// device file is 41 of its shortest period, 0.125 ms: a bus plan ends within one and `bus.drive_delay` within 40.
  static constexpr int kMostDelay = 42;

  /// `delay_in_periods`: t_d / T, clamped to 0 .. kMostDelay.
  explicit PassivityObserver(double delay_in_periods) noexcept;

  /// Forgets all torques and the energy.
  void reset() noexcept;

  /// Takes the joint positions [rad] of this period, before `send`. The first call after `reset` adds no energy.
  void observe(const JointVector& q) noexcept;
  /// Takes the torques that are sent in this period [Nm].
  void send(const JointVector& torque) noexcept;

  double absorbed() const noexcept { return absorbed_; }  ///< E [J]

 private:
  static constexpr int kRing = kMostDelay + 2;

  const JointVector& sent(int samples_ago) const noexcept {
    return sent_[static_cast<std::size_t>((newest_ - samples_ago + 2 * kRing) % kRing)];
  }

  int whole_;     // D
  double share_;  // s
  bool started_{};
  double absorbed_{};
  JointVector q_ = JointVector::Zero();
  std::array<JointVector, kRing> sent_;
  int newest_{};
};

/// Damps the rendered wrench until the energy that it has given is absorbed again (passivity controller: the same
/// source, there for one axis). The damper acts along the rendered wrench, with lengths as in the virtual coupling.
/// With F = (f, t/L), V = (v, L w) and P = F . V the wrench becomes
///     (1 - b P / |F|^2) F,   b = min(b_max, debt |F|^2 / (T P^2)), never below 0,
/// where the debt is the energy given so far. The damper absorbs at most the debt in a period, and at most as much as a
/// damper b_max. It keeps the wrench's direction, also that of a friction cone, and turns no push into a pull. A wrench
/// of zero stays zero.
///
/// A surplus, energy taken, must not be given back to a later contact: it is forgotten after kForget periods without a
/// wrench, or two more than the delay. A debt is not forgotten. Cost: 20 ns. Real-time safe.
class PassivityController {
 public:
  struct Parameters {
    double most_damping = 0.0;     ///< b_max [Ns/m]; 0: the wrench does not change
    double period = 1e-3;          ///< T [s]
    double rotation_length = 0.1;  ///< L [m]
  };

  /// Least periods until a surplus is forgotten. Chosen: more than those for which a torque acts after it was sent,
  /// where the delay is below 14 periods.
  static constexpr int kForget = 16;

  /// `delay_in_periods`: t_d / T, as for the observer.
  PassivityController(const Parameters& parameters, double delay_in_periods) noexcept
      : parameters_(parameters), forget_(std::max(kForget, static_cast<int>(std::ceil(delay_in_periods)) + 2)) {}

  /// Forgets debt and surplus. The caller resets the observer, too.
  void reset() noexcept;

  /// The wrench to render in place of `F` [N, Nm] on a hand with the velocity `V` [m/s, rad/s]. Both are about the same
  /// point on the same axes. `absorbed`: the observer's energy [J].
  Wrench apply(double absorbed, const Wrench& F, const Motion& V) noexcept;

  double damping() const noexcept { return damping_; }  ///< b of the last call [Ns/m]

 private:
  Parameters parameters_;
  int forget_;              // periods until a surplus is forgotten
  double forgotten_ = 0.0;  // the observer's energy from which debts count [J]
  int unloaded_ = 0;        // periods without a wrench, in a row
  double damping_ = 0.0;
};

}  // namespace godobject
