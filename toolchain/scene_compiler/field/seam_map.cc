#include "toolchain/scene_compiler/field/seam_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "toolchain/scene_compiler/field/cell_edges.h"
#include "toolchain/scene_compiler/field/distance_transform.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickCells;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

Vector3d to_vector(const BrickPosition& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

}  // namespace

SeamMap::SeamMap(const BrickLattice& bricks, const Vector3d& origin, double voxel_size)
    : bricks_(bricks),
      origin_(origin),
      voxel_size_(voxel_size),
      low_(Vector3d::Constant(kUnbounded)),
      high_(Vector3d::Constant(-kUnbounded)) {}

void SeamMap::add(const BrickPosition& position, const Brick& brick) {
  for_each_cell(brick, kAllOctants, [&](const CellEdges& edges, int x, int y, int z) {
    if (!edges.on_seam(voxel_size_)) return;
    const BrickPosition cell = {kBrickCells * position[0] + x, kBrickCells * position[1] + y,
                                kBrickCells * position[2] + z};
    const auto [found, added] = boxes_.try_emplace(bricks_.number(position), CellBox{cell, cell});
    CellBox& box = found->second;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], cell[axis]);
      box.high[axis] = std::max(box.high[axis], cell[axis]);
    }
    const Vector3d corner = origin_ + voxel_size_ * to_vector(cell);
    low_ = low_.cwiseMin(corner);
    high_ = high_.cwiseMax(corner + Vector3d::Constant(voxel_size_));
    ++report_.cells;
    if (edges.largest_jump() > report_.largest_jump) {
      report_.largest_jump = edges.largest_jump();
      report_.at = corner + Vector3d::Constant(0.5 * voxel_size_);
    }
  });
}

/// Bricks that touch are 0 apart: their gap along an axis is max(|i - j| - 1, 0) bricks. The least squared sum of gaps
/// over all seam bricks j is the squared distance to the nearest brick within one step of a seam brick.
void SeamMap::close() {
  if (boxes_.empty()) return;
  std::vector<bool> touching(bricks_.count());
  for (const auto& [number, box] : boxes_) {
    const BrickPosition p = bricks_.position(number);
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const BrickPosition q = moved(p, {x, y, z});
          if (bricks_.contains(q)) touching[bricks_.number(q)] = true;
        }
      }
    }
  }
  squared_steps_ = squared_distance_transform(bricks_, touching);
}

double SeamMap::clearance_of_bricks(const BrickPosition& position) const {
  if (boxes_.empty()) return kUnbounded;
  return kBrickCells * voxel_size_ * std::sqrt(static_cast<double>(squared_steps_[bricks_.number(position)])) *
         (1.0 - 1e-6);
}

bool SeamMap::touches(const BrickPosition& position) const {
  if (clearance_of_bricks(position) > 0.0) return false;
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const BrickPosition q = moved(position, {x, y, z});
        if (!bricks_.contains(q)) continue;
        const auto found = boxes_.find(bricks_.number(q));
        if (found == boxes_.end()) continue;
        bool apart = false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          apart = apart || found->second.low[axis] > kBrickCells * (position[axis] + 1) ||
                  found->second.high[axis] + 1 < kBrickCells * position[axis];
        }
        if (!apart) return true;
      }
    }
  }
  return false;
}

}  // namespace godobject::scene_compiler
