#pragma once

#include "core/pipeline/cycle/parameters.h"
#include "godobject/pose.h"
#include "godobject/report.h"

namespace godobject {

/// Returns the device force of step #7: stiffness and damping on the virtual coupling `coupling_D` (step #6, in D).
///
/// `velocity_W`: the device's velocity, of D's origin [m/s] and angular [rad/s]. The damping acts along the constrained
/// direction only. For the closed forms that is the direction of the coupling, for translation and rotation apart. The
/// damping is zero without contact and never turns the sum into a pull towards the surface. Real-time safe.
DeviceForce device_force(const Wrench& coupling_D, const Pose& H_WD, const Motion& velocity_W,
                         const Parameters& parameters) noexcept;

}  // namespace godobject
