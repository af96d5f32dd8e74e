#pragma once

#include <functional>
#include <vector>

#include "godobject/pose.h"
#include "toolchain/report/analytic/solid.h"
#include "toolchain/watch/edge_pairs.h"

namespace godobject::report {

/// A function that appends the smooth parts of the still body's distance at a point of W; their minimum is the
/// distance.
using DistancePieces = std::function<void(const Vector3& p_W, std::vector<analytic::Piece>& out)>;

/// The constrained optimum for a god object: among all poses S with every sample point at phi >= 0, and no sharp edge
/// of the moving body across one of the still body, a local minimum of |x|^2 + rho^2 |r|^2, with (x, r) = log(S^-1 D),
/// translation in S and rotation vector.
struct OptimumProblem {
  Pose H_WD;
  std::vector<Vector3> points_B;  ///< all sample points of the moving body
  DistancePieces pieces;
  std::vector<watch::WatchedEdge> edges_B = {};  ///< sharp edges of the moving body
  std::vector<watch::WatchedEdge> edges_W = {};  ///< sharp edges of the still body
  double rho_squared = 0.025;                    ///< k_VC,r / k_VC,x [m^2]
  double largest_step = 0.002;  ///< trust region [m]: about the length over which a surface is straight
};

struct Optimum {
  Pose H_WS;
  double objective = 0.0;  ///< |x|^2 + rho^2 |r|^2 [m^2]
  double violation = 0.0;  ///< deepest sample point [m], 0 or more
  bool converged = false;
  int iterations = 0;
};

/// Returns sqrt(|x|^2 + rho^2 |r|^2) of log(A^-1 B) [m].
double metric_distance(const Pose& H_WA, const Pose& H_WB, double rho_squared);

/// Returns the local optimum downhill of `H_WS_start`. With S = D (x_e, r_e) the objective is |eta|^2, eta = (x_e, rho
/// r_e), so the optimum is a nearest point of the free set to the origin. A proximal sequence of least-distance
/// problems over the linearised constraints of all points finds it, with a trust region and an exact penalty that may
/// only fall. Slow (milliseconds) and independent of the solvers it judges.
Optimum polish(const OptimumProblem& problem, const Pose& H_WS_start);

/// Distance of a god object from the optimum.
struct OptimumGap {
  double distance = 0.0;  ///< metric distance to the nearest polished local optimum [m]
  double excess = 0.0;    ///< sqrt(objective) minus that of the best optimum found; below 0 if it penetrates [m]
  bool known = false;     ///< at least one start converged
};

/// Returns the gap between a god object and the optimum. Local optima exist, and a god object follows its history. So
/// the search starts from the surroundings of the god object (four perturbations of the size of a margin and four ten
/// times as large, to leave a saddle), from the middle between god object and device, and from the device's orientation
/// moved out along the coupling. With `one_sided` the last two starts are omitted: beyond a thin wall there are better
/// poses that the god object cannot reach.
OptimumGap optimum_gap(const OptimumProblem& problem, const Pose& H_WS, bool one_sided);

}  // namespace godobject::report
