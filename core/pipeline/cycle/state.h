#pragma once

#include <cstdint>

#include "godobject/pose.h"
#include "godobject/report.h"

namespace godobject {

/// Input of one cycle, in W.
struct CycleInput {
  Pose H_WD;             ///< frame B of the moving body as the device holds it; its origin lies in the workspace
  Motion velocity_W;     ///< of D's origin [m/s], and angular [rad/s]; used by the damping only
  bool outside = false;  ///< the device is outside of the workspace; `H_WD` is moved to the nearest point of the box
  DeviceForce push;      ///< of the workspace's faces on the device; zero unless `outside`
};

/// The part of the state that all solvers share. Only `commit` and `GodObject` write it.
struct ProxyState {
  Pose H_WS;             ///< the god object
  bool started = false;  ///< at least one cycle has ended well
  bool inside = false;   ///< the first pose penetrated, and the god object has not come out yet
};

/// Most sub-steps of one cycle of `corrected` or `contact`.
/// Chosen: 4 leave `corrected` behind a hand of 12 m/s, and in a contact that opens the remainder of the motion then waits
/// for the next cycle; 16 change no replay of the demo.
inline constexpr std::uint32_t kMaxSubsteps = 8;

}  // namespace godobject
