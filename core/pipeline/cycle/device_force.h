#pragma once

#include "core/pipeline/cycle/parameters.h"
#include "godobject/pose.h"
#include "godobject/report.h"

namespace godobject {

/// Step #7: stiffness and damping of the device on the virtual coupling `coupling_D` (step #6, in D).
/// Damping acts on the device's velocity `velocity_W` (of D's origin [m/s], and angular [rad/s], in W) along the
/// constrained direction only, which for the closed forms is that of the coupling, for translation and rotation apart;
/// it is zero without contact, and never turns the sum into a pull towards the surface.
DeviceForce device_force(const Wrench& coupling_D, const Pose& H_WD, const Motion& velocity_W,
                         const Parameters& parameters) noexcept;

}  // namespace godobject
