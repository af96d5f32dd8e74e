#include "toolchain/watch/way_out.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace godobject::watch {

Vector6 way_out(const std::vector<Touch>& touches, const Parameters& parameters) {
  constexpr double kRegained = 0.3;
  const double most = 0.25 * parameters.voxel_size;
  const double rho = std::sqrt(parameters.coupling_rotation / parameters.coupling_translation);
  std::vector<HalfPlane> rows;
  bool lost = false;
  for (const Touch& touch : touches) {
    const double missing = -touch.left;
    lost = lost || missing > 0.0;
    HalfPlane row;
    row.normal << touch.normal_S, touch.point_S.cross(touch.normal_S) / rho;
    row.bound = missing > 0.0 ? std::min(kRegained * missing, most) : missing;
    rows.push_back(row);
  }
  if (!lost) return Vector6::Zero();
  const LeastDistance shortest = least_distance(rows);
  return shortest.feasible ? shortest.x : Vector6(Vector6::Zero());
}

}  // namespace godobject::watch
