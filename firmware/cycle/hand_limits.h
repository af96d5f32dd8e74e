#pragma once

#include "godobject/pose.h"

namespace godobject::firmware {

/// What the hand may be given, in the room.
struct HandLimits {
  double force = 30.0;      ///< [N]
  double torque = 3.0;      ///< [Nm]
  double speed = 1.0;       ///< [m/s]
  double speed_stop = 1.5;  ///< [m/s]
  double turn = 6.0;        ///< [rad/s]
  double turn_stop = 9.0;   ///< [rad/s]
};

struct LimitedWrench {
  Wrench wrench_R;        ///< within the limits
  bool clipped = false;   ///< force or torque was larger
  bool slowed = false;    ///< hand faster than `speed` or `turn`
  bool too_fast = false;  ///< beyond `speed_stop` or `turn_stop`: a fault
};

/// Force and torque apart. Beyond `speed` what pushes along the motion fades out, to nothing at `speed_stop`, and a
/// damping against it grows from zero to `force` there; then the length is cut to `force`. Both take energy from the
/// hand only, and neither jumps. `velocity_R`: of the point that the wrench is about [m/s, rad/s].
/// Cost: 50 ns. Real-time safe.
LimitedWrench limit_at_hand(const HandLimits& limits, const Wrench& wrench_R, const Motion& velocity_R) noexcept;

}  // namespace godobject::firmware
