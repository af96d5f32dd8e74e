#include "toolchain/scene_compiler/field/refinement.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/field/brick_lattice.h"
#include "toolchain/scene_compiler/field/brick_tree.h"
#include "toolchain/scene_compiler/field/clearance_bounds.h"
#include "toolchain/scene_compiler/field/distance_probe.h"
#include "toolchain/scene_compiler/field/field_slope.h"
#include "toolchain/scene_compiler/field/straight_edges.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickCells;
using format::kBrickNodes;
using format::kBrickValues;

constexpr double kSlack = 0.85;       // of the tolerance: between the points that are looked at it may be worse
constexpr double kBlendSlack = 0.65;  // of that, where a field that bends is blended with an edge
constexpr double kEdgeSpacing = 0.5;  // of points along the mesh's edges, in cells
constexpr double kFaceSpacing = 1.0;  // of those on its faces, at most
constexpr double kStepOff = 1e-3;     // from the surface, in cells: tells the body's surface from what lies within it
constexpr double kSteepest =
    1.95;  // of the refined field before it is rounded; Scene::open takes gradients up to 2 and what rounding adds
constexpr double kWidestTube = 2.4;                   // about a straight edge, in voxels
constexpr double kCellDiagonal = 1.7320508075688774;  // of a cell's edge
constexpr int kFineNodes = 2 * kBrickCells + 1;

/// Octants of bricks that are to be halved: by brick, a bit each.
using Wanted = std::map<std::uint32_t, std::uint8_t>;

void want(Wanted& wanted, std::uint32_t brick, std::uint8_t octants) {
  std::uint8_t& of_brick = wanted[brick];
  of_brick = static_cast<std::uint8_t>(of_brick | octants);
}

/// What a look at the surface found.
struct Misses {
  Wanted wanted;                         ///< where the stored field misses the surface
  std::vector<std::uint32_t> triangles;  ///< on which it does
};

/// Finds where the stored field misses the surface and could be better.
class SurfaceCheck {
 public:
  /// `barred` bricks stay as they are.
  SurfaceCheck(const SolidSurface& surface, const BrickTree& tree, const std::vector<bool>& barred, double tolerance)
      : surface_(surface), tree_(tree), barred_(barred), tolerance_(tolerance), marked_(tree.brick_count()) {}

  Misses run(const std::vector<std::uint32_t>& triangles, const parallel::Progress& progress) {
    const bool dilated = surface_.dilation() > 0.0;
    std::vector<char> missed(triangles.size(), dilated ? 1 : 0);
    if (dilated) {
      parallel::for_each_index(
          tree_.brick_count(), [&](std::size_t i) { check_brick(static_cast<std::uint32_t>(i)); }, progress);
    } else {
      parallel::for_each_index(
          triangles.size(), [&](std::size_t i) { missed[i] = check_triangle(triangles[i]) ? 1 : 0; }, progress);
    }
    Misses misses;
    for (std::uint32_t b = 0; b < marked_.size(); ++b) {
      const std::uint8_t octants = marked_[b].load(std::memory_order_relaxed);
      if (octants != 0) misses.wanted.emplace_hint(misses.wanted.end(), b, octants);
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

  /// In two across the longest edge, so that slivers take few, until the pieces are as small as the cells of the bricks
  /// that they are in.
  bool divide(const Corners& corners, Sides& sides) {
    const Vector3d center = (corners[0] + corners[1] + corners[2]) / 3.0;
    const BrickTree::Leaf leaf = tree_.find(tree_.unit_cell(center));
    std::size_t longest = 0;
    std::array<double, 3> squared{};
    for (std::size_t i = 0; i < 3; ++i) {
      squared[i] = (corners[(i + 1) % 3] - corners[i]).squaredNorm();
      if (squared[i] > squared[longest]) longest = i;
    }
    if (std::sqrt(squared[longest]) <= kFaceSpacing * tree_.cell_edge(leaf.level)) {
      return check_point(center, leaf, center, sides);
    }
    Corners one = corners;
    Corners other = corners;
    one[longest] = other[(longest + 1) % 3] = 0.5 * (corners[longest] + corners[(longest + 1) % 3]);
    const bool missed = divide(one, sides);
    return divide(other, sides) || missed;
  }

  /// A dilated surface has no triangles: looked at in the cells about it, in the middle, where trilinear interpolation
  /// misses a convex function most, and between there and the corners, as the curvature may begin within the cell.
  /// Against the exact distance there.
  void check_brick(std::uint32_t brick) {
    const std::uint8_t whole = tree_.whole(brick);
    if (whole == 0) return;
    const double edge = tree_.cell_edge(tree_.level(brick));
    const Brick& nodes = tree_.exact(brick);
    const auto [low, high] = std::minmax_element(std::begin(nodes.value), std::end(nodes.value));
    if (static_cast<double>(*low) > kCellDiagonal * edge || static_cast<double>(*high) < -kCellDiagonal * edge) return;
    DistanceProbe probe(surface_);
    for (int z = 0; z < kBrickCells; ++z) {
      for (int y = 0; y < kBrickCells; ++y) {
        for (int x = 0; x < kBrickCells; ++x) {
          const unsigned octant = octant_of_cell(x, y, z);
          if ((whole >> octant & 1) == 0) continue;
          const BrickTree::Leaf leaf{brick, tree_.level(brick), static_cast<std::uint8_t>(octant)};
          const Vector3d middle = tree_.low(brick) + edge * Vector3d(x + 0.5, y + 0.5, z + 0.5);
          const double exact = probe.signed_distance(middle);
          if (std::abs(exact) >= 0.5 * kCellDiagonal * edge) continue;
          bool missed = check_value(middle, leaf, exact, [] { return true; });
          for (int corner = 0; corner < 8 && !missed; ++corner) {
            const Vector3d side((corner & 1) - 0.5, (corner >> 1 & 1) - 0.5, (corner >> 2) - 0.5);
            const Vector3d p = middle + 0.5 * edge * side;
            missed = check_value(p, leaf, probe.signed_distance(p), [] { return true; });
          }
        }
      }
    }
  }

  /// Of the field's error on the surface.
  bool good(const BrickTree::Leaf& leaf, double error) const {
    const double tolerance = tree_.edges_of(leaf.brick).empty() ? tolerance_ : kBlendSlack * tolerance_;
    return error <= tolerance && error >= -kHeldOff * tolerance;
  }

  /// `leaf` holds p, `center` is a point of the same triangle off its rim.
  bool check_point(const Vector3d& p, const BrickTree::Leaf& leaf, const Vector3d& center, Sides& sides) {
    if (leaf.brick == BrickTree::kNone) return false;
    return check_value(p, leaf, 0.0, [&] { return bounds_the_body(p, center, tree_.cell_edge(leaf.level), sides); });
  }

  /// `leaf` holds p, where the exact distance is `exact`; a miss counts only if `matters` says so.
  template <class Matters>
  bool check_value(const Vector3d& p, const BrickTree::Leaf& leaf, double exact, Matters&& matters) {
    if (good(leaf, tree_.interpolate(leaf, p) - exact)) return false;
    BrickTree::Octants about{};
    const std::size_t count = good(leaf, tree_.interpolate_exact(leaf, p) - exact) ? tree_.coarser_about(leaf, p, about)
                                                                                   : tree_.holding(leaf, p, about);
    bool possible = false;
    bool known = true;
    for (std::size_t i = 0; i < count; ++i) {
      if (!can_be_halved(about[i])) continue;
      possible = true;
      known = known && (marked_[about[i].brick].load(std::memory_order_relaxed) & about[i].bit()) != 0;
    }
    if (!possible) return false;
    if (known) return true;
    if (!matters()) return false;
    for (std::size_t i = 0; i < count; ++i) {
      if (can_be_halved(about[i])) marked_[about[i].brick].fetch_or(about[i].bit(), std::memory_order_relaxed);
    }
    return true;
  }

  bool can_be_halved(const BrickTree::Octant& octant) const {
    return !barred_[octant.brick] && tree_.level(octant.brick) < format::kMaxRefinement;
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
  std::vector<std::atomic<std::uint8_t>> marked_;  ///< octants, by brick
};

bool holds_seam(const Brick& brick, double cell_edge) {
  bool holds = false;
  for_each_cell(brick, kAllOctants,
                [&](const CellEdges& edges, int, int, int) { holds = holds || edges.on_seam(cell_edge); });
  return holds;
}

/// The eight octants of a brick, nodes exact.
struct Octants {
  std::array<Brick, 8> bricks{};
  bool seamed = false;
};

/// Exact signed distances at the nodes of a brick's octants. A node is on the side of a neighbour that is further from
/// every solid's triangle than from the node, as far as the side can be trusted without a winding number: so few are
/// needed.
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
    // the last node in x, y or z is a neighbour: its distance bounds this one's
    const int before = x > 0 ? i - 1 : y > 0 ? i - kFineNodes : i - kFineNodes * kFineNodes;
    const Vector3d p = point(i);
    to_solids_[at(i)] = surface_.distance_to_solids(p, i > 0 ? (to_solids_[at(before)] + edge_) * kRoundedUp : -1.0);
    to_shells_[at(i)] = surface_.distance_to_shells(p, i > 0 ? (to_shells_[at(before)] + edge_) * kRoundedUp : -1.0);
  }

  /// Those further from the solids come first.
  void decide(int i) {
    const auto [x, y, z] = place(i);
    for (int step = 0; step < 27; ++step) {
      const int dx = step % 3 - 1;
      const int dy = step / 3 % 3 - 1;
      const int dz = step / 9 - 1;
      const auto within = [](int n) { return n >= 0 && n < kFineNodes; };
      if (!within(x + dx) || !within(y + dy) || !within(z + dz)) continue;
      const std::size_t near = at(number(x + dx, y + dy, z + dz));
      const double way = edge_ * std::sqrt(static_cast<double>(dx * dx + dy * dy + dz * dz)) * kRoundedUp;
      const double trusted = trusted_[near] - way;
      if (trusted <= trusted_[at(i)] || trusted < 0.0 || to_solids_[near] <= way) continue;
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
  std::array<double, kCount> trusted_{};  ///< how far from the node its side holds without a surface; negative: unknown
  std::array<float, kCount> value_{};
  std::array<bool, kCount> given_{};
  std::array<bool, kCount> inside_{};
  std::array<int, kCount> order_{};
};

Octants evaluate(const SolidSurface& surface, const BrickTree& tree, std::uint32_t brick) {
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

class Refinement {
 public:
  Refinement(DistanceGrid& field, const SolidSurface& surface, double tolerance, double slack,
             const parallel::Progress& progress)
      : field_(field), surface_(surface), tolerance_(tolerance), slack_(slack), barred_(field.bricks.size()) {
    for (std::size_t i = 0; i < field.bricks.size(); ++i) {
      barred_[i] = field.beside_seam[i] && holds_seam(field.bricks[i], field.grid.voxel_size);
    }
    triangles_.resize(surface.mesh().triangles.size());
    std::iota(triangles_.begin(), triangles_.end(), 0u);
    find_edges(progress);
  }

  /// False if some position had to be barred: begin again without it.
  bool run(const parallel::Progress& progress) {
    BrickTree tree(field_, edges_);
    std::vector<bool> barred = barred_;
    if (!part_edges(tree, barred)) return false;
    std::vector<std::uint32_t> triangles = triangles_;
    while (true) {
      const bool whole = triangles.size() == triangles_.size();
      Misses misses = SurfaceCheck(surface_, tree, barred, kSlack * tolerance_).run(triangles, progress);
      Wanted wanted = std::move(misses.wanted);
      if (wanted.empty() && !whole) {
        triangles = triangles_;  // a neighbour's halving may have changed what was good
        continue;
      }
      if (wanted.empty()) {
        if (!beside_steep(tree, barred, wanted)) return false;
        if (wanted.empty()) break;
      }
      halve(tree, wanted, barred);
      tree.join();
      triangles = std::move(misses.triangles);
    }
    tree.round(slack_);
    tree.write(field_);
    for (format::Edge& edge : field_.edges) edge.offset += slack_;
    if (slack_ != 0.0) bound_clearances(field_);  // of the edges too
    report_.refined = field_.refined.size();
    report_.edges = field_.edges.size();
    report_.finer = field_.bricks.size() - barred_.size();
    for (std::uint32_t b = 0; b < tree.brick_count(); ++b) {
      if (tree.whole(b) != 0) ++report_.bricks[static_cast<std::size_t>(tree.level(b))];
    }
    return true;
  }

  const RefinementReport& report() const { return report_; }

 private:
  /// Those that reach a brick in which the surface is missed without.
  void find_edges(const parallel::Progress& progress) {
    const format::Grid& grid = field_.grid;
    // what is stored holds them: it goes as far as the band, interpolated
    const double room = grid.band - kInterpolationError * grid.voxel_size;
    const auto all = straight_edges(surface_, grid.voxel_size, std::min(kWidestTube * grid.voxel_size, room));
    if (all.empty()) return;
    const BrickTree unrefined(field_, all);
    const std::vector<format::Edge> none;
    const BrickTree without(field_, none);
    std::vector<bool> needed(all.size());
    const Misses misses = SurfaceCheck(surface_, without, barred_, kSlack * tolerance_).run(triangles_, progress);
    for (const auto& [b, octants] : misses.wanted) {
      for (const std::uint32_t e : unrefined.edges_of(b)) needed[e] = true;
    }
    for (std::size_t e = 0; e < all.size(); ++e) {
      if (needed[e]) edges_.push_back(all[e]);
    }
  }

  /// Halves bricks until none names two edges. False if some edge had to be left out: begin again without it.
  bool part_edges(BrickTree& tree, std::vector<bool>& barred) {
    while (true) {
      Wanted wanted;
      std::vector<bool> left_out(edges_.size());
      for (std::uint32_t b = 0; b < tree.brick_count(); ++b) {
        if (tree.whole(b) == 0) continue;
        const auto& edges = tree.edges_of(b);
        // a seam's jump must not be blended
        if (!edges.empty() && field_.beside_seam[tree.root(b)]) leave_out(edges, 0, left_out);
        if (edges.size() < 2) continue;
        if (barred[b] || tree.level(b) == format::kMaxRefinement) {
          leave_out(edges, 1, left_out);
        } else {
          want(wanted, b, kAllOctants);
        }
      }
      if (drop(left_out)) return false;
      if (wanted.empty()) break;
      halve(tree, wanted, barred);
    }
    tree.join();
    return true;
  }

  static void leave_out(const std::vector<std::uint32_t>& edges, std::size_t but, std::vector<bool>& left_out) {
    for (std::size_t i = but; i < edges.size(); ++i) left_out[edges[i]] = true;
  }

  /// Whether there was any.
  bool drop(const std::vector<bool>& left_out) {
    std::vector<format::Edge> kept;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (!left_out[e]) kept.push_back(edges_[e]);
    }
    const bool any = kept.size() < edges_.size();
    edges_ = std::move(kept);
    return any;
  }

  /// Halves what can be halved of `wanted` and bars the rest.
  void halve(BrickTree& tree, const Wanted& wanted, std::vector<bool>& barred) {
    if (tree.brick_count() + 8 * wanted.size() > kMaxBricks) {
      throw command::Failure(command::ExitCode::kBadData,
                             fmt::format("a field_tolerance of {:g} m needs more than the limit of {} bricks; take a "
                                         "larger one, or a larger voxel_size",
                                         tolerance_, kMaxBricks));
    }
    std::vector<std::pair<std::uint32_t, Octants*>> unknown;
    for (const auto& [brick, octants] : wanted) {
      if (barred[brick]) continue;
      const auto [found, fresh] = known_.try_emplace(tree.place(brick));
      if (fresh) unknown.emplace_back(brick, &found->second);
    }
    parallel::for_each_index(unknown.size(),
                             [&](std::size_t i) { *unknown[i].second = evaluate(surface_, tree, unknown[i].first); });
    for (const auto& [brick, octants] : wanted) {
      if (barred[brick]) continue;
      const Octants& finer = known_.at(tree.place(brick));
      if (finer.seamed) {
        barred[brick] = true;
      } else {
        tree.halve(brick, octants, finer.bricks);
      }
    }
    barred.resize(tree.brick_count());
  }

  /// A coarse brick's values beside finer exact ones may be steep, and so may be the change to an edge's exact
  /// distance; where too steep, halve it too. False if that cannot be: then the whole position is barred, or the edge
  /// left out.
  bool beside_steep(const BrickTree& tree, const std::vector<bool>& barred, Wanted& wanted) {
    bool possible = true;
    std::vector<bool> left_out(edges_.size());
    std::vector<char> steep(tree.brick_count());
    parallel::for_each_index(tree.brick_count(), [&](std::size_t i) {
      const auto b = static_cast<std::uint32_t>(i);
      if (tree.whole(b) == 0 || (tree.level(b) == 0 && tree.edges_of(b).empty())) return;
      FieldSlope slope(tree.cell_edge(tree.level(b)));
      tree.add_slope(b, slope);
      steep[i] = slope.largest_with_seams() > kSteepest ? 1 : 0;
    });
    for (std::uint32_t b = 0; b < tree.brick_count(); ++b) {
      if (steep[b] == 0) continue;
      const bool edged = !tree.edges_of(b).empty();
      bool found = false;
      if (edged && !barred[b] && tree.level(b) < format::kMaxRefinement) {
        want(wanted, b, kAllOctants);
        continue;
      }
      for (const BrickTree::Leaf& leaf : tree.leaves_about(b)) {
        if (leaf.brick == BrickTree::kNone || leaf.level >= tree.level(b) || barred[leaf.brick]) continue;
        want(wanted, leaf.brick, leaf.where().bit());
        found = true;
      }
      if (found) continue;
      if (edged) {
        leave_out(tree.edges_of(b), 0, left_out);
      } else {
        barred_[tree.root(b)] = true;
      }
      possible = false;
    }
    drop(left_out);
    return possible;
  }

  DistanceGrid& field_;
  const SolidSurface& surface_;
  double tolerance_;
  double slack_;
  std::vector<std::uint32_t> triangles_;         // all
  std::vector<format::Edge> edges_;              // in use
  std::vector<bool> barred_;                     // positions, by brick number
  std::map<std::array<int, 4>, Octants> known_;  // of bricks halved before a position had to be barred, by place
  RefinementReport report_;
};

}  // namespace

RefinementReport refine(DistanceGrid& field, const SolidSurface& surface, double tolerance,
                        const parallel::Progress& progress, double slack) {
  Refinement refinement(field, surface, tolerance, slack, progress);
  while (!refinement.run(progress)) {
  }
  return refinement.report();
}

void round_distances(DistanceGrid& field) {
  const std::vector<format::Edge> no_edges;
  BrickTree tree(field, no_edges);
  tree.round(0.0);
  tree.write(field);
}

}  // namespace godobject::scene_compiler
