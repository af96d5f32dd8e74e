#include "toolchain/report/contact_quality/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include <Eigen/Geometry>

#include "toolchain/watch/least_distance.h"

namespace godobject::report {
namespace {

/// Returns J_l of d exp(r) = [J_l(r) dr]x exp(r).
Matrix3 left_jacobian(const Vector3& r) {
  const double angle = r.norm();
  Matrix3 skew;
  skew << 0.0, -r.z(), r.y(), r.z(), 0.0, -r.x(), -r.y(), r.x(), 0.0;
  if (angle < 1e-6) return Matrix3::Identity() + 0.5 * skew;
  const double a2 = angle * angle;
  return Matrix3::Identity() + (1.0 - std::cos(angle)) / a2 * skew +
         (angle - std::sin(angle)) / (a2 * angle) * skew * skew;
}

/// Constraints at a pose: its penetration, and rows a.step >= -g for all points that a step may bring to a surface.
struct Constraints {
  double violation = 0.0;
  std::vector<watch::HalfPlane> rows;
};

/// The free set in the coordinates of the device pose, eta = (x_e, rho r_e). Points that are far from all surfaces are
/// not looked up again until the body has moved far enough; distances change by less than twice the distance travelled.
class FreeSet {
 public:
  explicit FreeSet(const OptimumProblem& problem)
      : problem_(problem),
        rho_(std::sqrt(problem.rho_squared)),
        R_DW_(problem.H_WD.rotation.conjugate()),
        wake_(problem.points_B.size(), 0.0) {
    double radius = 0.0;
    for (const Vector3& p : problem.points_B) radius = std::max(radius, p.norm());
    reach_ = 1.0 + radius / rho_;
  }

  Pose pose(const watch::Vector6& eta) const {
    return problem_.H_WD * set_matrix({eta.head<3>(), Vector3(eta.tail<3>() / rho_)});
  }
  watch::Vector6 eta(const Pose& H_WS) const {
    const Motion motion = get_motion(problem_.H_WD.inverse() * H_WS);
    watch::Vector6 result;
    result << motion.translation, rho_ * motion.rotation;
    return result;
  }

  Constraints look(const watch::Vector6& at) {
    const double cutoff = 2.0 * problem_.largest_step * reach_;
    way_ += reach_ * (at - last_).norm();
    last_ = at;
    const Pose H_WS = pose(at);
    const Vector3 r = at.tail<3>() / rho_;
    const Quaternion R_DS = exp_rotation(r);
    const Matrix3 jacobian = left_jacobian(r).transpose() / rho_;
    Constraints result;
    for (std::size_t i = 0; i < wake_.size(); ++i) {
      if (way_ < wake_[i]) continue;
      const Vector3& p = problem_.points_B[i];
      pieces_.clear();
      problem_.pieces(H_WS * p, pieces_);
      double nearest = std::numeric_limits<double>::infinity();
      for (const analytic::Piece& piece : pieces_) {
        nearest = std::min(nearest, piece.distance);
        if (piece.distance > cutoff || piece.gradient.isZero()) continue;
        const Vector3 n_D = R_DW_._transformVector(piece.gradient);
        watch::HalfPlane row;
        row.normal << n_D, jacobian * R_DS._transformVector(p).cross(n_D);
        row.bound = -piece.distance;
        result.rows.push_back(row);
      }
      result.violation = std::max(result.violation, -nearest);
      wake_[i] = way_ + 0.5 * (nearest - cutoff);
    }
    look_at_edges(H_WS, R_DS, jacobian, cutoff, result);
    return result;
  }

 private:
  /// Adds the constraints of pairs of edges that are nearer than `cutoff` [m]. Edges that lie in each other's wedges
  /// have crossed.
  void look_at_edges(const Pose& H_WS, const Quaternion& R_DS, const Matrix3& jacobian, double cutoff,
                     Constraints& result) const {
    for (const watch::WatchedEdge& moving : problem_.edges_B) {
      const watch::WatchedEdge edge = moving.at(H_WS);
      const Vector3 middle = 0.5 * (edge.end[0] + edge.end[1]);
      const double half = 0.5 * (edge.end[1] - edge.end[0]).norm();
      for (const watch::WatchedEdge& other : problem_.edges_W) {
        const double apart = (middle - 0.5 * (other.end[0] + other.end[1])).norm();
        if (apart - half - 0.5 * (other.end[1] - other.end[0]).norm() > cutoff) continue;
        watch::EdgeDistance pair = watch::distance_of(edge, other);
        if (pair.gap > cutoff) continue;
        if (pair.in_both_wedges()) {
          pair.gap = -pair.gap;
          pair.normal = -pair.normal;
        } else if (pair.over_a_face) {
          continue;
        }
        const Vector3 n_D = R_DW_._transformVector(pair.normal);
        const Vector3 p_B = H_WS.inverse() * pair.on_first;
        watch::HalfPlane row;
        row.normal << n_D, jacobian * R_DS._transformVector(p_B).cross(n_D);
        row.bound = -pair.gap;
        result.rows.push_back(row);
        result.violation = std::max(result.violation, -pair.gap);
      }
    }
  }

  const OptimumProblem& problem_;
  double rho_;
  Quaternion R_DW_;
  double reach_ = 1.0;  ///< largest motion of a sample point for a step of length 1
  double way_ = 0.0;    ///< largest distance that a sample point has travelled [m]
  watch::Vector6 last_ = watch::Vector6::Zero();
  std::vector<double> wake_;  ///< distance travelled at which a point is looked up again [m]
  std::vector<analytic::Piece> pieces_;
};

/// Returns the step to the shortest eta + step that satisfies the rows, with `proximity` |step|^2 added to the
/// objective. If the rows contradict each other, their bounds are reduced, at most down to no deterioration.
watch::LeastDistance proximal_step(std::vector<watch::HalfPlane> rows, const watch::Vector6& eta, double proximity) {
  constexpr int kMaxHalvings = 4;
  const watch::Vector6 center = -eta / (1.0 + proximity);  // of the step
  for (watch::HalfPlane& row : rows) row.bound -= row.normal.dot(center);
  for (int halving = 0;; ++halving) {
    watch::LeastDistance step = watch::least_distance(rows);
    if (step.feasible || halving > kMaxHalvings) {
      step.x += center;
      step.multiplier_sum *= 1.0 + proximity;
      return step;
    }
    for (watch::HalfPlane& row : rows) {
      const double asked = row.bound + row.normal.dot(center);
      if (asked > 0.0) row.bound -= (halving == kMaxHalvings ? 1.0 : 0.5) * asked;
    }
  }
}

/// Adds the rows of the surface at the end of a refused step, `way` from here; in a valley they are those of the other
/// side. Rows that are violated here belong to another side of an edge and are not added.
void add_cuts(const std::vector<watch::HalfPlane>& there, const watch::Vector6& way,
              std::vector<watch::HalfPlane>& here) {
  for (watch::HalfPlane row : there) {
    row.bound += row.normal.dot(way);
    if (row.bound <= 0.0) here.push_back(row);
  }
}

}  // namespace

double metric_distance(const Pose& H_WA, const Pose& H_WB, double rho_squared) {
  const Motion motion = get_motion(H_WA.inverse() * H_WB);
  return std::sqrt(motion.translation.squaredNorm() + rho_squared * motion.rotation.squaredNorm());
}

Optimum polish(const OptimumProblem& problem, const Pose& H_WS_start) {
  constexpr int kMaxIterations = 300;
  constexpr double kConverged_m = 1e-7;
  constexpr double kStagnated_m =
      2e-5;  // of the coupling's length, where gradients jump: 3 mrad of its direction at 7 mm
  constexpr double kMaxProximity = 1e7;
  FreeSet free_set(problem);
  watch::Vector6 eta = free_set.eta(H_WS_start);
  Constraints here = free_set.look(eta);
  double penalty = 0.1;  // [m]: the objective is in m^2
  double proximity = 0.0;
  Optimum optimum;
  for (; optimum.iterations < kMaxIterations; ++optimum.iterations) {
    const watch::LeastDistance step = proximal_step(here.rows, eta, proximity);
    if (!step.feasible) break;
    penalty = std::max(penalty, 4.0 * step.multiplier_sum);
    const double length = step.x.norm();
    if ((1.0 + proximity) * length < kConverged_m && here.violation < kConverged_m) {
      optimum.converged = true;
      break;
    }
    const double share = length > problem.largest_step ? problem.largest_step / length : 1.0;
    const watch::Vector6 trial = eta + share * step.x;
    Constraints there = free_set.look(trial);
    const double nearer = eta.squaredNorm() - trial.squaredNorm();
    const double fallen = nearer + penalty * (here.violation - there.violation);
    const double predicted = nearer + penalty * share * here.violation;
    if (fallen >= 0.1 * predicted && fallen >= 0.0) {
      eta = trial;
      here = std::move(there);
      proximity = proximity < 1e-2 ? 0.0 : 0.3 * proximity;
    } else {
      add_cuts(there.rows, trial - eta, here.rows);
      proximity = std::max(0.1, 3.0 * proximity);
      if (proximity > kMaxProximity) {
        // no step of any length down to nanometres comes nearer: the bottom of a ripple
        optimum.converged = (1.0 + proximity) * length < kStagnated_m && here.violation < kConverged_m;
        break;
      }
    }
  }
  optimum.H_WS = free_set.pose(eta);
  optimum.objective = eta.squaredNorm();
  optimum.violation = here.violation;
  return optimum;
}

OptimumGap optimum_gap(const OptimumProblem& problem, const Pose& H_WS, bool one_sided) {
  constexpr std::array<double, 2> kPerturbations_m = {2e-5, 2e-4};  // the narrowest basins are a margin wide
  constexpr double kUsable_m = 1e-6;
  const double rho = std::sqrt(problem.rho_squared);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };

  std::vector<Pose> starts;
  for (const double perturbation : kPerturbations_m) {
    for (int i = 0; i < 4; ++i) {
      const Vector3 x = perturbation * vector();
      const Vector3 r = perturbation / rho * vector();
      starts.push_back(H_WS * set_matrix({x, r}));
    }
  }
  const Motion to_device = get_motion(H_WS.inverse() * problem.H_WD);
  if (!one_sided) {
    starts.push_back(H_WS * set_matrix({0.5 * to_device.translation, 0.5 * to_device.rotation}));
    Pose lifted = problem.H_WD;
    const Vector3 out = H_WS.translation - problem.H_WD.translation;
    if (out.norm() > kUsable_m) {
      FreeSet free_set(problem);
      for (int i = 0; i < 40 && free_set.look(free_set.eta(lifted)).violation > 0.0; ++i)
        lifted.translation += 0.1 * out;
      starts.push_back(lifted);
    }
  }

  OptimumGap gap;
  gap.distance = std::numeric_limits<double>::infinity();
  double best = std::numeric_limits<double>::infinity();
  for (const Pose& start : starts) {
    const Optimum optimum = polish(problem, start);
    if (!optimum.converged || optimum.violation > kUsable_m) continue;
    gap.known = true;
    gap.distance = std::min(gap.distance, metric_distance(H_WS, optimum.H_WS, problem.rho_squared));
    best = std::min(best, std::sqrt(optimum.objective));
  }
  gap.excess = metric_distance(H_WS, problem.H_WD, problem.rho_squared) - best;
  return gap;
}

}  // namespace godobject::report
