#include "toolchain/scene_compiler/field/distance_probe.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Geometry>

namespace godobject::scene_compiler {

void DistanceProbe::start(const Eigen::Vector3d& p, float distance, std::int16_t winding) {
  constexpr double kRounding = 1.0 + 1.2e-7;  // of the distance to single precision
  last_ = p;
  to_solids_ = std::abs(static_cast<double>(distance)) * kRounding;
  to_shells_ = std::numeric_limits<double>::infinity();
  inside_ = winding > 0;
  winding_number_ = winding;
  path_left_ = std::numeric_limits<double>::infinity();
}

std::optional<std::int16_t> DistanceProbe::winding() const {
  const bool counted = to_solids_ >= 0.0 && surface_.is_only_sealed_solids();
  using Limits = std::numeric_limits<std::int16_t>;
  const long rounded = std::lround(winding_number_);
  if (!counted || rounded <= Limits::min() || rounded > Limits::max()) return {};
  return static_cast<std::int16_t>(rounded);
}

/// True if the step meets no triangle of a solid, ends included.
bool DistanceProbe::keeps_side(const Eigen::Vector3d& p, double step) const {
  constexpr double kEnds = 1e-6;  // of the step
  if (step > path_left_) return false;
  if (step * (1.0 + kEnds) < to_solids_) return true;
  TriangleTree::RayHit hit{};
  return !surface_.solid_triangles().first_hit(last_, p - last_, -kEnds, 1.0 + kEnds, hit);
}

/// Returns the change of the winding number of sealed solids by a step that meets an edge or a vertex; nothing if the
/// detour meets one, too. Then the place itself may lie on a triangle.
std::optional<int> DistanceProbe::change_by_detour(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d step = p - last_;
  const Eigen::Vector3d aside = step.unitOrthogonal();
  const Eigen::Vector3d via =
      last_ + 0.43 * step + step.norm() * (0.29 * aside + 0.17 * step.normalized().cross(aside));
  const std::optional<int> there = surface_.solid_triangles().winding_change(last_, via);
  if (!there) return {};
  const std::optional<int> back = surface_.solid_triangles().winding_change(via, p);
  if (!back) return {};
  return *there + *back;
}

/// Counts the triangles that a step crosses. False if the winding number must be summed instead. Between triangles it
/// changes no faster with an open boundary than constant_side_path() says, and by 1 at each.
bool DistanceProbe::counts_crossings(const Eigen::Vector3d& p, double step) {
  std::optional<int> change = surface_.solid_triangles().winding_change(last_, p);
  if (!change && surface_.sealed() && step > 0.0) change = change_by_detour(p);
  if (!change) return false;
  const double winding_number = winding_number_ + *change;
  const double path_left = surface_.constant_side_path(summed_at_, winding_number) - travelled_ - step;
  if (!(path_left > 0.0)) return false;
  winding_number_ = winding_number;
  path_left_ = path_left;
  inside_ = winding_number > 0.5;
  return true;
}

void DistanceProbe::sum_winding(const Eigen::Vector3d& p) {
  winding_number_ = surface_.winding_number(p);
  summed_at_ = p;
  travelled_ = 0.0;
  inside_ = winding_number_ > 0.5;
  path_left_ = surface_.constant_side_path(p, winding_number_);
}

double DistanceProbe::signed_distance(const Eigen::Vector3d& p, double at_most) {
  const bool first = to_solids_ < 0.0;
  const double step = (p - last_).norm();
  const bool same_side = !first && keeps_side(p, step);
  const double to_solids = std::min(first ? std::numeric_limits<double>::infinity() : to_solids_ + step, at_most);
  to_solids_ = surface_.distance_to_solids(p, std::isfinite(to_solids) ? to_solids : -1.0);
  to_shells_ = surface_.distance_to_shells(p, first ? -1.0 : to_shells_ + step);
  if (same_side) {
    path_left_ -= step;
    travelled_ += step;
  } else if (first || !counts_crossings(p, step)) {
    sum_winding(p);
  } else {
    travelled_ += step;
  }
  last_ = p;
  return std::min(inside_ ? -to_solids_ : to_solids_, to_shells_ - 0.5 * surface_.thickness()) - surface_.dilation();
}

}  // namespace godobject::scene_compiler
