#pragma once

#include "godobject/pose.h"

namespace godobject {

/// Returns the stretch of the virtual coupling from device to god object, in D [m, rad]. Step #6, eq (44) and (45).
inline Motion coupling_stretch(const Pose& H_WD, const Pose& H_WS) noexcept {
  return get_motion(H_WD.inverse() * H_WS);
}

/// Returns f_VC = k_VC,x x_VC [m] and t_VC = k_VC,r r_VC [m^2 rad], in D about its origin, the centre of mass. Step #6,
/// eq (46).
inline Wrench constraint_force(const Motion& stretch_D, double k_translation, double k_rotation) noexcept {
  return {k_translation * stretch_D.translation, k_rotation * stretch_D.rotation};
}

}  // namespace godobject
