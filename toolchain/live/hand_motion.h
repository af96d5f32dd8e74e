#pragma once

#include "godobject/pose.h"

namespace godobject::live {

/// The motion of a hand towards a goal that jumps, as a pointer's does: smooth, with bounded speed, and never far from
/// the mesh that it pulls, so that its force is bounded, too.
class HandMotion {
 public:
  struct Limits {
    double speed = 0.0;    ///< [m/s]
    double turn = 0.0;     ///< [rad/s]
    double stretch = 0.0;  ///< largest distance from the pulled mesh [m]
    double twist = 0.0;    ///< largest angle to it [rad]
  };

  HandMotion(const Limits& limits, const Pose& start) noexcept : limits_(limits), pose_(start), goal_(start) {}

  void set_goal(const Pose& goal) noexcept { goal_ = goal; }

  /// Moves on by `period` [s]. The rest of the way follows the law of a critically damped spring of kFrequency.
  /// `pulled`: pose of the mesh that the hand pulls; `strength`: factor on stretch and twist [0, 1].
  void advance(double period, const Pose& pulled, double strength = 1.0) noexcept;

  const Pose& pose() const noexcept { return pose_; }
  const Motion& velocity() const noexcept { return velocity_; }  ///< of the origin [m/s]; angular [rad/s]

 private:
  static constexpr double kFrequency = 30.0;  ///< chosen: a step of the goal is done in a sixth of a second [rad/s]

  Limits limits_;
  Pose pose_;
  Motion velocity_;
  Pose goal_;
};

}  // namespace godobject::live
