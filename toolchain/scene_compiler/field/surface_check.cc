#include "toolchain/scene_compiler/field/surface_check.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "toolchain/scene_compiler/field/cell_edges.h"
#include "toolchain/scene_compiler/field/distance_probe.h"
#include "toolchain/scene_compiler/field/refinement.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickCells;

// Chosen: of the tolerance inside, error where the surface turns. From cell to cell it changes, and holds a body that
// slides along an edge as friction does.
constexpr double kRipple = 0.4;
constexpr double kSurelySteep = 0.1;  // of the tolerance: with a smaller value, a field as flat as 0.1 is deep enough
constexpr double kWholeDepth = 0.99;  // of the tolerance, but for rounding
constexpr double kEdgeSpacing = 0.5;  // of points along the mesh's edges, in cells
constexpr double kFaceSpacing = 1.0;  // of those on its faces, at most
constexpr double kStepOff = 1e-3;     // from the surface, in cells: tells the body's surface from what lies within it
constexpr int kRimSteps = 6;          // of a right angle about a rim
constexpr double kRim = 0.94;         // cosine of the least angle of a fold whose outside is checked like a rim
constexpr std::size_t kTriangleParts = 128;  // of the triangles, at least, that are compared in parallel
constexpr std::size_t kMostTogether = 256;
constexpr double kCellDiagonal = 1.7320508075688774;  // of a cell's edge

/// Finds places at which the stored field misses the surface although refinement could improve it.
class SurfaceCheck {
 public:
  /// `barred` bricks are never halved.
  SurfaceCheck(const SolidSurface& surface, const BrickTree& tree, const std::vector<bool>& barred,
               const SurfaceTolerance& tolerance, double slack, Compared& compared)
      : surface_(surface),
        tree_(tree),
        barred_(barred),
        tolerance_(tolerance),
        slack_(slack),
        compared_(compared.after),
        marked_(tree.brick_count()),
        exact_(tree.brick_count()),
        smooth_(tree.brick_count()) {
    compared_.resize(surface.dilation() > 0.0 ? tree.brick_count() : surface.mesh().triangles.size());
    find_rims();
  }

  Misses run(const std::vector<std::uint32_t>& triangles, const parallel::Progress& progress) {
    const bool dilated = surface_.dilation() > 0.0;
    std::vector<char> missed(triangles.size(), dilated ? 1 : 0);
    std::vector<SurfaceError> worst(dilated ? tree_.brick_count() : triangles.size());
    if (dilated) {
      parallel::for_each_index(
          worst.size(),
          [&](std::size_t i) {
            check_brick(static_cast<std::uint32_t>(i), worst[i]);
            set_seen(i, worst[i]);
          },
          progress);
    } else {
      parallel::for_each_chunk(
          worst.size(), std::clamp<std::size_t>(worst.size() / kTriangleParts, 1, kMostTogether),
          [&](std::size_t begin, std::size_t end) {
            DistanceProbe above(surface_);
            DistanceProbe below(surface_);
            for (std::size_t i = begin; i < end; ++i) {
              missed[i] = check_triangle(triangles[i], above, below, worst[i]) ? 1 : 0;
            }
          },
          progress);
    }
    Misses misses;
    for (const SurfaceError& error : worst) misses.worst.add(error);
    for (std::uint32_t b = 0; b < marked_.size(); ++b) {
      const std::uint8_t octants = marked_[b].load(std::memory_order_relaxed);
      if (octants != 0) misses.wanted.emplace_hint(misses.wanted.end(), b, octants);
      const std::uint64_t cells = exact_[b].load(std::memory_order_relaxed);
      if (cells != 0) misses.exact.emplace_hint(misses.exact.end(), b, cells);
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (missed[i] != 0) misses.triangles.push_back(triangles[i]);
    }
    return misses;
  }

 private:
  using Corners = std::array<Vector3d, 3>;

  /// Probes on both sides of one triangle.
  struct Sides {
    Vector3d normal;
    DistanceProbe& above;
    DistanceProbe& below;
    SurfaceError& worst;  ///< that no halving reduces
    bool of_solid;        ///< the triangle is the surface; else half of the sheet's thickness lies between them
    double outward;       ///< 1 if the normal leads out of the body, else -1
    std::uint32_t seen;   ///< joins up to this one were seen by an earlier comparison; kNone: there was none

    /// The exact distance at a point that is `away` from a point of the triangle [m], on the outer or the inner side.
    double distance(DistanceProbe& probe, const Vector3d& p, double away) const {
      constexpr double kRounding = 1e-6;  // of the bound; a bound that is too small costs time only
      return of_solid ? probe.signed_distance(p, (1.0 + kRounding) * away) : probe.signed_distance(p);
    }
  };

  static constexpr std::uint32_t kNone = ~0u;

  /// Returns the joins that an earlier comparison saw; kNone if there was none, or if it left an error.
  std::uint32_t seen(std::size_t number) const { return compared_[number] - 1; }

  void set_seen(std::size_t number, const SurfaceError& worst) {
    compared_[number] = worst.in_tolerances > 0.0 ? 0 : tree_.joins() + 1;
  }

  /// True if nothing changed about a leaf since an earlier comparison.
  bool is_seen(const BrickTree::Leaf& leaf, std::uint32_t seen) const {
    return seen != kNone && (leaf.brick == BrickTree::kNone || tree_.changed_in(tree_.root(leaf.brick)) <= seen);
  }

  bool check_triangle(std::size_t number, DistanceProbe& above, DistanceProbe& below, SurfaceError& worst) {
    const auto& triangle = surface_.mesh().triangles[number];
    const SolidSurface::Component& component = surface_.components()[surface_.component_of_triangle()[number]];
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = surface_.mesh().vertices[triangle[i]];
    const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    Sides sides{normal, above, below, worst, !component.shell, component.inside_out ? -1.0 : 1.0, seen(number)};
    bool missed = !component.shell && check_piece(corners, sides);
    for (const double side : {-0.5, 0.5}) {
      if (!component.shell) break;
      Corners raised = corners;
      sides.outward = side < 0.0 ? -1.0 : 1.0;
      for (Vector3d& corner : raised) corner += side * surface_.thickness() * sides.normal;
      missed = check_piece(raised, sides) || missed;
    }
    for (std::size_t i = 0; component.shell && i < 3; ++i) {
      if (rims_.contains(edge_key(triangle[i], triangle[(i + 1) % 3])))
        missed = walk_rim(corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3], sides) || missed;
    }
    set_seen(number, worst);
    return missed;
  }

  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  static Edge edge_key(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

  /// Finds the edges of shells at which the thickened sheet is round: where it ends, branches or is folded.
  void find_rims() {
    const auto& mesh = surface_.mesh();
    std::map<Edge, std::vector<Vector3d>> normals;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (!surface_.components()[surface_.component_of_triangle()[i]].shell) continue;
      const auto& t = mesh.triangles[i];
      const Vector3d& a = mesh.vertices[t[0]];
      const Vector3d n = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).normalized();
      for (std::size_t k = 0; k < 3; ++k) normals[edge_key(t[k], t[(k + 1) % 3])].push_back(n);
    }
    for (const auto& [edge, of_faces] : normals) {
      if (of_faces.size() != 2 || std::abs(of_faces[0].dot(of_faces[1])) < kRim) rims_.insert(edge);
    }
  }

  /// Checks the round surface about an edge of a sheet, from end to end, and about its ends. `opposite` is the
  /// triangle's third corner. True if a point is missed.
  bool walk_rim(const Vector3d& from, const Vector3d& to, const Vector3d& opposite, Sides& sides) {
    const Vector3d along = (to - from).normalized();
    const Vector3d inward = opposite - from - along.dot(opposite - from) * along;
    const Vector3d outward = -inward.normalized();
    std::vector<Vector3d> about_edge;
    std::vector<Vector3d> about_end;
    for (int i = -kRimSteps; i <= kRimSteps; ++i) {
      const double angle = 0.5 * std::numbers::pi * i / kRimSteps;
      const Vector3d across = std::cos(angle) * outward + std::sin(angle) * sides.normal;
      about_edge.push_back(across);
      for (int k = -kRimSteps; k <= kRimSteps; ++k) {
        const double lean = 0.5 * std::numbers::pi * k / kRimSteps;
        about_end.push_back(std::cos(lean) * across + std::sin(lean) * along);
      }
    }
    const double length = (to - from).norm();
    bool missed = false;
    bool same_steps = true;  // as in an earlier comparison, so far
    for (double at = 0.0; at < length;) {
      const Vector3d p = from + at * along;
      const BrickTree::Leaf leaf = tree_.find(tree_.unit_cell(p + 0.5 * surface_.thickness() * outward));
      same_steps = same_steps && is_seen(leaf, sides.seen);
      missed = check_around(p, at == 0.0 ? about_end : about_edge, same_steps, sides) || missed;
      at += kEdgeSpacing * tree_.cell_edge(leaf.level);
    }
    return check_around(to, about_end, true, sides) || missed;
  }

  /// Checks the points at half the sheet's thickness from `p` in the directions, as far as they are on its surface.
  bool check_around(const Vector3d& p, const std::vector<Vector3d>& directions, bool same_steps, Sides& sides) {
    bool missed = false;
    for (const Vector3d& direction : directions) {
      const Vector3d q = p + 0.5 * surface_.thickness() * direction;
      const BrickTree::Leaf leaf = tree_.find(tree_.unit_cell(q));
      if (leaf.brick == BrickTree::kNone || (same_steps && is_seen(leaf, sides.seen))) continue;
      const double close = kStepOff * tree_.cell_edge(leaf.level);
      const auto matters = [&] { return std::abs(sides.above.signed_distance(q)) < close; };
      missed = check_value(q, leaf, 0.0, matters, sides.worst) || missed;
    }
    return missed;
  }

  bool check_piece(const Corners& corners, Sides& sides) {
    bool missed = divide(corners, sides, sides.seen == kNone);
    const Vector3d center = (corners[0] + corners[1] + corners[2]) / 3.0;
    for (std::size_t i = 0; i < 3; ++i) missed = walk(corners[i], corners[(i + 1) % 3], center, sides) || missed;
    return missed;
  }

  /// Returns the point `depth` below p, a point of the triangle.
  static Vector3d below(const Vector3d& p, double depth, const Sides& sides) {
    return p - depth * sides.outward * sides.normal;
  }

  /// True if nothing changed about p, which lies in `leaf`, and the points below it since an earlier comparison.
  bool is_seen(const Vector3d& p, const BrickTree::Leaf& leaf, const Sides& sides) const {
    const auto deep_is_seen = [&](double depth) {
      return is_seen(tree_.find(tree_.unit_cell(below(p, depth, sides))), sides.seen);
    };
    return is_seen(leaf, sides.seen) && deep_is_seen(tolerance_.inside) &&
           (slack_ == 0.0 || deep_is_seen(slack_ + tolerance_.inside));
  }

  /// Checks points of an edge, from end to end. True if one of them is missed.
  bool walk(const Vector3d& from, const Vector3d& to, const Vector3d& center, Sides& sides) {
    const double length = (to - from).norm();
    bool missed = false;
    bool same_steps = true;  // as in an earlier comparison, so far
    for (double at = 0.0; at < length;) {
      const Vector3d p = from + at / length * (to - from);
      const BrickTree::Leaf leaf = tree_.find(tree_.unit_cell(p));
      same_steps = same_steps && is_seen(leaf, sides.seen);
      if (!same_steps || !is_seen(p, leaf, sides)) missed = check_point(p, leaf, center, sides) || missed;
      at += kEdgeSpacing * tree_.cell_edge(leaf.level);
    }
    const BrickTree::Leaf leaf = tree_.find(tree_.unit_cell(to));
    if (is_seen(to, leaf, sides)) return missed;
    return check_point(to, leaf, center, sides) || missed;
  }

  /// Checks a triangle. Divides it across the longest edge, so slivers take few steps, until the pieces are as small as
  /// the cells of their bricks. `compare`: whether something changed is not asked, or has been.
  bool divide(const Corners& corners, Sides& sides, bool compare) {
    std::size_t longest = 0;
    std::array<double, 3> squared{};
    for (std::size_t i = 0; i < 3; ++i) {
      squared[i] = (corners[(i + 1) % 3] - corners[i]).squaredNorm();
      if (squared[i] > squared[longest]) longest = i;
    }
    const double length = std::sqrt(squared[longest]);
    if (!compare && length <= kBrickCells * tree_.cell_edge(0)) {
      const Vector3d about = Vector3d::Constant(slack_ + tolerance_.inside);  // the points below are looked up, too
      const Vector3d low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]) - about;
      const Vector3d high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]) + about;
      if (tree_.changed_in(low, high) <= sides.seen) return false;
      compare = true;
    }
    if (length <= kFaceSpacing * tree_.cell_edge(0)) {  // else it is too large whatever the level
      const Vector3d center = (corners[0] + corners[1] + corners[2]) / 3.0;
      const BrickTree::Leaf leaf = tree_.find(tree_.unit_cell(center));
      if (length <= kFaceSpacing * tree_.cell_edge(leaf.level)) return check_point(center, leaf, center, sides);
    }
    Corners one = corners;
    Corners other = corners;
    one[longest] = other[(longest + 1) % 3] = 0.5 * (corners[longest] + corners[(longest + 1) % 3]);
    const bool missed = divide(one, sides, compare);
    return divide(other, sides, compare) || missed;
  }

  /// Checks a dilated surface, which has no triangles, against the exact distance in the cells about it. Trilinear
  /// interpolation misses a convex function most in the middle of a cell. The points between middle and corners are
  /// checked too, because the curvature may begin within the cell.
  void check_brick(std::uint32_t brick, SurfaceError& worst) {
    const std::uint8_t whole = tree_.whole(brick);
    const std::uint32_t before = seen(brick);
    if (whole == 0 || (before != kNone && tree_.changed_in(tree_.root(brick)) <= before)) return;
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
          bool missed = check_value(
              middle, leaf, exact, [] { return true; }, worst);
          for (int corner = 0; corner < 8 && !missed; ++corner) {
            const Vector3d side((corner & 1) - 0.5, (corner >> 1 & 1) - 0.5, (corner >> 2) - 0.5);
            const Vector3d p = middle + 0.5 * edge * side;
            missed = check_value(
                p, leaf, probe.signed_distance(p), [] { return true; }, worst);
          }
        }
      }
    }
  }

  /// True if an error of the field on the surface is within the tolerance.
  bool good(double error) const { return error <= tolerance_.inside && error >= -tolerance_.outside; }

  /// True if the cell of p in `leaf` is to become exact, where the field has this error.
  template <class Matters>
  bool wants_exact(const Vector3d& p, const BrickTree::Leaf& leaf, double error, const Matters& matters) {
    if (std::abs(error) <= kRipple * tolerance_.inside || !tree_.may_be_exact(leaf.brick)) return false;
    const std::uint64_t cell = std::uint64_t{1} << tree_.cell_of(leaf, p);
    const std::uint64_t not_again = tree_.exact_cells(leaf.brick) | smooth_[leaf.brick].load(std::memory_order_relaxed);
    if ((not_again & cell) != 0) return false;
    if ((exact_[leaf.brick].load(std::memory_order_relaxed) & cell) != 0) return true;
    if (!tree_.turns_about(leaf, p)) {
      smooth_[leaf.brick].fetch_or(cell, std::memory_order_relaxed);
      return false;
    }
    if (!matters()) return false;
    exact_[leaf.brick].fetch_or(cell, std::memory_order_relaxed);
    return true;
  }

  /// Checks p in `leaf`. `center` is a point of the same triangle off its rim.
  bool check_point(const Vector3d& p, const BrickTree::Leaf& leaf, const Vector3d& center, Sides& sides) {
    if (leaf.brick == BrickTree::kNone) return false;
    std::optional<bool> known;  // two exact distances, asked for at most once
    const auto matters = [&] {
      if (!known) known = bounds_the_body(p, center, tree_.cell_edge(leaf.level), sides);
      return *known;
    };
    // a point that is missed is checked again after the halving, so one miss of it is enough
    if (check_value(p, leaf, 0.0, matters, sides.worst)) return true;
    // with a steeper field the level 0 is no deeper than the tolerance, whatever the value at p
    if (tree_.interpolate(leaf, p) > kSurelySteep * tolerance_.inside && check_below(p, 0.0, matters, sides))
      return true;
    return slack_ > 0.0 && check_below(p, slack_, matters, sides);
  }

  /// Checks the point at the tolerance below the level `depth` under p. Where the field is flat, its zero level may lie
  /// deeper than its value at p tells. A body that is made smaller touches at the slack's level, where the field bends
  /// although the surface does not.
  template <class Matters>
  bool check_below(const Vector3d& p, double depth, const Matters& matters, Sides& sides) {
    const Vector3d q = below(p, depth + tolerance_.inside, sides);
    const BrickTree::Leaf leaf = tree_.find(tree_.unit_cell(q));
    if (leaf.brick == BrickTree::kNone || tree_.interpolate(leaf, q) <= -depth) return false;
    const double exact = sides.distance(sides.outward > 0.0 ? sides.below : sides.above, q, depth + tolerance_.inside);
    // q may be less deep: near an edge, or in a thin wall
    if (exact > -depth - kWholeDepth * tolerance_.inside) return false;
    const double worst_before = sides.worst.in_tolerances;
    const bool missed = check_value(q, leaf, exact, matters, sides.worst);
    if (sides.worst.in_tolerances > worst_before) sides.worst.at = p;
    return missed;
  }

  /// Checks p in `leaf`. `exact` is the distance there. A miss counts only if matters(); it is added to `worst` if no
  /// halving reduces it.
  template <class Matters>
  bool check_value(const Vector3d& p, const BrickTree::Leaf& leaf, double exact, const Matters& matters,
                   SurfaceError& worst) {
    const double error = tree_.interpolate(leaf, p) - exact;
    if (wants_exact(p, leaf, error, matters)) return true;
    if (good(error)) return false;
    BrickTree::Octants about{};
    const std::size_t count = good(tree_.interpolate_exact(leaf, p) - exact) ? tree_.coarser_about(leaf, p, about)
                                                                             : tree_.holding(leaf, p, about);
    bool possible = false;
    bool known = true;
    for (std::size_t i = 0; i < count; ++i) {
      if (!can_be_halved(about[i])) continue;
      possible = true;
      known = known && (marked_[about[i].brick].load(std::memory_order_relaxed) & about[i].bit()) != 0;
    }
    if (!possible) {
      const SurfaceError here{error, std::max(error / tolerance_.inside, -error / tolerance_.outside), p};
      if (here.in_tolerances > worst.in_tolerances && matters()) worst = here;
      return false;
    }
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

  /// False where the triangle lies inside the body or another component.
  static bool bounds_the_body(const Vector3d& p, const Vector3d& center, double cell_edge, Sides& sides) {
    const Vector3d inward = center - p;
    const double length = inward.norm();
    const Vector3d beside = length > 0.0 ? Vector3d(p + inward * std::min(1.0, 0.5 * cell_edge / length)) : p;
    const double off = kStepOff * cell_edge;
    const Vector3d step = off * sides.normal;
    return (sides.distance(sides.above, beside + step, off) < 0.0) !=
           (sides.distance(sides.below, beside - step, off) < 0.0);
  }

  const SolidSurface& surface_;
  const BrickTree& tree_;
  const std::vector<bool>& barred_;
  const SurfaceTolerance tolerance_;
  const double slack_;
  std::vector<std::uint32_t>& compared_;
  std::vector<std::atomic<std::uint8_t>> marked_;   ///< octants to be halved, by brick
  std::vector<std::atomic<std::uint64_t>> exact_;   ///< cells to become exact, by brick
  std::vector<std::atomic<std::uint64_t>> smooth_;  ///< cells about which the surface does not turn, by brick
  std::set<Edge> rims_;                             ///< edges of shells, by their vertices
};

}  // namespace

Misses find_misses(const SolidSurface& surface, const BrickTree& tree, const std::vector<bool>& barred,
                   const SurfaceTolerance& tolerance, double slack, const std::vector<std::uint32_t>& triangles,
                   const parallel::Progress& progress, Compared* compared) {
  Compared nothing;
  return SurfaceCheck(surface, tree, barred, tolerance, slack, compared != nullptr ? *compared : nothing)
      .run(triangles, progress);
}

}  // namespace godobject::scene_compiler
