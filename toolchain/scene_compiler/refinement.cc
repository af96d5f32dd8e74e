#include "toolchain/scene_compiler/refinement.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "toolchain/command/failure.h"
#include "toolchain/scene_compiler/brick_lattice.h"
#include "toolchain/scene_compiler/brick_tree.h"
#include "toolchain/scene_compiler/distance_probe.h"
#include "toolchain/scene_compiler/field_slope.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickCells;
using format::kBrickNodes;
using format::kBrickValues;

constexpr double kSlack = 0.85;       // of the tolerance: between the points that are looked at it may be worse
constexpr double kEdgeSpacing = 0.5;  // of points along the mesh's edges, in cells
constexpr double kFaceSpacing = 1.0;  // of those on its faces, at most
constexpr double kStepOff = 1e-3;     // from the surface, in cells: tells the body's surface from what lies within it
constexpr double kSteepest = 1.95;    // of the refined field; Scene::open takes gradients up to 2
constexpr int kFineNodes = 2 * kBrickCells + 1;

/// What a look at the surface found.
struct Misses {
  std::vector<std::uint32_t> bricks;     ///< to be halved where the stored field misses the surface
  std::vector<std::uint32_t> triangles;  ///< on which it does
};

/// Finds where the stored field misses the surface and could be better.
class SurfaceCheck {
 public:
  /// `barred` bricks stay as they are.
  SurfaceCheck(const SolidSurface& surface, const BrickTree& tree, const std::vector<bool>& barred, double tolerance)
      : surface_(surface), tree_(tree), barred_(barred), tolerance_(tolerance), marked_(tree.brick_count()) {}

  Misses run(const std::vector<std::uint32_t>& triangles, const Progress& progress) {
    std::vector<char> missed(triangles.size());
    parallel_for(
        triangles.size(), [&](std::size_t i) { missed[i] = check_triangle(triangles[i]) ? 1 : 0; }, progress);
    Misses misses;
    for (std::uint32_t b = 0; b < marked_.size(); ++b) {
      if (marked_[b].load(std::memory_order_relaxed)) misses.bricks.push_back(b);
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (missed[i] != 0) misses.triangles.push_back(triangles[i]);
    }
    return misses;
  }

 private:
  using Corners = std::array<Vector3d, 3>;

  /// Walks along both sides of one triangle.
  struct Sides {
    Vector3d normal;
    DistanceProbe above, below;
  };

  bool check_triangle(std::size_t number) {
    const auto& triangle = surface_.mesh().triangles[number];
    const SolidSurface::Component& component = surface_.components()[surface_.component_of_triangle()[number]];
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = surface_.mesh().vertices[triangle[i]];
    const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    Sides sides{normal, DistanceProbe(surface_), DistanceProbe(surface_)};
    if (!component.shell) return check_piece(corners, sides);
    bool missed = false;
    for (const double side : {-0.5, 0.5}) {
      Corners raised = corners;
      for (Vector3d& corner : raised) corner += side * surface_.thickness() * sides.normal;
      missed = check_piece(raised, sides) || missed;
    }
    return missed;
  }

  bool check_piece(const Corners& corners, Sides& sides) {
    bool missed = divide(corners, sides);
    const Vector3d center = (corners[0] + corners[1] + corners[2]) / 3.0;
    for (std::size_t i = 0; i < 3; ++i) missed = walk(corners[i], corners[(i + 1) % 3], center, sides) || missed;
    return missed;
  }

  /// Along an edge, from end to end.
  bool walk(const Vector3d& from, const Vector3d& to, const Vector3d& center, Sides& sides) {
    const double length = (to - from).norm();
    bool missed = false;
    for (double way = 0.0; way < length;) {
      const Vector3d p = from + way / length * (to - from);
      const BrickTree::Leaf leaf = tree_.find(tree_.unit_cell(p));
      missed = check_point(p, leaf, center, sides) || missed;
      way += kEdgeSpacing * tree_.cell_edge(leaf.level);
    }
    return check_point(to, tree_.find(tree_.unit_cell(to)), center, sides) || missed;
  }

  /// Into four, until the pieces are as small as the cells of the bricks that they are in.
  bool divide(const Corners& corners, Sides& sides) {
    const Vector3d center = (corners[0] + corners[1] + corners[2]) / 3.0;
    const BrickTree::Leaf leaf = tree_.find(tree_.unit_cell(center));
    double longest = 0.0;
    Corners middles;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d& next = corners[(i + 1) % 3];
      longest = std::max(longest, (next - corners[i]).norm());
      middles[i] = 0.5 * (corners[i] + next);
    }
    if (longest <= kFaceSpacing * tree_.cell_edge(leaf.level)) return check_point(center, leaf, center, sides);
    bool missed = false;
    for (const Corners& part :
         {Corners{corners[0], middles[0], middles[2]}, Corners{middles[0], corners[1], middles[1]},
          Corners{middles[2], middles[1], corners[2]}, middles}) {
      missed = divide(part, sides) || missed;
    }
    return missed;
  }

  /// `leaf` holds p, `center` is a point of the same triangle off its rim.
  bool check_point(const Vector3d& p, const BrickTree::Leaf& leaf, const Vector3d& center, Sides& sides) {
    if (leaf.brick == BrickTree::kNone || std::abs(tree_.interpolate(leaf, p)) <= tolerance_) return false;
    std::array<std::uint32_t, BrickTree::kMostResponsible> responsible{};
    const std::size_t count = tree_.responsible(leaf, p, responsible);
    bool possible = false;
    bool known = true;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t brick = responsible[i];
      if (barred_[brick] || tree_.level(brick) == format::kMaxRefinement) continue;
      possible = true;
      known = known && marked_[brick].load(std::memory_order_relaxed);
    }
    if (!possible) return false;
    if (known) return true;
    if (!bounds_the_body(p, center, tree_.cell_edge(leaf.level), sides)) return false;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t brick = responsible[i];
      if (barred_[brick] || tree_.level(brick) == format::kMaxRefinement) continue;
      marked_[brick].store(true, std::memory_order_relaxed);
    }
    return true;
  }

  /// Not where a triangle runs within the body, of itself or of another component.
  static bool bounds_the_body(const Vector3d& p, const Vector3d& center, double cell_edge, Sides& sides) {
    const Vector3d inward = center - p;
    const double length = inward.norm();
    const Vector3d beside = length > 0.0 ? Vector3d(p + inward * std::min(1.0, 0.5 * cell_edge / length)) : p;
    const Vector3d step = kStepOff * cell_edge * sides.normal;
    return (sides.above.signed_distance(beside + step) < 0.0) != (sides.below.signed_distance(beside - step) < 0.0);
  }

  const SolidSurface& surface_;
  const BrickTree& tree_;
  const std::vector<bool>& barred_;
  double tolerance_;
  std::vector<std::atomic<bool>> marked_;
};

/// The eight octants of a brick, nodes exact.
struct Octants {
  std::array<format::Brick, 8> bricks{};
  bool seamed = false;
};

Octants evaluate(const SolidSurface& surface, const BrickTree& tree, std::uint32_t brick) {
  std::array<float, kFineNodes * kFineNodes * kFineNodes> nodes{};
  const format::Brick& parent = tree.exact(brick);
  const double edge = 0.5 * tree.cell_edge(tree.level(brick));
  const Vector3d low = tree.low(brick);
  DistanceProbe probe(surface);
  const auto number = [](int x, int y, int z) {
    return static_cast<std::size_t>(x + kFineNodes * (y + kFineNodes * z));
  };
  for (int z = 0; z < kFineNodes; ++z) {
    for (int row = 0; row < kFineNodes; ++row) {
      const int y = z % 2 == 0 ? row : kFineNodes - 1 - row;  // back and forth, so that each step is short
      for (int column = 0; column < kFineNodes; ++column) {
        const int x = row % 2 == 0 ? column : kFineNodes - 1 - column;
        const bool known = x % 2 == 0 && y % 2 == 0 && z % 2 == 0;
        nodes[number(x, y, z)] = known ? parent.value[x / 2 + kBrickNodes * (y / 2 + kBrickNodes * (z / 2))]
                                       : static_cast<float>(probe.signed_distance(low + edge * Vector3d(x, y, z)));
      }
    }
  }
  Octants octants;
  for (int octant = 0; octant < 8; ++octant) {
    format::Brick& child = octants.bricks[static_cast<std::size_t>(octant)];
    child.seam_clearance = parent.seam_clearance;
    for (int node = 0; node < kBrickValues; ++node) {
      const int x = node % kBrickNodes + kBrickCells * (octant & 1);
      const int y = node / kBrickNodes % kBrickNodes + kBrickCells * (octant >> 1 & 1);
      const int z = node / (kBrickNodes * kBrickNodes) + kBrickCells * (octant >> 2);
      child.value[node] = nodes[number(x, y, z)];
    }
    for_each_cell(
        child, [&](const CellEdges& edges, int, int, int) { octants.seamed = octants.seamed || edges.on_seam(edge); });
  }
  return octants;
}

/// Bricks that are asked for, and the coarser ones about them that must be halved first; coarse before fine.
std::vector<std::uint32_t> with_coarser_neighbours(const BrickTree& tree, std::vector<std::uint32_t> wanted) {
  std::vector<bool> listed(tree.brick_count());
  for (const std::uint32_t b : wanted) listed[b] = true;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    for (const BrickTree::Leaf& leaf : tree.leaves_about(wanted[i])) {
      if (leaf.brick == BrickTree::kNone || leaf.level >= tree.level(wanted[i]) || listed[leaf.brick]) continue;
      listed[leaf.brick] = true;
      wanted.push_back(leaf.brick);
    }
  }
  std::sort(wanted.begin(), wanted.end(), [&](std::uint32_t a, std::uint32_t b) {
    return tree.level(a) != tree.level(b) ? tree.level(a) < tree.level(b) : a < b;
  });
  return wanted;
}

class Refinement {
 public:
  Refinement(DistanceGrid& field, const SolidSurface& surface, double tolerance)
      : field_(field), surface_(surface), tolerance_(tolerance), barred_(field.bricks.size()) {
    for (std::size_t i = 0; i < field.bricks.size(); ++i) barred_[i] = field.bricks[i].seam_clearance <= 0.0f;
  }

  /// False if some position had to be barred: begin again without it.
  bool run(const Progress& progress) {
    BrickTree tree(field_);
    std::vector<bool> barred = barred_;
    std::vector<std::uint32_t> all(surface_.mesh().triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<std::uint32_t> triangles = all;
    while (true) {
      const bool whole = triangles.size() == all.size();
      Misses misses = SurfaceCheck(surface_, tree, barred, kSlack * tolerance_).run(triangles, progress);
      std::vector<std::uint32_t> wanted = std::move(misses.bricks);
      if (wanted.empty() && !whole) {
        triangles = all;  // a neighbour's halving may have changed what was good
        continue;
      }
      if (wanted.empty()) {
        if (!beside_steep(tree, barred, wanted)) return false;
        if (wanted.empty()) break;
      }
      halve(tree, with_coarser_neighbours(tree, std::move(wanted)), barred);
      tree.join();
      triangles = std::move(misses.triangles);
    }
    tree.write(field_);
    report_.refined = field_.refined.size();
    for (std::uint32_t b = 0; b < tree.brick_count(); ++b) {
      if (tree.is_leaf(b)) ++report_.bricks[static_cast<std::size_t>(tree.level(b))];
    }
    return true;
  }

  const RefinementReport& report() const { return report_; }

 private:
  /// Halves what can be halved of `wanted` and bars the rest.
  void halve(BrickTree& tree, const std::vector<std::uint32_t>& wanted, std::vector<bool>& barred) const {
    if (tree.brick_count() + 8 * wanted.size() > kMaxBricks) {
      throw command::Failure(command::ExitCode::kBadData,
                             fmt::format("a field_tolerance of {:g} m needs more than the limit of {} bricks; take a "
                                         "larger one, or a larger voxel_size",
                                         tolerance_, kMaxBricks));
    }
    std::vector<Octants> octants(wanted.size());
    parallel_for(wanted.size(), [&](std::size_t i) {
      if (!barred[wanted[i]]) octants[i] = evaluate(surface_, tree, wanted[i]);
    });
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const std::uint32_t brick = wanted[i];
      bool possible = !barred[brick] && !octants[i].seamed;
      for (const BrickTree::Leaf& leaf : tree.leaves_about(brick)) {
        possible = possible && (leaf.brick == BrickTree::kNone || leaf.level >= tree.level(brick));
      }
      if (possible) {
        tree.halve(brick, octants[i].bricks);
      } else {
        barred[brick] = true;
      }
    }
    barred.resize(tree.brick_count());
  }

  /// A coarse brick's values beside finer exact ones may be steep; where too steep, halve it too. False if that cannot
  /// be: then the whole position is barred.
  bool beside_steep(const BrickTree& tree, const std::vector<bool>& barred, std::vector<std::uint32_t>& wanted) {
    bool possible = true;
    for (std::uint32_t b = 0; b < tree.brick_count(); ++b) {
      if (tree.level(b) == 0 || !tree.is_leaf(b)) continue;
      FieldSlope slope(tree.cell_edge(tree.level(b)));
      slope.add(tree.stored(b));
      if (slope.largest_with_seams() <= kSteepest) continue;
      bool found = false;
      for (const BrickTree::Leaf& leaf : tree.leaves_about(b)) {
        if (leaf.brick == BrickTree::kNone || leaf.level >= tree.level(b) || barred[leaf.brick]) continue;
        if (std::find(wanted.begin(), wanted.end(), leaf.brick) == wanted.end()) wanted.push_back(leaf.brick);
        found = true;
      }
      if (found) continue;
      barred_[tree.root(b)] = true;
      possible = false;
    }
    return possible;
  }

  DistanceGrid& field_;
  const SolidSurface& surface_;
  double tolerance_;
  std::vector<bool> barred_;  // positions, by brick number
  RefinementReport report_;
};

}  // namespace

RefinementReport refine(DistanceGrid& field, const SolidSurface& surface, double tolerance, const Progress& progress) {
  Refinement refinement(field, surface, tolerance);
  while (!refinement.run(progress)) {
  }
  return refinement.report();
}

}  // namespace godobject::scene_compiler
