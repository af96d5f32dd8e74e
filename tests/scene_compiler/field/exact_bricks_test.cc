#include "toolchain/scene_compiler/field/exact_bricks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/scene/facets.h"
#include "core/scene/voxelmap.h"
#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"
#include "tests/support/random.h"
#include "toolchain/scene_compiler/field/brick_packing.h"
#include "toolchain/scene_compiler/field/brick_tree.h"
#include "toolchain/scene_compiler/field/facet_sets.h"
#include "toolchain/scene_compiler/field/octant_nodes.h"
#include "toolchain/scene_compiler/field/refinement.h"

namespace godobject::scene_compiler::exact_bricks_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kVoxel = 0.002;

DistanceGrid refined(const SolidSurface& surface, double slack = 0.0) {
  DistanceGrid grid = make_distance_grid(surface, kVoxel, default_band(kVoxel, 1.5 * kVoxel), {});
  refine(grid, surface, SurfaceTolerance{0.05 * kVoxel, 0.05 * kVoxel}, {}, slack);
  return grid;
}

Isometry3d any_motion(test::Random& random, double way) {
  Isometry3d motion = Isometry3d::Identity();
  motion.rotate(Eigen::AngleAxisd(3.0 * random.between(-1.0, 1.0), random.direction()));
  motion.pretranslate(way * random.in_cube(1.0));
  return motion;
}

/// The cells of exact bricks that are looked up.
class ExactCells {
 public:
  using Visit = std::function<void(std::uint32_t set, const Vector3d& low, double edge)>;

  ExactCells(const DistanceGrid& field, const Visit& visit) : field_(field), visit_(visit) {
    const auto nx = static_cast<std::size_t>(field.grid.bricks[0]), ny = static_cast<std::size_t>(field.grid.bricks[1]);
    const Vector3d origin(field.grid.origin[0], field.grid.origin[1], field.grid.origin[2]);
    for (std::size_t i = 0; i < field.index.size(); ++i) {
      const auto at = [](std::size_t n) { return static_cast<double>(4 * n); };
      walk(field.index[i], origin + kVoxel * Vector3d(at(i % nx), at(i / nx % ny), at(i / nx / ny)), kVoxel);
    }
  }

 private:
  void walk(std::uint32_t entry, const Vector3d& low, double edge) {
    if ((entry & format::index_entry::kFar) != 0) return;
    const std::uint32_t number = entry & format::index_entry::kNumber;
    if ((entry & format::index_entry::kRefined) == 0) return visit_brick(number, low, edge, 0xff);
    const format::Refined& refined = field_.refined[number];
    unsigned coarse = 0;
    for (unsigned octant = 0; octant < 8; ++octant) {
      if ((refined.child[octant] & format::index_entry::kCoarse) != 0) {
        coarse |= 1u << octant;
      } else {
        walk(refined.child[octant], low + 2.0 * edge * Vector3d(octant & 1, octant >> 1 & 1, octant >> 2), 0.5 * edge);
      }
    }
    if (coarse != 0) visit_brick(refined.brick, low, edge, coarse);
  }

  void visit_brick(std::uint32_t number, const Vector3d& low, double edge, unsigned octants) {
    if (field_.bricks[number].exact == 0) return;
    const format::ExactBrick& exact = field_.exact[field_.bricks[number].exact - 1];
    for (int cell = 0; cell < format::kCellsPerBrick; ++cell) {
      const int x = cell % 4, y = cell / 4 % 4, z = cell / 16;
      const std::uint32_t word = exact.cell[cell];
      if ((octants >> (x / 2 + 2 * (y / 2) + 4 * (z / 2)) & 1) == 0 || word == 0) continue;
      visit_((word & format::cell_facets::kSet) - 1, low + edge * Vector3d(x, y, z), edge);
    }
  }

  const DistanceGrid& field_;
  const Visit& visit_;
};

/// In every cell of an exact brick the look-up of its set is the mesh's distance, on both sides of the surface. Returns
/// the number of cells whose set has planes.
int expect_distances_of_mesh(const DistanceGrid& field, const SolidSurface& surface) {
  const FacetLists lists = field.facet_lists();
  int with_planes = 0, wrong = 0;
  const ExactCells::Visit judge = [&](std::uint32_t set, const Vector3d& low, double edge) {
    with_planes += lists.sets[set].plane_count > 0 ? 1 : 0;
    for (int k = 0; k < 27; ++k) {
      const Vector3d p = low + edge * Vector3d(k % 3, k / 3 % 3, k / 9) / 2.0;
      const double truth = surface.signed_distance(p);
      if (std::abs(facet_distance(lists, set, p).value - truth) <= 0.012 * kVoxel) continue;
      if (++wrong > 3) continue;
      ADD_FAILURE() << facet_distance(lists, set, p).value << " instead of " << truth << " at " << p.transpose();
    }
  };
  const ExactCells cells(field, judge);
  EXPECT_EQ(wrong, 0);
  return with_planes;
}

TEST(ExactBricks, HaveTheMeshsDistanceInTheirCells) {
  test::Random random(1);
  for (const TriangleMesh& mesh :
       {test::box_mesh({0.03, 0.02, 0.015}), hollow_block({0.03, 0.028, 0.026}, {0.0101, 0.0083, 0.0067}),
        load("bracket", 0.5)}) {
    const SolidSurface surface(test::moved(mesh, any_motion(random, kVoxel)), SurfaceKind::kSolid, 2.0 * kVoxel);
    const DistanceGrid field = refined(surface);
    EXPECT_GT(field.exact.size(), 20u);
    expect_distances_of_mesh(field, surface);
  }
}

/// A plate and a block near it, both turned anyhow: facets of the one just beyond what bounds the other's free space.
TEST(ExactBricks, HaveTheMeshsDistanceBetweenTwoBodies) {
  test::Random random(7);
  int with_planes = 0;
  for (int i = 0; i < 40; ++i) {
    const TriangleMesh plate = test::box_mesh({0.03, 0.03, 0.01}, {-0.015, -0.015, -0.01});
    Isometry3d of_block = any_motion(random, 0.0);
    of_block.pretranslate(Vector3d(0.005 * random.between(-1.0, 1.0), 0.005 * random.between(-1.0, 1.0),
                                   0.0095 + 0.0015 * random.between(-1.0, 1.0)));
    const TriangleMesh both = test::joined(plate, test::moved(test::box_mesh({0.01, 0.012, 0.009}), of_block));
    const SolidSurface surface(test::moved(both, any_motion(random, kVoxel)), SurfaceKind::kSolid, 2.0 * kVoxel);
    with_planes += expect_distances_of_mesh(refined(surface), surface);
  }
  EXPECT_GT(with_planes, 100);
}

/// Draws batches of chords of up to a voxel from points near an edge of the mesh, or near another place of it. Where a
/// kernel calls one free, the distance is positive all along it; all look-ups equal `sample`. Returns the number of
/// free chords that the balls about their ends do not cover, of each kernel.
int free_chords_about(const TriangleMesh& mesh, double slack, test::Random& random) {
  const SolidSurface surface(mesh, SurfaceKind::kSolid, 2.0 * kVoxel);
  const DistanceGrid grid = refined(surface, slack);
  const std::vector<format::Brick> bricks = packed_bricks(grid);
  const Voxelmap map(grid.grid, grid.index, bricks, grid.refined, grid.exact, grid.facet_lists());
  int proved = 0;
  for (int i = 0; i < 600; ++i) {
    SampleBatch batch{};
    batch.count = static_cast<std::uint32_t>(random.integer(1, SampleBatch::kCapacity));
    Pose H0;
    H0.translation = 0.002 * random.in_cube(1.0);
    Pose H1 = H0;
    H1.rotation = exp_rotation(0.02 * random.in_cube(1.0));
    H1.translation += kVoxel * random.in_cube(1.0);
    for (std::uint32_t k = 0; k < batch.count; ++k) {
      const auto& triangle =
          mesh.triangles[static_cast<std::size_t>(random.integer(0, static_cast<int>(mesh.triangles.size()) - 1))];
      const Vector3d& a = mesh.vertices[triangle[0]];
      const Vector3d on_edge = a + random.between(0.0, 1.0) * (mesh.vertices[triangle[1]] - a);
      const Vector3d inner = on_edge + random.between(0.0, 0.7) * (mesh.vertices[triangle[2]] - on_edge);
      const Vector3d at = (i % 2 == 0 ? on_edge : inner) + 0.7 * kVoxel * random.in_cube(1.0);
      const Eigen::Vector3f p = (H0.inverse() * at).cast<float>();
      batch.x[k] = p.x(), batch.y[k] = p.y(), batch.z[k] = p.z();
      batch.from_clearance[k] = map.sample(H0 * p.cast<double>()).clearance;
    }
    for (const detail::SampleKernel& kernel : detail::sample_kernels()) {
      map.samples_by(&kernel, H1, batch);
      const std::uint64_t free = map.free_chords_by(&kernel, H0, H1, batch);
      for (std::uint32_t k = 0; k < batch.count; ++k) {
        const FieldSample one = map.sample(stored_position(batch, k));
        const FieldSample of_batch = stored_sample(batch, k);
        EXPECT_EQ(of_batch.known, one.known);
        EXPECT_EQ(of_batch.distance, one.distance);
        EXPECT_EQ(of_batch.clearance, one.clearance);
        EXPECT_EQ(of_batch.gradient, one.gradient);
        if ((free >> k & 1) == 0) continue;
        const Vector3d from = H0 * Vector3d(batch.x[k], batch.y[k], batch.z[k]);
        const Vector3d way = stored_position(batch, k) - from;
        if (batch.from_clearance[k] + batch.clearance[k] < way.norm()) ++proved;
        for (int step = 0; step <= 40; ++step) {
          const Vector3d q = from + step / 40.0 * way;
          EXPECT_GT(map.sample(q).distance, 0.0) << q.transpose() << " on the chord from " << from.transpose();
        }
        if (testing::Test::HasFailure()) return proved;
      }
    }
  }
  return proved;
}

/// The teeth of a comb are half a voxel thick and as far apart.
TriangleMesh comb() {
  TriangleMesh comb = test::box_mesh({0.02, 0.01, 0.003});
  for (int tooth = 0; tooth < 8; ++tooth) {
    comb = test::joined(std::move(comb),
                        test::box_mesh({0.5 * kVoxel, 0.01, 0.004}, {(tooth - 4.0) * kVoxel, -0.005, 0.0017}));
  }
  return comb;
}

TEST(ExactBricks, AreMetByNoFreeChord) {
  struct Row {
    const char* name;
    TriangleMesh mesh;
  };
  const Vector3d box(0.02, 0.02, 0.006);
  const auto nested = [&box](double gap) {
    return test::joined(test::box_mesh(box), test::box_mesh(box - Vector3d::Constant(2.0 * gap)));
  };
  const Row rows[] = {{"convex edges", test::box_mesh({0.03, 0.02, 0.015})},
                      {"concave edges", hollow_block({0.03, 0.028, 0.026}, {0.0101, 0.0083, 0.0067})},
                      {"both", load("bracket", 0.5)},
                      {"a plate", test::box_mesh({0.02, 0.02, 0.3 * kVoxel})},
                      {"a comb", comb()},
                      {"a box in a box, 0.002 voxels apart", nested(0.002 * kVoxel)},
                      {"0.02 voxels apart", nested(0.02 * kVoxel)},
                      {"0.2 voxels apart", nested(0.2 * kVoxel)}};
  test::Random random(5);
  for (const Row& row : rows) {
    for (const double slack : {0.0, 0.03 * kVoxel}) {
      SCOPED_TRACE(row.name);
      const int proved = free_chords_about(test::moved(row.mesh, any_motion(random, kVoxel)), slack, random);
      ASSERT_FALSE(HasFailure());
      if (!detail::sample_kernels().empty()) {
        EXPECT_GT(proved, 300);
      }
    }
  }
}

/// A brick refuses whose weights come from a leaf that has them from a still coarser one.
TEST(ExactBricks, SettleWhenABrickRefusesBesideCoarserOnes) {
  const SolidSurface surface(test::moved(test::box_mesh({0.06, 0.05, 0.07}), test::odd_motion()), SurfaceKind::kSolid,
                             2.0 * kVoxel);
  const DistanceGrid field = make_distance_grid(surface, kVoxel, default_band(kVoxel, 1.5 * kVoxel), {});
  const SurfaceFacets facets(surface, 0.0);
  constexpr int kUnits = BrickTree::kUnits;
  int settled = 0;
  for (int position = 0; position < static_cast<int>(field.index.size()) && settled < 20; ++position) {
    const int nx = field.grid.bricks[0], ny = field.grid.bricks[1];
    if ((field.index[static_cast<std::size_t>(position)] & format::index_entry::kFar) != 0) continue;
    const int low[3] = {4 * (position % nx), 4 * (position / nx % ny), 4 * (position / nx / ny)};
    BrickTree tree(field, facets);
    const auto leaf_at = [&](double x, double y, double z) {
      const double voxels[3] = {x, y, z};
      BrickTree::Units units;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        units[axis] = kUnits * low[axis] + static_cast<int>(std::floor(voxels[axis] * kUnits));
      }
      return tree.find(units);
    };
    if (leaf_at(-0.5, 0.5, 1.5).brick == BrickTree::kNone) continue;
    for (int level = 0; level < 4; ++level) {
      const BrickTree::Leaf leaf = leaf_at(0.3, 1.1, 1.1);
      tree.halve(leaf.brick, leaf.where().bit(), measure_octants(surface, tree, leaf.brick).bricks);
    }
    const BrickTree::Leaf finest = leaf_at(0.3, 1.1, 1.1);
    const BrickTree::Leaf beside = leaf_at(-0.5, 0.5, 1.5);
    if (finest.level != 4 || beside.level != 0) continue;
    const Vector3d in_cell = tree.low(beside.brick) + kVoxel * Vector3d(3.5, 1.5, 1.5);
    tree.make_exact(beside.brick, std::uint64_t{1} << tree.cell_of(beside, in_cell));
    tree.join();
    if (!tree.exact_brick(finest.brick)) continue;
    tree.refuse(finest.brick);
    tree.join();
    EXPECT_FALSE(tree.exact_brick(finest.brick));
    ++settled;
  }
  EXPECT_EQ(settled, 20);
}

/// A tree whose positions are halved twice and made exact, all that can be.
class HalvedTree {
 public:
  HalvedTree() {
    const std::uint32_t roots = tree.brick_count();
    for (std::uint32_t first = 0, end = roots; end < roots * 20; end = tree.brick_count()) {
      for (std::uint32_t b = first; b < end; ++b) tree.halve(b, 0x5a, measure_octants(surface_, tree, b).bricks);
      first = end;
    }
    for (std::uint32_t b = 0; b < tree.brick_count(); ++b) tree.make_exact(b, ~std::uint64_t{0});
    tree.join();
  }

  int exact_count() const {
    int count = 0;
    for (std::uint32_t b = 0; b < tree.brick_count(); ++b) count += tree.exact_brick(b) ? 1 : 0;
    return count;
  }

 private:
  const SolidSurface surface_{test::moved(test::box_mesh({0.03, 0.02, 0.025}), test::odd_motion()), SurfaceKind::kSolid,
                              2.0 * kVoxel};
  const SurfaceFacets facets_{surface_, 0.0};

 public:
  const DistanceGrid field = make_distance_grid(surface_, kVoxel, default_band(kVoxel, 1.5 * kVoxel), {});
  BrickTree tree{field, facets_};
};

TEST(BrickTree, IsAsAtTheStartOnceAllIsForgotten) {
  HalvedTree halved;
  BrickTree& tree = halved.tree;
  ASSERT_GT(halved.exact_count(), 100);
  ASSERT_GT(tree.live_count(), 4 * halved.field.bricks.size());
  std::vector<std::uint32_t> roots(halved.field.bricks.size());
  std::iota(roots.begin(), roots.end(), 0u);
  for (int again = 0; again < 2; ++again) {
    tree.forget_about(roots);
    tree.join();
    EXPECT_EQ(tree.live_count(), halved.field.bricks.size());
    EXPECT_EQ(halved.exact_count(), 0);
  }
  const HalvedTree other;
  const SurfaceFacets no_facets;
  BrickTree fresh(other.field, no_facets);
  DistanceGrid written = halved.field;
  DistanceGrid expected = other.field;
  tree.round(0.0);
  tree.write(written);
  fresh.round(0.0);
  fresh.write(expected);
  EXPECT_TRUE(written.refined.empty());
  EXPECT_TRUE(written.exact.empty());
  EXPECT_EQ(written.index, expected.index);
  EXPECT_EQ(written.grid.quantum, expected.grid.quantum);
  ASSERT_EQ(written.bricks.size(), expected.bricks.size());
  for (std::size_t b = 0; b < written.bricks.size(); ++b) {
    ASSERT_TRUE(std::ranges::equal(written.bricks[b].value, expected.bricks[b].value)) << b;
  }
}

/// Positions up to two away are forgotten, and can be halved again; those beyond keep what they have.
TEST(BrickTree, ForgetsTwoPositionsAboutARoot) {
  HalvedTree halved;
  BrickTree& tree = halved.tree;
  const std::uint32_t roots = static_cast<std::uint32_t>(halved.field.bricks.size());
  const std::uint32_t forgotten = roots / 2;
  tree.forget_about({forgotten});
  tree.join();
  int kept = 0;
  int whole = 0;
  for (std::uint32_t b = 0; b < roots; ++b) {
    const double positions = (tree.low(b) - tree.low(forgotten)).cwiseAbs().maxCoeff() / (4.0 * kVoxel);
    const bool is_whole = tree.whole(b) == 0xff;
    EXPECT_EQ(is_whole, positions < 2.5) << b;
    ++(is_whole ? whole : kept);
  }
  EXPECT_GT(kept, 10);
  EXPECT_GT(whole, 10);
  const std::uint32_t live = tree.live_count();
  tree.halve(forgotten, 0x01, {});
  tree.join();
  EXPECT_EQ(tree.live_count(), live + 1);
}

TEST(FacetSets, AreStoredOnce) {
  FacetSets sets;
  EXPECT_EQ(sets.number_of({{3, 5, 8}, 0}), 0u);
  EXPECT_EQ(sets.number_of({{3, 5, 8}, 1}), 1u) << "another first part";
  EXPECT_EQ(sets.number_of({{3, 5}, 0}), 2u);
  EXPECT_EQ(sets.number_of({{3, 5, 8}, 0}), 0u);
  EXPECT_EQ(sets.number_of({{3, 5, 8}, 1}), 1u);
  ASSERT_EQ(sets.sets().size(), 3u);
  EXPECT_EQ(sets.numbers(), (std::vector<std::uint32_t>{3, 5, 8, 3, 5, 8, 3, 5}));
  EXPECT_EQ(sets.sets()[1].first, 3u);
  EXPECT_EQ(sets.sets()[1].count, 3);
  EXPECT_EQ(sets.sets()[1].plane_count, 1);
  EXPECT_EQ(sets.sets()[2].first, 6u);
}

}  // namespace
}  // namespace godobject::scene_compiler::exact_bricks_test
