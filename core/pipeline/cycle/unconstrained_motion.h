#pragma once

#include "godobject/pose.h"

namespace godobject {

/// Step #3: the unconstrained motion from a pose of the god object to the device, (x_u, r_u) of eq (32) and (33), in S.
inline Motion unconstrained_motion(const Pose& H_WS, const Pose& H_WD) noexcept {
  return get_motion(H_WS.inverse() * H_WD);
}

}  // namespace godobject
