#pragma once

#include <vector>

#include "core/pipeline/cycle/parameters.h"
#include "godobject/pose.h"
#include "toolchain/report/contact_quality/least_distance.h"

namespace godobject::report {

/// A point of the god object near the surface.
struct Touch {
  Vector3 point_S;   ///< [m]
  Vector3 normal_S;  ///< unit, the direction in which the gap grows
  double gap = 0.0;  ///< [m]
};

/// The shortest motion z_0 = (x, rho r) [m] of a god object by which it regains in one cycle what is lost of its
/// margin, wherever the device is: that meets the rows of `contact` (core/README.md: of a lost margin 0.3, a quarter of
/// a voxel at most; other gaps stay above the margin). Zero where nothing is lost, and where nobody can meet all rows:
/// then nothing need be gained.
///
/// In a narrow place it is many times the lost gap, because a wedge opens slowly along the way out. And it bounds how
/// far a cycle may end from the device, w as seen from where it began: without friction the motion is the point nearest
/// to w of a convex set that z_0 belongs to, so |z - w| <= |z_0 - w|.
Vector6 way_out(const std::vector<Touch>& touches, const Parameters& parameters);

}  // namespace godobject::report
