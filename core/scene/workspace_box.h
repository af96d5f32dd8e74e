#pragma once

#include <limits>

#include "godobject/pose.h"

namespace godobject {

/// Where a scene's moving body may be: the origin of B, its centre of mass, does not leave this box, whose faces stand
/// along the axes of W. `limited` false: everywhere.
struct WorkspaceBox {
  bool limited = false;
  Vector3 low = Vector3::Constant(-std::numeric_limits<double>::infinity());  ///< [m]
  Vector3 high = Vector3::Constant(std::numeric_limits<double>::infinity());

  /// The point of the box that is nearest to p; p itself, to the last bit, if the box holds it. A NaN stays one.
  Vector3 nearest(const Vector3& p_W) const noexcept {
    Vector3 inside = p_W;
    for (int axis = 0; axis < 3; ++axis) {
      if (inside[axis] < low[axis]) inside[axis] = low[axis];
      if (inside[axis] > high[axis]) inside[axis] = high[axis];
    }
    return inside;
  }
  bool contains(const Vector3& p_W) const noexcept { return nearest(p_W) == p_W; }
};

}  // namespace godobject
