#pragma once

#include <map>
#include <vector>

#include "core/scene/format.h"
#include "toolchain/scene_compiler/field/brick_lattice.h"
#include "toolchain/scene_compiler/field/distance_grid.h"

namespace godobject::scene_compiler {

/// The seams of a field, and the distance of every brick to them. First add all stored bricks, then close.
class SeamMap {
 public:
  SeamMap(const BrickLattice& bricks, const Eigen::Vector3d& origin, double voxel_size);

  void add(const BrickPosition& position, const Brick& brick);
  void close();

  const SeamReport& report() const { return report_; }

  /// Return the bounding box of all seam cells; empty (+infinity, -infinity) if there is none.
  const Eigen::Vector3d& low() const { return low_; }
  const Eigen::Vector3d& high() const { return high_; }

  /// Returns a lower bound of the distance between any point of the brick position and any seam cell [m], measured from
  /// brick to brick; infinity if there is no seam.
  double clearance_of_bricks(const BrickPosition& position) const;

  /// True if the box of a brick's seam cells touches the brick position.
  bool touches(const BrickPosition& position) const;

 private:
  struct CellBox {
    BrickPosition low, high;  // cells of the whole lattice, inclusive
  };

  BrickLattice bricks_;
  Eigen::Vector3d origin_;
  double voxel_size_;
  std::map<std::size_t, CellBox> boxes_;  // seam cells of a brick, by its number
  std::vector<float> squared_steps_;      // of each brick to the nearest seam brick, in bricks between them
  SeamReport report_;
  Eigen::Vector3d low_, high_;
};

}  // namespace godobject::scene_compiler
