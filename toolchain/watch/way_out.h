#pragma once

#include <vector>

#include "core/pipeline/cycle/parameters.h"
#include "godobject/pose.h"
#include "toolchain/watch/least_distance.h"

namespace godobject::watch {

/// A point of the god object near the surface.
struct Touch {
  Vector3 point_S;    ///< [m]
  Vector3 normal_S;   ///< unit, the direction in which the gap grows
  double left = 0.0;  ///< way in that leaves the field at the margin; below 0: lost [m]
};

/// Returns the row of `contact` for a touch (core/README.md): one cycle regains 0.3 of a lost margin, a quarter of a
/// voxel at most; other points keep the margin. `gyration`: length that counts a rotation [m/rad].
HalfPlane row_of(const Touch& touch, double gyration, double voxel_size);

/// Returns the shortest motion z_0 = (x, rho r) [m] by which a god object regains the lost margin in one cycle,
/// independent of the device. It satisfies the rows of `contact` (core/README.md: 0.3 of a lost margin, a quarter of a
/// voxel at most; other gaps stay above the margin). Zero if no margin is lost, and if no motion satisfies all rows;
/// then no gap need grow.
///
/// In a narrow place it is many times the lost gap, because a wedge opens slowly along the way out. It bounds the
/// distance from the device at the end of a cycle. Let w be the device seen from the begin of the cycle: without
/// friction the motion z is the point nearest to w of a convex set that contains z_0, so |z - w| <= |z_0 - w|.
Vector6 way_out(const std::vector<Touch>& touches, const Parameters& parameters);

}  // namespace godobject::watch
