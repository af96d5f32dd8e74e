#include "toolchain/watch/way_out.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace godobject::watch {

HalfPlane row_of(const Touch& touch, double gyration, double voxel_size) {
  constexpr double kRegained = 0.3;
  const double missing = -touch.left;
  HalfPlane row;
  row.normal << touch.normal_S, touch.point_S.cross(touch.normal_S) / gyration;
  row.bound = missing > 0.0 ? std::min(kRegained * missing, 0.25 * voxel_size) : missing;
  return row;
}

Vector6 way_out(const std::vector<Touch>& touches, const Parameters& parameters) {
  const double rho = std::sqrt(parameters.coupling_rotation / parameters.coupling_translation);
  std::vector<HalfPlane> rows;
  bool lost = false;
  for (const Touch& touch : touches) {
    lost = lost || touch.left < 0.0;
    rows.push_back(row_of(touch, rho, parameters.voxel_size));
  }
  if (!lost) return Vector6::Zero();
  const LeastDistance shortest = least_distance(rows);
  return shortest.feasible ? shortest.x : Vector6(Vector6::Zero());
}

}  // namespace godobject::watch
