#include "toolchain/scene_compiler/field/distance_probe.h"

#include <algorithm>

namespace godobject::scene_compiler {

/// True if the step meets no triangle of a solid, ends included.
bool DistanceProbe::keeps_side(const Eigen::Vector3d& p, double step) const {
  constexpr double kEnds = 1e-6;  // of the step
  if (step > path_left_) return false;
  if (step * (1.0 + kEnds) < to_solids_) return true;
  TriangleTree::RayHit hit{};
  return !surface_.solid_triangles().first_hit(last_, p - last_, -kEnds, 1.0 + kEnds, hit);
}

double DistanceProbe::signed_distance(const Eigen::Vector3d& p) {
  const bool first = to_solids_ < 0.0;
  const double step = (p - last_).norm();
  const bool same_side = !first && keeps_side(p, step);
  to_solids_ = surface_.distance_to_solids(p, first ? -1.0 : to_solids_ + step);
  to_shells_ = surface_.distance_to_shells(p, first ? -1.0 : to_shells_ + step);
  if (same_side) {
    path_left_ -= step;
  } else {
    const double winding_number = surface_.winding_number(p);
    inside_ = winding_number > 0.5;
    path_left_ = surface_.constant_side_path(p, winding_number);
  }
  last_ = p;
  return std::min(inside_ ? -to_solids_ : to_solids_, to_shells_ - 0.5 * surface_.thickness()) - surface_.dilation();
}

}  // namespace godobject::scene_compiler
