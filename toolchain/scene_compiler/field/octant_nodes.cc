#include "toolchain/scene_compiler/field/octant_nodes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "toolchain/scene_compiler/field/cell_edges.h"

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
    const bool values_tell = surface.shell_triangles().empty() && surface.dilation() == 0.0;
    for (int i = 0; i < kCount; ++i) measure(i, parent, values_tell);
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

  /// `values_tell`: a given value is the distance to the solids.
  void measure(int i, const Brick& parent, bool values_tell) {
    const auto [x, y, z] = place(i);
    trusted_[at(i)] = -1.0;
    given_[at(i)] = x % 2 == 0 && y % 2 == 0 && z % 2 == 0;
    if (given_[at(i)]) value_[at(i)] = parent.value[x / 2 + kBrickNodes * (y / 2 + kBrickNodes * (z / 2))];
    if (given_[at(i)] && values_tell) {
      to_solids_[at(i)] = std::abs(static_cast<double>(value_[at(i)]));
      inside_[at(i)] = value_[at(i)] < 0.0f;
      if (surface_.sealed()) trusted_[at(i)] = std::numeric_limits<double>::infinity();
      return;
    }
    // the node before this one in x, y or z is a neighbour: its distance bounds this one's
    const int before = x > 0 ? i - 1 : y > 0 ? i - kFineNodes : i - kFineNodes * kFineNodes;
    const Vector3d p = point(i);
    to_solids_[at(i)] = surface_.distance_to_solids(p, i > 0 ? (to_solids_[at(before)] + edge_) * kRoundedUp : -1.0);
    to_shells_[at(i)] = surface_.distance_to_shells(p, i > 0 ? (to_shells_[at(before)] + edge_) * kRoundedUp : -1.0);
  }

  /// Decides the side of a node. Call it for the nodes farthest from the solids first.
  void decide(int i) {
    const auto [x, y, z] = place(i);
    for (int step = 0; step < 27; ++step) {
      const int dx = step % 3 - 1;
      const int dy = step / 3 % 3 - 1;
      const int dz = step / 9 - 1;
      const auto within = [](int n) { return n >= 0 && n < kFineNodes; };
      if (!within(x + dx) || !within(y + dy) || !within(z + dz)) continue;
      const std::size_t near = at(number(x + dx, y + dy, z + dz));
      const double step_length = edge_ * std::sqrt(static_cast<double>(dx * dx + dy * dy + dz * dz)) * kRoundedUp;
      const double trusted = trusted_[near] - step_length;
      if (trusted <= trusted_[at(i)] || trusted < 0.0 || to_solids_[near] <= step_length) continue;
      trusted_[at(i)] = trusted;
      inside_[at(i)] = inside_[near];
    }
    if (trusted_[at(i)] >= 0.0) return;
    const Vector3d p = point(i);
    const double winding_number = surface_.winding_number(p);
    inside_[at(i)] = winding_number > 0.5;
    trusted_[at(i)] = surface_.constant_side_path(p, winding_number);
  }

  static constexpr double kRoundedUp = 1.0 + 1e-6;  // given values are floats

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
