#include "toolchain/scene_compiler/field/octant_nodes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>

#include "toolchain/scene_compiler/field/cell_edges.h"
#include "toolchain/scene_compiler/mesh/near_triangles.h"
#include "toolchain/scene_compiler/mesh/triangle_tree.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickCells;
using format::kBrickNodes;
using format::kBrickValues;

constexpr int kFineNodes = 2 * kBrickCells + 1;

/// Exact signed distances at the nodes of a brick's octants. A node has the side of a neighbour if the neighbour is
/// farther from every triangle of a solid than from the node, and if its side can be trusted that far without a winding
/// number. So few winding numbers are needed.
class FineNodes {
 public:
  FineNodes(const SolidSurface& surface, const Brick& parent, const Vector3d& low, double edge)
      : surface_(surface), low_(low), edge_(edge) {
    winding_.fill(kUnknown);
    const bool values_tell = surface.shell_triangles().empty() && surface.dilation() == 0.0;
    for (int i = 0; i < kCount; ++i) take(i, parent, values_tell);
    measure({{0, 0, 0}, {kFineNodes, kFineNodes, kFineNodes}}, nullptr, nullptr);
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [this](int a, int b) {
      return to_solids_[at(a)] != to_solids_[at(b)] ? to_solids_[at(a)] > to_solids_[at(b)] : a < b;
    });
    for (const int i : order_) {
      if (trusted_[at(i)] < 0.0) decide(i);
    }
  }

  float value(int x, int y, int z) const {
    const std::size_t i = at(number(x, y, z));
    if (given_[i]) return value_[i];
    return static_cast<float>(
        std::min(inside_[i] ? -to_solids_[i] : to_solids_[i], to_shells_[i] - 0.5 * surface_.thickness()) -
        surface_.dilation());
  }

 private:
  static constexpr int kCount = kFineNodes * kFineNodes * kFineNodes;

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static int number(int x, int y, int z) { return x + kFineNodes * (y + kFineNodes * z); }
  static std::array<int, 3> place(int i) {
    return {i % kFineNodes, i / kFineNodes % kFineNodes, i / (kFineNodes * kFineNodes)};
  }
  Vector3d point(int i) const {
    const auto [x, y, z] = place(i);
    return low_ + edge_ * Vector3d(x, y, z);
  }

  /// Takes the value that the parent gives. `values_tell`: it is the distance to the solids.
  void take(int i, const Brick& parent, bool values_tell) {
    const auto [x, y, z] = place(i);
    trusted_[at(i)] = -1.0;
    to_solids_[at(i)] = -1.0;
    given_[at(i)] = x % 2 == 0 && y % 2 == 0 && z % 2 == 0;
    if (given_[at(i)]) value_[at(i)] = parent.value[x / 2 + kBrickNodes * (y / 2 + kBrickNodes * (z / 2))];
    if (!given_[at(i)] || !values_tell) return;
    to_solids_[at(i)] = std::abs(static_cast<double>(value_[at(i)]));
    inside_[at(i)] = value_[at(i)] < 0.0f;
    if (surface_.sealed()) trusted_[at(i)] = std::numeric_limits<double>::infinity();
  }

  /// Nodes from `begin` to before `end`.
  struct Block {
    std::array<int, 3> begin, end;
  };

  /// Measures the distances at the other nodes of a block. `solids` and `shells`: triangles near a larger one, if any.
  void measure(const Block& block, const NearTriangles* solids, const NearTriangles* shells) {
    Vector3d low;
    Vector3d high;
    bool small = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      low[k] = low_[k] + edge_ * block.begin[axis];
      high[k] = low_[k] + edge_ * (block.end[axis] - 1);
      small = small && block.end[axis] - block.begin[axis] <= kFewNodes;
    }
    const Vector3d center = 0.5 * (low + high);
    const double radius = 0.5 * (high - low).norm() * kRoundedUp;
    const NearTriangles near_solids = near(surface_.solid_triangles(), solids, center, radius);
    const NearTriangles near_shells = near(surface_.shell_triangles(), shells, center, radius);
    if (small) {
      measure_each(block, near_solids, near_shells);
      return;
    }
    for (std::size_t part = 0; part < 8; ++part) {
      Block half = block;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int middle = (block.begin[axis] + block.end[axis]) / 2;
        ((part >> axis & 1) == 0 ? half.end : half.begin)[axis] = middle;
      }
      measure(half, &near_solids, &near_shells);
    }
  }

  static NearTriangles near(const TriangleTree& tree, const NearTriangles* larger, const Vector3d& center,
                            double radius) {
    const bool few = larger != nullptr && larger->size() <= kFewTriangles;
    return few ? NearTriangles(*larger, center, radius) : NearTriangles(tree, center, radius);
  }

  void measure_each(const Block& block, const NearTriangles& solids, const NearTriangles& shells) {
    for (int z = block.begin[2]; z < block.end[2]; ++z) {
      for (int y = block.begin[1]; y < block.end[1]; ++y) {
        for (int x = block.begin[0]; x < block.end[0]; ++x) {
          const int i = number(x, y, z);
          if (to_solids_[at(i)] >= 0.0) continue;
          to_solids_[at(i)] = solids.distance(point(i));
          to_shells_[at(i)] = shells.distance(point(i));
        }
      }
    }
  }

  /// Calls visit(neighbour, distance) for a node and the nodes about it, until it returns true.
  template <class Visit>
  void visit_about(int i, const Visit& visit) const {
    const auto [x, y, z] = place(i);
    for (int step = 0; step < 27; ++step) {
      const int dx = step % 3 - 1;
      const int dy = step / 3 % 3 - 1;
      const int dz = step / 9 - 1;
      const auto within = [](int n) { return n >= 0 && n < kFineNodes; };
      if (!within(x + dx) || !within(y + dy) || !within(z + dz)) continue;
      if (visit(number(x + dx, y + dy, z + dz), edge_ * kStepLength[at(dx * dx + dy * dy + dz * dz)])) return;
    }
  }

  /// Decides the side of a node. Call it for the nodes farthest from the solids first.
  void decide(int i) {
    visit_about(i, [&](int neighbour, double step_length) {
      const std::size_t near = at(neighbour);
      const double trusted = trusted_[near] - step_length;
      if (trusted <= trusted_[at(i)] || trusted < 0.0 || to_solids_[near] <= step_length) return false;
      trusted_[at(i)] = trusted;
      inside_[at(i)] = inside_[near];
      winding_[at(i)] = winding_[near];
      return false;
    });
    if (trusted_[at(i)] >= 0.0 || counts_crossings(i)) return;
    const Vector3d p = point(i);
    const double winding_number = surface_.winding_number(p);
    inside_[at(i)] = winding_number > 0.5;
    trusted_[at(i)] = surface_.constant_side_path(p, winding_number);
    if (surface_.sealed() && std::abs(winding_number) < kUnknown) {
      winding_[at(i)] = static_cast<int>(std::lround(winding_number));
    }
  }

  /// Counts the triangles between a node and a neighbour whose winding number is known. False if there is none, or if
  /// rounding might decide.
  bool counts_crossings(int i) {
    if (!surface_.sealed()) return false;
    bool counted = false;
    visit_about(i, [&](int neighbour, double) {
      if (winding_[at(neighbour)] == kUnknown) return false;
      const auto change = surface_.solid_triangles().winding_change(point(neighbour), point(i));
      if (!change) return false;
      winding_[at(i)] = winding_[at(neighbour)] + *change;
      inside_[at(i)] = winding_[at(i)] > 0;
      trusted_[at(i)] = std::numeric_limits<double>::infinity();
      counted = true;
      return true;
    });
    return counted;
  }

  static constexpr double kRoundedUp = 1.0 + 1e-6;  // given values are floats
  static constexpr int kFewNodes = 3;               // along a block that is not divided
  static constexpr std::size_t kFewTriangles = 256;
  static constexpr int kUnknown = 1 << 20;
  /// By squared steps.
  static constexpr std::array<double, 4> kStepLength = {0.0, kRoundedUp, std::numbers::sqrt2* kRoundedUp,
                                                        std::numbers::sqrt3* kRoundedUp};

  const SolidSurface& surface_;
  Vector3d low_;
  double edge_;
  std::array<double, kCount> to_solids_{};
  std::array<double, kCount> to_shells_{};
  /// Length of paths from the node on which its side is sure if they meet no surface; negative: unknown.
  std::array<double, kCount> trusted_{};
  std::array<float, kCount> value_{};
  std::array<bool, kCount> given_{};
  std::array<bool, kCount> inside_{};
  std::array<int, kCount> winding_{};  ///< winding number, if the solids have no open boundary; or kUnknown
  std::array<int, kCount> order_{};
};

}  // namespace

bool holds_seam(const Brick& brick, double cell_edge) {
  bool holds = false;
  for_each_cell(brick, kAllOctants,
                [&](const CellEdges& edges, int, int, int) { holds = holds || edges.on_seam(cell_edge); });
  return holds;
}

Octants measure_octants(const SolidSurface& surface, const BrickTree& tree, std::uint32_t brick) {
  const Brick& parent = tree.exact(brick);
  const double edge = 0.5 * tree.cell_edge(tree.level(brick));
  const FineNodes nodes(surface, parent, tree.low(brick), edge);
  Octants octants;
  for (int octant = 0; octant < 8; ++octant) {
    Brick& child = octants.bricks[static_cast<std::size_t>(octant)];
    for (int node = 0; node < kBrickValues; ++node) {
      child.value[node] = nodes.value(node % kBrickNodes + kBrickCells * (octant & 1),
                                      node / kBrickNodes % kBrickNodes + kBrickCells * (octant >> 1 & 1),
                                      node / (kBrickNodes * kBrickNodes) + kBrickCells * (octant >> 2));
    }
    octants.seamed = octants.seamed || holds_seam(child, edge);
  }
  return octants;
}

}  // namespace godobject::scene_compiler
