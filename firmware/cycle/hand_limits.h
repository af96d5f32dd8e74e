#pragma once

#include "godobject/pose.h"

namespace godobject::firmware {

/// Limits of force, torque and speed at the hand.
struct HandLimits {
  double force = 30.0;      ///< [N]
  double torque = 3.0;      ///< [Nm]
  double speed = 1.0;       ///< [m/s]
  double speed_stop = 1.5;  ///< [m/s]
  double turn = 6.0;        ///< [rad/s]
  double turn_stop = 9.0;   ///< [rad/s]
};

struct LimitedWrench {
  Wrench F_G_R;           ///< within the limits
  bool clipped = false;   ///< force or torque was above its limit
  bool slowed = false;    ///< the hand is faster than `speed` or `turn`
  bool too_fast = false;  ///< the hand is faster than `speed_stop` or `turn_stop`: a fault
};

/// Limits the wrench F_G_R on the hand, force and torque separately. Above `speed` the force along the motion fades
/// out, to zero at `speed_stop`, and a damping against the motion rises from zero to `force` there. Then the length is
/// limited to `force`. Both steps only take energy from the hand, and neither jumps. `velocity_R`: of G's origin, and
/// angular [m/s, rad/s]. Cost: 50 ns. Real-time safe.
LimitedWrench limit_at_hand(const HandLimits& limits, const Wrench& F_G_R, const Motion& velocity_R) noexcept;

}  // namespace godobject::firmware
