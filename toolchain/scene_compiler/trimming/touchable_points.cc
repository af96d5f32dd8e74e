#include "toolchain/scene_compiler/trimming/touchable_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/field/brick_lattice.h"
#include "toolchain/scene_compiler/mesh/box.h"
#include "toolchain/scene_compiler/mesh/components.h"
#include "toolchain/scene_compiler/trimming/reachable_bricks.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickCells;
using format::kBrickNodes;
namespace index_entry = format::index_entry;

Box box_of(const format::Workspace& workspace) {
  return {Vector3d(workspace.low[0], workspace.low[1], workspace.low[2]),
          Vector3d(workspace.high[0], workspace.high[1], workspace.high[2])};
}

/// The range of distances between places of a box and places that the field affects, slightly widened.
struct Distances {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;

  bool holds(double distance) const { return distance >= least && distance <= most; }
};

/// Calls visit(box) for the cells of a stored position in which the field may be below its band. It is nowhere lower
/// than the least of the cell's own nodes less Brick::deviation.
template <class Visit>
void visit_felt_cells(const DistanceGrid& field, std::uint32_t entry, const Vector3d& low, const Visit& visit) {
  const std::uint32_t number = entry & index_entry::kNumber;
  const Brick& brick = field.bricks[(entry & index_entry::kRefined) != 0 ? field.refined[number].brick : number];
  const double edge = field.grid.voxel_size;
  for (int cell = 0; cell < kBrickCells * kBrickCells * kBrickCells; ++cell) {
    const std::array<int, 3> at = {cell % kBrickCells, cell / kBrickCells % kBrickCells,
                                   cell / (kBrickCells * kBrickCells)};
    float least = std::numeric_limits<float>::infinity();
    for (int corner = 0; corner < 8; ++corner) {
      const int node =
          at[0] + (corner & 1) + kBrickNodes * (at[1] + (corner >> 1 & 1) + kBrickNodes * (at[2] + (corner >> 2)));
      least = std::min(least, brick.value[node]);
    }
    if (static_cast<double>(least - brick.deviation) >= field.grid.band) continue;
    const Vector3d from = low + edge * Vector3d(at[0], at[1], at[2]);
    visit(Box{from, from.array() + edge});
  }
}

Distances range_of(const DistanceGrid& field, const Box& box) {
  const format::Grid& grid = field.grid;
  const BrickLattice lattice{{grid.bricks[0], grid.bricks[1], grid.bricks[2]}};
  const double edge = kBrickCells * grid.voxel_size;
  const double slack = kLookUpSlack * grid.voxel_size;
  Distances range;
  const auto add = [&](const Box& felt) {
    range.least = std::min(range.least, felt.nearest(box) - slack);
    range.most = std::max(range.most, felt.farthest(box) + slack);
  };
  for (std::size_t i = 0; i < field.index.size(); ++i) {
    const bool far = (field.index[i] & index_entry::kFar) != 0;
    if (far && (field.index[i] & index_entry::kInside) == 0) continue;
    const BrickPosition p = lattice.position(i);
    const Vector3d low = Vector3d(grid.origin[0], grid.origin[1], grid.origin[2]) + edge * Vector3d(p[0], p[1], p[2]);
    if (far) {
      add({low, low.array() + edge});
    } else {
      visit_felt_cells(field, field.index[i], low, add);
    }
  }
  return range;
}

/// The cells about a body: walls, and the parts into which walls separate the other cells. Part 0 is outside.
class Cells {
 public:
  Cells(const SolidSurface& body, double deepest) {
    bounds_ = Box::around(body.mesh().vertices);
    edge_ = (bounds_.high - bounds_.low).maxCoeff() / kCavityCells;
    low_ = bounds_.low.array() - 1.5 * edge_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      lattice_.size[axis] = 3 + static_cast<int>(std::ceil((bounds_.high[k] - bounds_.low[k]) / edge_));
    }
    const double half_diagonal = 0.5 * std::sqrt(3.0) * edge_;
    const std::size_t count = lattice_.count();
    part_.resize(count);
    parallel::for_each_index(count, [&](std::size_t i) {
      part_[i] = body.signed_distance(center(lattice_.position(i))) + half_diagonal < -deepest ? kWall : kOpen;
    });
    for (std::size_t i = 0; i < count; ++i) {  // the first cell is outside, and so are all cells about the body
      if (part_[i] == kOpen) flood(i);
    }
  }

  std::size_t part_at(const Vector3d& p) const {
    BrickPosition cell;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      cell[axis] = std::clamp(static_cast<int>((p[k] - low_[k]) / edge_), 0, lattice_.size[axis] - 1);
    }
    return part_[lattice_.number(cell)];
  }
  bool is_part(std::size_t part) const { return part < extent_.size(); }
  double diagonal(std::size_t part) const { return extent_[part].diagonal(); }

 private:
  static constexpr std::uint32_t kOpen = 0xffffffff;
  static constexpr std::uint32_t kWall = 0xfffffffe;

  Vector3d center(const BrickPosition& p) const {
    return low_ + edge_ * (Vector3d(p[0], p[1], p[2]).array() + 0.5).matrix();
  }

  void flood(std::size_t from) {
    const auto part = static_cast<std::uint32_t>(extent_.size());
    Box extent;
    std::vector<std::size_t> open{from};
    part_[from] = part;
    while (!open.empty()) {
      const BrickPosition at = lattice_.position(open.back());
      open.pop_back();
      extent.add(center(at).array() - 0.5 * edge_);
      extent.add(center(at).array() + 0.5 * edge_);
      for (int step = 0; step < 27; ++step) {
        const BrickPosition next = moved(at, {step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1});
        if (!lattice_.contains(next)) continue;
        const std::size_t number = lattice_.number(next);
        if (part_[number] != kOpen) continue;
        part_[number] = part;
        open.push_back(number);
      }
    }
    extent_.push_back(extent);
  }

  Box bounds_;
  double edge_ = 0.0;
  Vector3d low_ = Vector3d::Zero();
  BrickLattice lattice_;
  std::vector<std::uint32_t> part_;
  std::vector<Box> extent_;  // of the parts
};

}  // namespace

std::vector<bool> within_reach_of_field(const DistanceGrid& field, const format::Workspace& workspace,
                                        std::span<const Vector3d> points_B) {
  const Distances range = range_of(field, box_of(workspace));
  std::vector<bool> stays;
  for (const Vector3d& p : points_B) stays.push_back(range.holds(p.norm()));
  return stays;
}

std::vector<bool> within_reach_of_body(const DistanceGrid& body_field, const format::Workspace& workspace,
                                       std::span<const Vector3d> points_W) {
  const Distances range = range_of(body_field, Box{Vector3d::Zero(), Vector3d::Zero()});
  const Box box = box_of(workspace);
  std::vector<bool> stays;
  for (const Vector3d& q : points_W) {
    const Box at{q, q};
    stays.push_back(at.nearest(box) <= range.most && at.farthest(box) >= range.least);
  }
  return stays;
}

std::vector<bool> not_sealed_off(const SolidSurface& body, std::span<const Vector3d> points, double deepest,
                                 double least_piece) {
  std::vector<bool> stays(points.size(), true);
  if (!body.sealed() || connected_components(body.mesh()).count < 2) return stays;
  const Cells cells(body, deepest);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t part = cells.part_at(points[i]);
    stays[i] = part == 0 || !cells.is_part(part) || cells.diagonal(part) >= least_piece;
  }
  return stays;
}

double least_piece(const TriangleMesh& mesh) {
  const Components pieces = connected_components(mesh);
  std::vector<Box> boxes(pieces.count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t vertex : mesh.triangles[t]) boxes[pieces.of_triangle[t]].add(mesh.vertices[vertex]);
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Box& box : boxes) least = std::min(least, (box.high - box.low).maxCoeff());
  return least;
}

}  // namespace godobject::scene_compiler
