#pragma once

#include <vector>

#include <Eigen/Core>

namespace godobject::watch {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// One row of a least-distance problem: normal.x >= bound.
struct HalfPlane {
  Vector6 normal;
  double bound = 0.0;
};

struct LeastDistance {
  bool feasible = false;
  bool converged = true;  ///< false: x violates a row, or the bound on rounds was met
  Vector6 x = Vector6::Zero();
  double multiplier_sum = 0.0;  ///< sum over the given rows; the gradient of |x|^2 / 2 is their combination
};

/// Returns the shortest x with normal.x >= bound for all rows, by Lawson and Hanson's algorithms LDP and NNLS ("Solving
/// Least Squares Problems", 1974). Exact to rounding. Cost: some tens of factorisations of at most 7 columns.
LeastDistance least_distance(const std::vector<HalfPlane>& rows);

/// The point of a cone that is nearest to a vector.
struct ConeProjection {
  bool converged = true;        ///< false: the bound on rounds was met, and another point may be nearer
  Vector6 x = Vector6::Zero();  ///< in the cone, also if not converged
};

/// Returns the projection of `w` on the cone of non-negative sums of the rays, none of which is zero, by Lawson and
/// Hanson's NNLS. Cost: as least_distance.
ConeProjection projection_on_cone(const Vector6& w, const std::vector<Vector6>& rays);

}  // namespace godobject::watch
