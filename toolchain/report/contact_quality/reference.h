#pragma once

#include <functional>
#include <vector>

#include "godobject/pose.h"
#include "toolchain/report/analytic/solid.h"

namespace godobject::report {

/// Appends the smooth parts of the still body's distance at a point of W; their minimum is the distance.
using DistancePieces = std::function<void(const Vector3& p_W, std::vector<analytic::Piece>& out)>;

/// The constrained optimum that a god object is to be at: of all poses S with every sample point at phi >= 0, one that
/// (locally) minimises |x|^2 + rho^2 |r|^2, with (x, r) = log(S^-1 D), translation in S and rotation vector.
struct OptimumProblem {
  Pose H_WD;
  std::vector<Vector3> points_B;  ///< all sample points of the moving body
  DistancePieces pieces;
  double rho_squared = 0.025;   ///< k_VC,r / k_VC,x [m^2]
  double largest_step = 0.002;  ///< trust region [m]: about what a surface is straight over
};

struct Optimum {
  Pose H_WS;
  double objective = 0.0;  ///< |x|^2 + rho^2 |r|^2 [m^2]
  double violation = 0.0;  ///< deepest sample point [m], 0 or more
  bool converged = false;
  int iterations = 0;
};

/// sqrt(|x|^2 + rho^2 |r|^2) of log(A^-1 B) [m]
double metric_distance(const Pose& H_WA, const Pose& H_WB, double rho_squared);

/// The local optimum downhill of `H_WS_start`. With S = D (x_e, r_e) the objective is |eta|^2, eta = (x_e, rho r_e), so
/// the optimum is a nearest point of the free set to the origin. Solved by a proximal sequence of least-distance
/// problems over all points' linearised constraints, with a trust region and an exact penalty that may only fall.
/// Slow (milliseconds) and independent of the solvers it judges.
Optimum polish(const OptimumProblem& problem, const Pose& H_WS_start);

/// How far a god object is from being optimal.
struct OptimumGap {
  double distance = 0.0;  ///< metric distance to the nearest polished local optimum [m]
  double excess = 0.0;    ///< sqrt(objective) less that of the best optimum found; below 0 where it penetrates [m]
  bool known = false;     ///< at least one start converged
};

/// Local optima exist and a god object follows its history, so the reference is started from the god object's
/// surroundings (four perturbations of the size of a margin and four ten times as large, so that a saddle is left),
/// from half way to the device, and from the device's orientation lifted out along the coupling. The last is left out
/// where `one_sided`: beyond a thin wall there are better poses that cannot be reached.
OptimumGap optimum_gap(const OptimumProblem& problem, const Pose& H_WS, bool one_sided);

}  // namespace godobject::report
