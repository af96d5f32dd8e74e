#pragma once

#include <array>

#include "core/device/joint_vector.h"
#include "godobject/pose.h"

namespace godobject {

/// The energy that sampled, delayed torques have taken from the arm and the hand on it, in the time domain (passivity
/// observer: Hannaford and Ryu, IEEE Transactions on Robotics and Automation 18(1), 2002).
///
/// What is sent at sample k acts t_d = (D + s) T later, 0 <= s < 1, and is held for T. So from sample k-1 to sample k
///     E += -(s tau_(k-2-D) + (1 - s) tau_(k-1-D)) . (q_k - q_(k-1)),
/// exact for a joint that moves evenly between samples. Below zero torques have given energy: held force and delay are
/// not passive where K (T/2 + t_d) is more than the damping. Cost: 20 ns. Real-time safe.
class PassivityObserver {
 public:
  static constexpr int kMostDelay = 14;

  /// `delay_in_periods` t_d / T is brought into 0 .. kMostDelay.
  explicit PassivityObserver(double delay_in_periods) noexcept;

  /// Nothing has been sent, and no energy taken.
  void reset() noexcept;

  /// Once a period, before `send`: where the joints are [rad]. The first time after `reset` there is no way yet.
  void observe(const JointVector& q) noexcept;
  /// What is sent now [Nm].
  void send(const JointVector& torque) noexcept;

  double absorbed() const noexcept { return absorbed_; }  ///< E [J]

 private:
  static constexpr int kRing = kMostDelay + 2;

  const JointVector& sent(int samples_ago) const noexcept {
    return sent_[static_cast<std::size_t>((newest_ - samples_ago + 2 * kRing) % kRing)];
  }

  int whole_;     // D
  double share_;  // s
  bool started_ = false;
  double absorbed_ = 0.0;
  JointVector q_ = JointVector::Zero();
  std::array<JointVector, kRing> sent_;
  int newest_ = 0;
};

/// Pays back with damping what the observer finds to have been given away (passivity controller: the same source, there
/// for one axis). The damper lies along the wrench that is rendered, lengths as in the virtual coupling: with
/// F = (f, t/L), V = (v, L w) and P = F . V the wrench becomes
///     (1 - b P / |F|^2) F,   b = min(b_max, debt |F|^2 / (T P^2)), never below 0.
/// So it pays no more than the debt in a period and no more than a damper b_max takes, keeps the wrench's direction
/// (that of a friction cone, too) and turns no push into a pull. A wrench of zero stays zero.
///
/// Energy that was taken while nothing is rendered any more cannot be meant to come back: a surplus is forgotten after
/// kForget periods without a wrench, a debt is not. Cost: 20 ns. Real-time safe.
class PassivityController {
 public:
  struct Parameters {
    double most_damping = 0.0;     ///< b_max [Ns/m]; 0: the wrench is left as it is
    double period = 1e-3;          ///< T [s]
    double rotation_length = 0.1;  ///< L [m]
  };

  static constexpr int kForget = PassivityObserver::kMostDelay + 2;  ///< longer than anything sent still acts

  explicit PassivityController(const Parameters& parameters) noexcept : parameters_(parameters) {}

  /// No debt and no surplus; the observer begins anew, too.
  void reset() noexcept;

  /// The wrench to render in place of `F` on a hand that moves with `V` [N, Nm; m/s, rad/s], both about the same point
  /// in the same frame, where the observer has seen `absorbed` [J].
  Wrench apply(double absorbed, const Wrench& F, const Motion& V) noexcept;

  double damping() const noexcept { return damping_; }  ///< b of the last call [Ns/m]

 private:
  Parameters parameters_;
  double forgotten_ = 0.0;  // of the observer's energy [J]
  int unloaded_ = 0;        // periods without a wrench, in a row
  double damping_ = 0.0;
};

}  // namespace godobject
