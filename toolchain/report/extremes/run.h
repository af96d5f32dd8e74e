#pragma once

#include <vector>

#include "toolchain/report/extremes/rig.h"
#include "toolchain/report/extremes/setup.h"
#include "toolchain/watch/findings.h"

namespace godobject::report {

/// Returns the device poses of a motion that does not depend on the god object, frame B in W, one per cycle.
std::vector<Pose> device_path(const Setup& setup);

/// Returns the velocity of frame B between two cycles, in W [m/s, rad/s].
Motion velocity_between(const Pose& before, const Pose& now, double period);

/// Runs the setup on the rig, with the watch on every cycle.
watch::Findings run_setup(const Setup& setup, Rig& rig);

}  // namespace godobject::report
