#pragma once

#include "toolchain/scene_compiler/solid_surface.h"

namespace godobject::scene_compiler {

/// Signed distance along a walk: the last answer bounds the next search, and where the solids are sealed a step shorter
/// than the last distance keeps its sign. Gives what SolidSurface::signed_distance gives. One walk a thread.
class DistanceProbe {
 public:
  explicit DistanceProbe(const SolidSurface& surface) : surface_(surface) {}

  double signed_distance(const Eigen::Vector3d& p);

 private:
  const SolidSurface& surface_;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero();
  double to_solids_ = -1.0;  ///< negative: no answer yet
  double to_shells_ = -1.0;
  bool inside_ = false;
};

}  // namespace godobject::scene_compiler
