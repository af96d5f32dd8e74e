#pragma once

#include <Eigen/Core>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// The slow and plain oracle of a mesh: it tests every triangle. It shares no code with the compiler.
class BruteForce {
 public:
  explicit BruteForce(const TriangleMesh& mesh) : mesh_(mesh) {}

  double distance(const Eigen::Vector3d& p) const;
  double winding_number(const Eigen::Vector3d& p) const;

  double signed_distance(const Eigen::Vector3d& p) const {
    return winding_number(p) > 0.5 ? -distance(p) : distance(p);
  }

 private:
  const TriangleMesh& mesh_;
};

}  // namespace godobject::scene_compiler
