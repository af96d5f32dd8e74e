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
#include "toolchain/scene_compiler/field/surface_check.h"
#include "toolchain/scene_compiler/field/surface_facets.h"

namespace godobject::scene_compiler {
namespace {

constexpr double kSlack = 0.85;  // of the tolerance: between the points that are looked at it may be worse
constexpr double kFlat = 0.2;    // of the tolerance: height of a triangle that exact bricks leave out
/// Of the refined field before it is rounded; SceneView::open takes gradients up to 2 and what rounding adds.
constexpr double kSteepest = 1.95;
constexpr double kSteepestExact = 4.0;  // in exact bricks, between the distance to facets and interpolation

class Refinement {
 public:
  Refinement(DistanceGrid& field, const SolidSurface& surface, const SurfaceTolerance& tolerance, double slack)
      : field_(field),
        surface_(surface),
        tolerance_(tolerance),
        slack_(slack),
        facets_(surface, kFlat * tolerance.inside) {
    triangles_.resize(surface.mesh().triangles.size());
    std::iota(triangles_.begin(), triangles_.end(), 0u);
  }

  RefinementReport run(const parallel::Progress& progress) {
    const std::size_t positions = field_.bricks.size();
    BrickTree tree(field_, facets_);
    std::vector<bool> barred(positions);  // by brick number
    for (std::size_t i = 0; i < positions; ++i) {
      barred[i] = field_.beside_seam[i] && holds_seam(field_.bricks[i], field_.grid.voxel_size);
    }
    std::vector<std::uint32_t> triangles = triangles_;
    Compared compared;
    std::uint32_t sloped = 0;  // joins after which all slopes were measured
    while (true) {
      const bool whole = triangles.size() == triangles_.size();
      Misses misses =
          find_misses(surface_, tree, barred, tolerance_.times(kSlack), slack_, triangles, progress, &compared);
      if (misses.wanted.empty() && misses.exact.empty()) {
        if (!whole) {
          triangles = triangles_;  // halving a neighbour may have spoiled others
          continue;
        }
        Steep steep = find_steep(tree, barred, sloped);
        if (!steep.hopeless.empty()) {  // all slopes are measured again: others may be steep because of these
          for (const std::uint32_t root : steep.hopeless) barred[root] = true;
          tree.forget_about(steep.hopeless);
          tree.join();
          triangles = triangles_;
          continue;
        }
        sloped = tree.joins();
        if (steep.wanted.empty() && steep.refused.empty()) {
          misses.worst.in_tolerances *= kSlack;
          if (misses.worst.in_tolerances > 1.0) report_.worst = misses.worst;
          break;
        }
        for (const std::uint32_t brick : steep.refused) tree.refuse(brick);
        misses.wanted = std::move(steep.wanted);
        misses.triangles = triangles_;
      }

      for (const auto& [brick, cells] : misses.exact) tree.make_exact(brick, cells);
      halve(tree, misses.wanted, barred);
      tree.join();
      triangles = std::move(misses.triangles);
    }
    tree.round(slack_);
    field_.grid.facet_offset = slack_;
    tree.write(field_);
    report_.refined = field_.refined.size();
    report_.exact = field_.exact.size();
    report_.facets = field_.facets.size();
    report_.sets = field_.facet_sets.size();
    report_.numbers = field_.facet_numbers.size();
    report_.finer = field_.bricks.size() - positions;
    for (std::uint32_t b = 0; b < tree.brick_count(); ++b) {
      if (tree.whole(b) != 0) ++report_.bricks[static_cast<std::size_t>(tree.level(b))];
    }
    return report_;
  }

 private:
  /// Halves the wanted octants. Bars the bricks in which a seam would appear.
  void halve(BrickTree& tree, const Wanted& wanted, std::vector<bool>& barred) {
    if (tree.live_count() + 8 * wanted.size() > kMaxBricks) {
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

  /// Bricks whose slope is too steep, by what is to be done about them.
  struct Steep {
    Wanted wanted;                        ///< to be halved
    std::vector<std::uint32_t> refused;   ///< to be exact no longer
    std::vector<std::uint32_t> hopeless;  ///< roots of positions that no halving makes less steep
  };

  /// Finds the bricks whose slope is too steep: coarse values beside finer exact ones, or the transition to the
  /// distance to facets. Positions that no join after `sloped` changed are not steep.
  Steep find_steep(const BrickTree& tree, const std::vector<bool>& barred, std::uint32_t sloped) {
    std::vector<char> is_steep(tree.brick_count());
    parallel::for_each_index(tree.brick_count(), [&](std::size_t i) {
      const auto b = static_cast<std::uint32_t>(i);
      if (tree.whole(b) == 0 || (tree.level(b) == 0 && !tree.exact_brick(b))) return;
      if (sloped != 0 && tree.changed_in(tree.root(b)) <= sloped) return;
      FieldSlope slope(tree.cell_edge(tree.level(b)));
      tree.add_slope(b, slack_, kSteepestExact, slope);
      is_steep[i] = slope.largest_with_seams() > (tree.exact_brick(b) ? kSteepestExact : kSteepest) ? 1 : 0;
    });
    Steep steep;
    for (std::uint32_t b = 0; b < tree.brick_count(); ++b) {
      if (is_steep[b] == 0) continue;
      if (tree.exact_brick(b)) {
        steep.refused.push_back(b);
        continue;
      }
      bool found = false;
      for (const BrickTree::Leaf& leaf : tree.leaves_about(b)) {
        if (leaf.brick == BrickTree::kNone || leaf.level >= tree.level(b) || barred[leaf.brick]) continue;
        want(steep.wanted, leaf.brick, leaf.where().bit());
        found = true;
      }
      if (found) continue;
      steep.hopeless.push_back(tree.root(b));
    }
    return steep;
  }

  DistanceGrid& field_;
  const SolidSurface& surface_;
  const SurfaceTolerance tolerance_;
  double slack_;
  const SurfaceFacets facets_;
  std::vector<std::uint32_t> triangles_;         // all
  std::map<std::array<int, 4>, Octants> known_;  // of bricks that are halved or were, by place
  RefinementReport report_;
};

}  // namespace

RefinementReport refine(DistanceGrid& field, const SolidSurface& surface, const SurfaceTolerance& tolerance,
                        const parallel::Progress& progress, double slack) {
  return Refinement(field, surface, tolerance, slack).run(progress);
}

void round_distances(DistanceGrid& field) {
  const SurfaceFacets no_facets;
  BrickTree tree(field, no_facets);
  tree.round(0.0);
  tree.write(field);
}

}  // namespace godobject::scene_compiler
