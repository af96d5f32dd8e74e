#include "toolchain/scene_compiler/field/refinement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/field/brick_tree.h"
#include "toolchain/scene_compiler/field/clearance_bounds.h"
#include "toolchain/scene_compiler/field/field_slope.h"
#include "toolchain/scene_compiler/field/octant_nodes.h"
#include "toolchain/scene_compiler/field/straight_edges.h"
#include "toolchain/scene_compiler/field/surface_check.h"

namespace godobject::scene_compiler {
namespace {

constexpr double kSlack = 0.85;  // of the tolerance: between the points that are looked at it may be worse
/// Of the refined field before it is rounded; SceneView::open takes gradients up to 2 and what rounding adds.
constexpr double kSteepest = 1.95;
constexpr double kWidestTube = 2.4;  // about a straight edge, in voxels

class Refinement {
 public:
  Refinement(DistanceGrid& field, const SolidSurface& surface, const SurfaceTolerance& tolerance, double slack,
             const parallel::Progress& progress)
      : field_(field), surface_(surface), tolerance_(tolerance), slack_(slack), barred_(field.bricks.size()) {
    for (std::size_t i = 0; i < field.bricks.size(); ++i) {
      barred_[i] = field.beside_seam[i] && holds_seam(field.bricks[i], field.grid.voxel_size);
    }
    triangles_.resize(surface.mesh().triangles.size());
    std::iota(triangles_.begin(), triangles_.end(), 0u);
    find_edges(progress);
  }

  /// Refines the field. False if a position had to be barred or an edge left out: then start again without it.
  bool run(const parallel::Progress& progress) {
    BrickTree tree(field_, edges_);
    std::vector<bool> barred = barred_;
    if (!part_edges(tree, barred)) return false;
    std::vector<std::uint32_t> triangles = triangles_;
    Compared compared;
    std::uint32_t sloped = 0;  // joins after which all slopes were measured
    while (true) {
      const bool whole = triangles.size() == triangles_.size();
      Misses misses =
          find_misses(surface_, tree, barred, tolerance_.times(kSlack), slack_, triangles, progress, &compared);
      Wanted wanted = std::move(misses.wanted);
      if (wanted.empty() && !whole) {
        triangles = triangles_;  // halving a neighbour may have spoiled others
        continue;
      }
      if (wanted.empty()) {
        if (!beside_steep(tree, barred, sloped, wanted)) return false;
        sloped = tree.joins();
        if (wanted.empty()) {
          misses.worst.in_tolerances *= kSlack;
          if (misses.worst.in_tolerances > 1.0) report_.worst = misses.worst;
          break;
        }
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
  /// Finds the straight edges whose tubes meet a brick in which the surface would be missed without them.
  void find_edges(const parallel::Progress& progress) {
    const format::Grid& grid = field_.grid;
    // the tubes must lie within the stored band, less the error of interpolation
    const double room = grid.band - kInterpolationError * grid.voxel_size;
    const auto all = straight_edges(surface_, grid.voxel_size, std::min(kWidestTube * grid.voxel_size, room));
    if (all.empty()) return;
    const BrickTree unrefined(field_, all);
    const std::vector<format::Edge> none;
    const BrickTree without(field_, none);
    std::vector<bool> needed(all.size());
    const Misses misses =
        find_misses(surface_, without, barred_, tolerance_.times(kSlack), slack_, triangles_, progress);
    for (const auto& [b, octants] : misses.wanted) {
      for (const std::uint32_t e : unrefined.edges_of(b)) needed[e] = true;
    }
    for (std::size_t e = 0; e < all.size(); ++e) {
      if (needed[e]) edges_.push_back(all[e]);
    }
  }

  /// Halves bricks until none names two edges. False if an edge had to be left out: then start again without it.
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

  /// Removes the left-out edges. True if there was any.
  bool drop(const std::vector<bool>& left_out) {
    std::vector<format::Edge> remaining;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (!left_out[e]) remaining.push_back(edges_[e]);
    }
    const bool any = remaining.size() < edges_.size();
    edges_ = std::move(remaining);
    return any;
  }

  /// Halves the wanted octants. Bars the bricks in which a seam would appear.
  void halve(BrickTree& tree, const Wanted& wanted, std::vector<bool>& barred) {
    if (tree.brick_count() + 8 * wanted.size() > kMaxBricks) {
      throw command::Failure(command::ExitCode::kBadData,
                             fmt::format("a surface within {:g} m needs more bricks than the limit of {}; take a "
                                         "larger field_tolerance or accuracy, or a larger voxel_size",
                                         tolerance_.inside, kMaxBricks));
    }
    std::vector<std::pair<std::uint32_t, Octants*>> unknown;
    for (const auto& [brick, octants] : wanted) {
      if (barred[brick]) continue;
      const auto [found, fresh] = known_.try_emplace(tree.place(brick));
      if (fresh) unknown.emplace_back(brick, &found->second);
    }
    parallel::for_each_index(
        unknown.size(), [&](std::size_t i) { *unknown[i].second = measure_octants(surface_, tree, unknown[i].first); });
    for (const auto& [brick, octants] : wanted) {
      if (barred[brick]) continue;
      const Octants& finer = known_.at(tree.place(brick));
      if (finer.seamed) {
        barred[brick] = true;
        tree.touch(brick);
      } else {
        tree.halve(brick, octants, finer.bricks);
      }
    }
    barred.resize(tree.brick_count());
  }

  /// Adds the bricks that must be halved because their slope is too steep: coarse values beside finer exact ones, or
  /// the transition to an edge's exact distance. False if one cannot be halved. Then its whole position is barred, or
  /// its edge left out. Positions that no join after `sloped` changed are not steep.
  bool beside_steep(const BrickTree& tree, const std::vector<bool>& barred, std::uint32_t sloped, Wanted& wanted) {
    bool possible = true;
    std::vector<bool> left_out(edges_.size());
    std::vector<char> steep(tree.brick_count());
    parallel::for_each_index(tree.brick_count(), [&](std::size_t i) {
      const auto b = static_cast<std::uint32_t>(i);
      if (tree.whole(b) == 0 || (tree.level(b) == 0 && tree.edges_of(b).empty())) return;
      if (sloped != 0 && tree.changed_in(tree.root(b)) <= sloped) return;
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
  const SurfaceTolerance tolerance_;
  double slack_;
  std::vector<std::uint32_t> triangles_;         // all
  std::vector<format::Edge> edges_;              // in use
  std::vector<bool> barred_;                     // positions, by brick number
  std::map<std::array<int, 4>, Octants> known_;  // of bricks that were halved before a restart, by place
  RefinementReport report_;
};

}  // namespace

RefinementReport refine(DistanceGrid& field, const SolidSurface& surface, const SurfaceTolerance& tolerance,
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
