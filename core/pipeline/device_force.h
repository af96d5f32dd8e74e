#pragma once

#include "core/pipeline/parameters.h"
#include "core/spatial/pose.h"

namespace godobject {

/// What step #7 would have the device display, in W about the moving body's centre of mass. [N, Nm]
struct DeviceForce {
  Wrench spring_W;  ///< k_D f_VC, k_D t_VC
  Wrench total_W;   ///< with the damping b_D
};

/// Step #7: stiffness and damping of the device on the virtual coupling `coupling_D` (step #6, in D).
/// Damping acts on the device's velocity `velocity_W` (of D's origin [m/s], and angular [rad/s], in W) along the
/// constrained direction only, which for the closed forms is that of the coupling, for translation and rotation apart;
/// it is zero without contact, and never turns the sum into a pull towards the surface.
DeviceForce device_force(const Wrench& coupling_D, const Pose& H_WD, const Motion& velocity_W,
                         const Parameters& parameters) noexcept;

}  // namespace godobject
