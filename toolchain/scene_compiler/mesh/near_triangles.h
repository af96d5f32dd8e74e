#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "toolchain/scene_compiler/mesh/triangle_tree.h"

namespace godobject::scene_compiler {

/// The triangles that may be the nearest ones of some point in a ball. Distances of many points of a small ball need
/// few triangles and no search.
///
/// The nearest triangle of a point p in the ball is at most d + |p - center| from p, d the distance of the centre. So
/// it is at most d + 2 radius from the centre.
class NearTriangles {
 public:
  /// Of a tree, in the ball about `center` [m]. None if the tree is empty. Refers to the tree.
  NearTriangles(const TriangleTree& tree, const Eigen::Vector3d& center, double radius);

  /// Of a ball within the other one's.
  NearTriangles(const NearTriangles& larger, const Eigen::Vector3d& center, double radius);

  std::size_t size() const { return near_.size(); }

  /// Returns the triangles' ids, the nearest to the centre first.
  std::vector<std::uint32_t> ids() const;

  /// Returns the distance of a point in the ball to the nearest triangle of the tree, as TriangleTree::nearest finds
  /// it; infinity for an empty tree [m].
  double distance(const Eigen::Vector3d& p) const;

 private:
  struct Near {
    double distance;  ///< from the centre [m]
    const TriangleTree::Triangle* triangle;
  };

  /// Sorts by distance and drops what is too far.
  void finish(double radius);

  Eigen::Vector3d center_;
  std::vector<Near> near_;
};

}  // namespace godobject::scene_compiler
