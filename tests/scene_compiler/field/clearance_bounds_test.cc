#include "toolchain/scene_compiler/field/clearance_bounds.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/scene/clearance_kernel.h"
#include "core/scene/voxelmap.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/scene_compiler/field/brick_packing.h"
#include "toolchain/scene_compiler/field/refinement.h"

namespace godobject::scene_compiler::clearance_bounds_test {
namespace {

using Eigen::Vector3d;

DistanceGrid field_of(const SolidSurface& surface, double s, bool refined) {
  DistanceGrid field = make_distance_grid(surface, s, default_band(s, 1.5 * s), {});
  if (refined) {
    refine(field, surface, SurfaceTolerance::of_depth(0.05 * s), {});
  } else {
    round_distances(field);
  }
  return field;
}

Voxelmap map_of(const DistanceGrid& field, const std::vector<format::Brick>& bricks) {
  return {field.grid, field.index, bricks, field.refined, field.exact, field.facet_lists()};
}

struct Body {
  std::string name;
  SurfaceKind kind;
  bool refined;
};

SolidSurface surface_of(const Body& body, double s) {
  TriangleMesh mesh = body.name == "open box"
                          ? box(Vector3d::Zero(), Vector3d::Constant(0.1), {true, true, true, true, true, false})
                          : load(body.name, 1.0);
  return SolidSurface(std::move(mesh), body.kind, 2.0 * s);
}

class ClearancesOf : public ::testing::TestWithParam<Body> {};

/// The contract of DistanceField: no surface within the clearance, and not much less clearance a little farther on.
TEST_P(ClearancesOf, HoldAroundEveryPoint) {
  const SolidSurface surface = surface_of(GetParam(), 0.004);
  const DistanceGrid field = field_of(surface, 0.004, GetParam().refined);
  const std::vector<format::Brick> bricks = packed_bricks(field);
  const Voxelmap map = map_of(field, bricks);
  const format::Grid& g = field.grid;
  const double slope = map.lipschitz();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  int free = 0;
  for (int i = 0; i < 40000; ++i) {
    Vector3d p;
    for (int axis = 0; axis < 3; ++axis) {
      const double length = g.bricks[axis] * format::kBrickCells * g.voxel_size;
      p[axis] = g.origin[axis] + (1.1 * unit(random) - 0.05) * length;
    }
    const double clearance = map.sample(p).clearance;
    if (clearance <= 0.0) continue;
    ++free;
    for (int k = 0; k < 30; ++k) {
      const Vector3d direction = Vector3d(normal(random), normal(random), normal(random)).normalized();
      const double way = clearance * unit(random);
      const FieldSample there = map.sample(p + way * direction);
      ASSERT_GT(there.distance, -1e-9) << p.transpose() << ", " << way << " of " << clearance;
      ASSERT_GE(there.clearance, std::min((clearance - way) / slope, map.assured_clearance()) - 1e-9)
          << p.transpose() << ", " << way << " of " << clearance;
    }
  }
  EXPECT_GT(free, 10000);
}

/// The same from places outside the grid, to places within.
TEST_P(ClearancesOf, HoldOutsideTheGrid) {
  const SolidSurface surface = surface_of(GetParam(), 0.004);
  const DistanceGrid field = field_of(surface, 0.004, GetParam().refined);
  const std::vector<format::Brick> bricks = packed_bricks(field);
  const Voxelmap map = map_of(field, bricks);
  const format::Grid& g = field.grid;
  const Vector3d low(g.origin[0], g.origin[1], g.origin[2]);
  const Vector3d size = format::kBrickCells * g.voxel_size * Vector3d(g.bricks[0], g.bricks[1], g.bricks[2]);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  const auto place = [&](double margin) {
    const Vector3d share(unit(random), unit(random), unit(random));
    return (low + ((1.0 + 2.0 * margin) * share - Vector3d::Constant(margin)).cwiseProduct(size)).eval();
  };
  int outside = 0;
  int close = 0;
  for (int i = 0; i < 400000; ++i) {
    const Vector3d x = place(0.0);
    const double at = map.sample(x).clearance;
    const Vector3d direction = Vector3d(normal(random), normal(random), normal(random)).normalized();
    const Vector3d p = i % 2 == 0 ? place(0.5) : Vector3d(x + unit(random) * size.maxCoeff() * direction);
    if (((p - low).array() >= 0.0).all() && ((low + size - p).array() > 0.0).all()) continue;
    ++outside;
    const double told = (map.sample(p).clearance - (p - x).norm()) / map.lipschitz();
    if (told > 0.5 * at) ++close;
    ASSERT_LE(std::min(told, map.assured_clearance()), at + 1e-9) << p.transpose() << " to " << x.transpose();
  }
  EXPECT_GT(outside, 50000);
  EXPECT_GT(close, 500) << "nothing that a wrong bound could break";
}

/// A box without a lid: at its rim bricks with the seam stick out of it.
TEST(ClearanceBounds, PayOutsideTheGridForSteepBricksThatStickOut) {
  const SolidSurface open(box(Vector3d::Zero(), Vector3d::Constant(0.1), {true, true, true, true, true, false}),
                          SurfaceKind::kSolid, 0.004);
  const DistanceGrid steep = field_of(open, 0.004, false);
  EXPECT_GT(steep.grid.outside_loss, 0.0);
  EXPECT_LT(steep.grid.outside_loss, 2.0 * std::sqrt(3.0) * format::kBrickCells * 0.004)
      << "bricks within the band's reach of the box";
  const SolidSurface closed(box(Vector3d::Zero(), Vector3d::Constant(0.1)), SurfaceKind::kSolid, 0.004);
  EXPECT_LT(field_of(closed, 0.004, false).grid.outside_loss, steep.grid.outside_loss) << "steep at its edges only";
}

INSTANTIATE_TEST_SUITE_P(Bodies, ClearancesOf,
                         ::testing::Values(Body{"open box", SurfaceKind::kSolid, false},
                                           Body{"open box", SurfaceKind::kSolid, true},
                                           Body{"bracket", SurfaceKind::kSolid, false},
                                           Body{"bracket", SurfaceKind::kSolid, true}),
                         [](const auto& body) {
                           std::string name = body.param.name + (body.param.refined ? "_refined" : "");
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

/// In far positions every kernel gives the results of single look-ups, to rounding.
TEST_P(ClearancesOf, AreToldByEveryKernel) {
  const SolidSurface surface = surface_of(GetParam(), 0.004);
  const DistanceGrid field = field_of(surface, 0.004, GetParam().refined);
  const std::vector<format::Brick> bricks = packed_bricks(field);
  const Voxelmap map = map_of(field, bricks);
  ASSERT_TRUE(map.in_batches());
  const format::Grid& g = field.grid;
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const detail::ClearanceKernel& kernel : detail::clearance_kernels()) {
    SCOPED_TRACE(kernel.name);
    int far = 0;
    for (int i = 0; i < 1000; ++i) {
      PointBatch batch;
      while (batch.count < PointBatch::kCapacity) {
        const std::size_t position = random() % field.index.size();
        if (batch.count % 4 == 0) {  // outside the grid
          batch.x[batch.count] = static_cast<float>(g.origin[0] - 0.1 * unit(random) - 1e-4);
          batch.y[batch.count] = static_cast<float>(g.origin[1] + 0.3 * unit(random) - 0.1);
          batch.z[batch.count++] = static_cast<float>(g.origin[2] + 0.3 * unit(random) - 0.1);
          continue;
        }
        if ((field.index[position] & format::index_entry::kFar) == 0) continue;
        const auto across = static_cast<std::size_t>(g.bricks[0]);
        const std::size_t rows = across * static_cast<std::size_t>(g.bricks[1]);
        const auto place = [&](int axis, std::size_t brick) {
          // not so near a brick's face that rounding may take it for the neighbour's
          const double bricks_in = static_cast<double>(brick) + 0.001 + 0.998 * unit(random);
          return static_cast<float>(g.origin[axis] + bricks_in * format::kBrickCells * g.voxel_size);
        };
        batch.x[batch.count] = place(0, position % across);
        batch.y[batch.count] = place(1, position % rows / across);
        batch.z[batch.count++] = place(2, position / rows);
      }
      kernel.look_up(map.in_cells(Pose{}), batch.x, batch.y, batch.z, batch.clearance, batch.count);
      for (std::uint32_t k = 0; k < batch.count; ++k) {
        const Vector3d p = Eigen::Vector3f(batch.x[k], batch.y[k], batch.z[k]).cast<double>();
        const FieldSample single = map.sample(p);
        if (single.distance < 0.0) continue;
        if (single.clearance > map.assured_clearance()) ++far;
        const auto told = static_cast<double>(batch.clearance[k]);
        ASSERT_LE(told, single.clearance) << p.transpose();
        ASSERT_GE(told, single.clearance - 2e-3 * g.voxel_size) << p.transpose();
      }
    }
    EXPECT_GT(far, 10000);
  }
}

/// A seam jumps by many voxels. Places far from it must not lose clearance.
TEST(ClearanceBounds, LeaveASeamToThoseAboutIt) {
  const SolidSurface surface(box(Vector3d::Zero(), Vector3d::Constant(0.1), {true, true, true, true, true, false}),
                             SurfaceKind::kSolid, 0.004);
  const DistanceGrid field = field_of(surface, 0.002, false);
  const std::vector<format::Brick> bricks = packed_bricks(field);
  const Voxelmap map = map_of(field, bricks);
  EXPECT_GT(field.grid.lipschitz_seam, 3.0);
  EXPECT_GT(map.sample({0.05, 0.05, -0.003}).clearance, 0.003 / 1.5) << "under the closed side";
  const double beside_seam = map.sample({0.05, 0.05, 0.103}).clearance;
  EXPECT_LE(beside_seam, 0.003);
}

/// Bounding twice gives the same: nothing is lost if the field is changed and bounded again.
TEST(ClearanceBounds, AreThoseOfTheFieldAsItIs) {
  const SolidSurface surface(box(Vector3d::Zero(), Vector3d::Constant(0.1), {true, true, true, true, true, false}),
                             SurfaceKind::kSolid, 0.008);
  DistanceGrid field = field_of(surface, 0.004, true);
  const DistanceGrid once = field;
  bound_clearances(field);
  EXPECT_EQ(field.index, once.index);
  for (std::size_t i = 0; i < field.bricks.size(); ++i) ASSERT_EQ(field.bricks[i].lipschitz, once.bricks[i].lipschitz);
}

}  // namespace
}  // namespace godobject::scene_compiler::clearance_bounds_test
