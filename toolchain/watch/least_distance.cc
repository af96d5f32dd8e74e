#include "toolchain/watch/least_distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/QR>

namespace godobject::watch {
namespace {

using Vector7 = Eigen::Matrix<double, 7, 1>;
using Columns = Eigen::Matrix<double, 7, Eigen::Dynamic>;

Eigen::VectorXd least_squares(const Columns& columns, const std::vector<Eigen::Index>& passive, const Vector7& target) {
  Columns chosen(7, static_cast<Eigen::Index>(passive.size()));
  for (std::size_t k = 0; k < passive.size(); ++k) chosen.col(static_cast<Eigen::Index>(k)) = columns.col(passive[k]);
  return chosen.colPivHouseholderQr().solve(target);
}

/// Returns the u >= 0 that minimises |columns u - target|. `converged`: false if the bound on rounds was met.
Eigen::VectorXd non_negative_least_squares(const Columns& columns, const Vector7& target, bool& converged) {
  constexpr int kMaxRounds = 300;
  constexpr double kTolerance = 1e-13;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(columns.cols());
  std::vector<Eigen::Index> passive;
  std::vector<Eigen::Index> left_at_once;  // by rounding, since u last changed
  for (int round = 0; round < kMaxRounds; ++round) {
    Eigen::VectorXd gain = columns.transpose() * (target - columns * u);
    for (const Eigen::Index i : passive) gain[i] = 0.0;
    for (const Eigen::Index i : left_at_once) gain[i] = 0.0;
    Eigen::Index best = 0;
    if (gain.maxCoeff(&best) <= kTolerance) return u;
    passive.push_back(best);
    bool added = true;
    while (!passive.empty()) {
      const Eigen::VectorXd trial = least_squares(columns, passive, target);
      if (added && trial[trial.size() - 1] <= 0.0) {
        passive.pop_back();
        left_at_once.push_back(best);
        break;
      }
      added = false;
      left_at_once.clear();
      if (trial.minCoeff() > 0.0) {
        u.setZero();
        for (std::size_t k = 0; k < passive.size(); ++k) u[passive[k]] = trial[static_cast<Eigen::Index>(k)];
        break;
      }
      double share = 1.0;
      for (std::size_t k = 0; k < passive.size(); ++k) {
        const double wanted = trial[static_cast<Eigen::Index>(k)];
        const double had = u[passive[k]];
        if (wanted <= 0.0) share = std::min(share, had / (had - wanted));
      }
      std::vector<Eigen::Index> kept;
      for (std::size_t k = 0; k < passive.size(); ++k) {
        double& value = u[passive[k]];
        const double wanted = trial[static_cast<Eigen::Index>(k)];
        value += share * (wanted - value);
        if (wanted <= 0.0 && value <= kTolerance) {
          value = 0.0;
        } else {
          kept.push_back(passive[k]);
        }
      }
      if (kept.size() == passive.size()) return u;
      passive = std::move(kept);
    }
  }
  converged = false;
  return u;
}

}  // namespace

LeastDistance least_distance(const std::vector<HalfPlane>& rows) {
  LeastDistance result;
  double scale = 0.0;
  for (const HalfPlane& row : rows) scale = std::max(scale, row.bound / row.normal.norm());
  result.feasible = true;
  if (scale <= 0.0) return result;  // the origin itself

  Columns columns(7, static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double length = rows[i].normal.norm();
    columns.col(static_cast<Eigen::Index>(i)) << rows[i].normal / length, rows[i].bound / (length * scale);
  }
  const Vector7 target = Vector7::Unit(6);
  const Eigen::VectorXd u = non_negative_least_squares(columns, target, result.converged);
  const Vector7 residual = columns * u - target;
  constexpr double kInfeasible = 1e-10;
  if (residual.norm() < kInfeasible || residual[6] > -kInfeasible * kInfeasible) {
    result.feasible = false;
    return result;
  }
  result.x = -scale * residual.head<6>() / residual[6];
  constexpr double kViolated = 1e-6;
  for (const HalfPlane& row : rows) {
    const double missing = (row.bound - row.normal.dot(result.x)) / row.normal.norm();
    if (missing > kViolated * (scale + result.x.norm())) result.converged = false;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    result.multiplier_sum += -scale * u[static_cast<Eigen::Index>(i)] / residual[6] / rows[i].normal.norm();
  }
  return result;
}

ConeProjection projection_on_cone(const Vector6& w, const std::vector<Vector6>& rays) {
  ConeProjection result;
  const double size = w.norm();
  if (!(size > 0.0) || rays.empty()) return result;
  Columns columns(7, static_cast<Eigen::Index>(rays.size()));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i)) << rays[i].normalized(), 0.0;
  }
  Vector7 target;
  target << w / size, 0.0;
  const Eigen::VectorXd u = non_negative_least_squares(columns, target, result.converged);
  result.x = size * (columns * u).head<6>();
  return result;
}

}  // namespace godobject::watch
