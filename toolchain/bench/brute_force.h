#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/scene_view.h"
#include "godobject/pose.h"
#include "toolchain/bench/point_scan.h"

namespace godobject::bench {

/// Alternative to step #1 without a tree, bricks or memory of the last cycle: it looks up every sample point in a tight
/// dense grid of single-precision distances with the scene's voxel edge. Points are stored in Morton order, so that
/// neighbours in space are neighbours in memory. It lacks refined bricks, exact edges, seams and the second direction.
class BruteForce {
 public:
  /// Copies the points and the distances at the lattice's nodes from the scene. Scans find points nearer than `cut`
  /// [m]. Cost: one look-up per node of the tight grid.
  BruteForce(const SceneView& scene, double cut);

  /// Scans the points with the body at H_WS. The result is valid until the next call.
  const NearList& scan(PointScan how, const Pose& H_WS) noexcept;

  std::size_t grid_bytes() const noexcept { return values_.size() * sizeof(float); }
  std::span<const std::int32_t, 3> nodes() const noexcept { return grid_.nodes; }

 private:
  Vector3 origin_W_;
  double voxel_size_;
  ScanLimits limits_;
  std::vector<float> values_;
  GridView grid_;
  std::vector<float> x_, y_, z_;
  std::vector<std::uint32_t> order_;
  PointView points_;
  std::vector<std::uint32_t> scratch_;
  std::vector<std::uint32_t> near_index_;
  std::vector<float> near_distance_, near_gradient_x_, near_gradient_y_, near_gradient_z_;
  NearList near_;
};

/// Returns the scans that this processor can run, the scalar ones first.
std::vector<NamedScan> runnable_scans();

}  // namespace godobject::bench
