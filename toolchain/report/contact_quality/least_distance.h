#pragma once

#include <vector>

#include <Eigen/Core>

namespace godobject::report {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// One row of a least-distance problem: normal.x >= bound.
struct HalfPlane {
  Vector6 normal;
  double bound = 0.0;
};

struct LeastDistance {
  bool feasible = false;
  Vector6 x = Vector6::Zero();
  double multiplier_sum = 0.0;  ///< of the rows as given; the gradient of |x|^2 / 2 is their combination
};

/// The shortest x with normal.x >= bound for all rows: Lawson and Hanson's LDP, by non-negative least squares
/// ("Solving Least Squares Problems", 1974, algorithms LDP and NNLS). Exact to rounding; cost: some tens of
/// factorisations of at most 7 columns.
LeastDistance least_distance(const std::vector<HalfPlane>& rows);

}  // namespace godobject::report
