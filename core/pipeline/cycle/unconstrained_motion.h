#pragma once

#include "godobject/pose.h"

namespace godobject {

/// Returns the unconstrained motion (x_u, r_u) from the god object to the device, in S [m, rad]. Step #3, eq (32),
/// (33).
inline Motion unconstrained_motion(const Pose& H_WS, const Pose& H_WD) noexcept {
  return get_motion(H_WS.inverse() * H_WD);
}

}  // namespace godobject
