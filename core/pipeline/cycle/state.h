#pragma once

#include <cstdint>

#include "godobject/pose.h"
#include "godobject/report.h"

namespace godobject {

/// The input of one cycle, in W.
struct CycleInput {
  Pose H_WD;             ///< body frame B as the device holds it; its origin lies in the workspace
  Motion velocity_W;     ///< of D's origin [m/s], and angular [rad/s]; only the damping uses it
  bool outside = false;  ///< the device is outside of the workspace; `H_WD` was moved to the nearest point of the box
  /// From that point to the device [m], shortened if it is very long (kFarthestAim); zero unless `outside`.
  Vector3 beyond_W = Vector3::Zero();
  DeviceForce push;  ///< force of the workspace's faces on the device; zero unless `outside`
};

/// The state that all solvers share. Only `commit` and `Session` write it.
struct ProxyState {
  Pose H_WS;             ///< the god object
  bool started = false;  ///< at least one cycle has succeeded
  bool inside = false;   ///< the first pose penetrated, and the god object has not come out yet
};

/// Most sub-steps of one cycle of `corrected` or `contact`; the remainder of the motion waits for the next cycle.
/// Measured (godobject-replay, the demo's paths): it waits in up to 3 cycles with `contact` (in the peg's hole) and 25
/// with `corrected` (through the plate). With 4 it waits in 19 and 92. With 16 it never waits, but the largest force
/// step in the hole rises from 8.6 to 13.0 N.
inline constexpr std::uint32_t kMaxSubsteps = 8;

}  // namespace godobject
