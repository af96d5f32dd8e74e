#include "toolchain/scene_compiler/distance_probe.h"

#include <algorithm>

namespace godobject::scene_compiler {

double DistanceProbe::signed_distance(const Eigen::Vector3d& p) {
  const bool first = to_solids_ < 0.0;
  const double step = (p - last_).norm();
  const bool same_side = !first && surface_.sealed() && step * (1.0 + 1e-9) < to_solids_;
  to_solids_ = surface_.distance_to_solids(p, first ? -1.0 : to_solids_ + step);
  to_shells_ = surface_.distance_to_shells(p, first ? -1.0 : to_shells_ + step);
  if (!same_side) inside_ = surface_.is_inside(p);
  last_ = p;
  return std::min(inside_ ? -to_solids_ : to_solids_, to_shells_ - 0.5 * surface_.thickness());
}

}  // namespace godobject::scene_compiler
