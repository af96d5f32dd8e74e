#pragma once

#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// Signed distance along a walk, equal to SolidSurface::signed_distance but faster. The last answer bounds the next
/// search. The winding number is summed again only after a step that crosses a triangle, or far from the last sum. Use
/// one probe for each thread.
class DistanceProbe {
 public:
  explicit DistanceProbe(const SolidSurface& surface) : surface_(surface) {}

  double signed_distance(const Eigen::Vector3d& p);

 private:
  bool keeps_side(const Eigen::Vector3d& p, double step) const;

  const SolidSurface& surface_;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero();
  double to_solids_ = -1.0;  ///< at the last point; negative: no answer yet
  double to_shells_ = -1.0;
  bool inside_ = false;
  double path_left_ = 0.0;  ///< until the winding number must be summed again [m]
};

}  // namespace godobject::scene_compiler
