#include "toolchain/scene_compiler/field/distance_grid.h"
#include "toolchain/scene_compiler/field/brick_packing.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/scene/voxelmap.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/field/brick_lattice.h"
#include "toolchain/scene_compiler/field/distance_transform.h"
#include "toolchain/scene_compiler/field/refinement.h"

namespace godobject::scene_compiler::distance_grid_test {
namespace {

using Eigen::Vector3d;

DistanceGrid rounded(DistanceGrid field) {
  round_distances(field);
  return field;
}

struct Field {
  DistanceGrid grid;
  std::vector<format::Brick> bricks;
  Voxelmap map;

  Field(const SolidSurface& surface, double voxel_size)
      : grid(rounded(make_distance_grid(surface, voxel_size, default_band(voxel_size, 1.5 * voxel_size), {}))),
        bricks(packed_bricks(grid)),
        map(grid.grid, grid.index, bricks, {}) {}
};

Field field_of(TriangleMesh mesh, double voxel_size, SurfaceKind kind = SurfaceKind::kAuto) {
  return Field(SolidSurface(std::move(mesh), kind, 2.0 * voxel_size), voxel_size);
}

/// No point of the ball may have a distance below lower_bound. The field is clipped at the band as `sample` does.
void expect_lower_bound_holds(const Field& field, int balls) {
  const format::Grid& g = field.grid.grid;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  int bounded = 0;
  for (int i = 0; i < balls; ++i) {
    Vector3d center;
    for (int axis = 0; axis < 3; ++axis) {
      const double length = g.bricks[axis] * format::kBrickCells * g.voxel_size;
      center[axis] = g.origin[axis] + (1.2 * unit(random) - 0.1) * length;
    }
    const double radius = std::pow(unit(random), 2.0) * 12.0 * g.voxel_size;
    const double bound = field.map.lower_bound(center, radius);
    if (bound < 0.0) continue;
    ++bounded;
    for (int k = 0; k < 60; ++k) {
      const Vector3d direction = Vector3d(normal(random), normal(random), normal(random)).normalized();
      const Vector3d x = center + radius * std::cbrt(unit(random)) * direction;
      ASSERT_GE(field.map.sample(x).distance, std::min(bound, g.band) - 1e-6 * g.voxel_size)
          << "ball " << i << " at " << center.transpose() << " radius " << radius;
    }
  }
  EXPECT_GT(bounded, balls / 20) << "the bound is of no use";
}

TEST(DistanceGrid, HoldsAHandComputedBox) {
  const Field field = field_of(box(Vector3d::Zero(), Vector3d::Constant(0.1)), 0.002);
  const double off = 0.5 * field.grid.grid.quantum + 1e-8;
  EXPECT_NEAR(field.map.sample({0.05, 0.05, 0.1031}).distance, 0.0031, off);
  EXPECT_NEAR(field.map.sample({0.05, 0.05, 0.0979}).distance, -0.0021, off);
  const FieldSample side = field.map.sample({0.1012, 0.04, 0.06});
  EXPECT_TRUE(side.known);
  EXPECT_NEAR(side.gradient.x(), 1.0, field.grid.grid.quantum / 0.002);
  EXPECT_FALSE(field.map.sample({0.05, 0.05, 0.05}).known);
  EXPECT_LT(field.map.sample({0.05, 0.05, 0.05}).distance, 0.0);
  EXPECT_GT(field.map.sample({0.2, 0.05, 0.05}).distance, 0.0);
  EXPECT_EQ(field.grid.seams.cells, 0u);
  EXPECT_NEAR(field.grid.grid.lipschitz, field.grid.grid.lipschitz_seam, 1e-3);
}

TEST(DistanceGrid, ThickensASheet) {
  const Field field = field_of(box({0, 0, -1}, {0.1, 0.1, 0}, {false, false, false, false, false, true}), 0.002);
  const double off = 0.5 * field.grid.grid.quantum + 1e-8;
  EXPECT_NEAR(field.map.sample({0.05, 0.05, 0.004}).distance, 0.002, off);
  EXPECT_NEAR(field.map.sample({0.05, 0.05, -0.004}).distance, 0.002, off);
  EXPECT_LT(field.map.sample({0.05, 0.05, 0.0}).distance, -0.0009);
}

TEST(DistanceGrid, BandCoversSafetyDistanceAndASubStep) {
  EXPECT_GE(default_band(0.002, 0.003), 0.006);
  EXPECT_GE(default_band(0.002, 0.010), 0.013);
}

TEST(DistanceGrid, LeavesFreeSpaceAllAround) {
  const Field field = field_of(load("bunny_npm", 0.0161497), 0.004);
  const format::Grid& g = field.grid.grid;
  for (int z = 0; z < g.bricks[2]; ++z) {
    for (int y = 0; y < g.bricks[1]; ++y) {
      for (int x = 0; x < g.bricks[0]; ++x) {
        if (x > 0 && y > 0 && z > 0 && x < g.bricks[0] - 1 && y < g.bricks[1] - 1 && z < g.bricks[2] - 1) continue;
        const std::uint32_t entry = field.grid.index[static_cast<std::size_t>(x + g.bricks[0] * (y + g.bricks[1] * z))];
        ASSERT_TRUE((entry & format::index_entry::kFar) != 0 && (entry & format::index_entry::kInside) == 0);
      }
    }
  }
}

TEST(DistanceGrid, StoresWhatIsNearAndEveryChangeOfSign) {
  const Field field = field_of(load("bunny_npm", 0.0161497), 0.002);
  for (const Brick& brick : field.grid.bricks) {
    float nearest = std::abs(brick.value[0]);
    bool changes = false;
    for (const float v : brick.value) {
      nearest = std::min(nearest, std::abs(v));
      changes = changes || (v < 0.0f) != (brick.value[0] < 0.0f);
    }
    ASSERT_TRUE(static_cast<double>(nearest) < field.grid.grid.band || changes);
  }
}

TEST(DistanceGrid, LipschitzConstantBoundsEveryGradient) {
  for (const char* name : {"bunny_npm", "hole_square"}) {
    const double scale = std::string(name) == "bunny_npm" ? 0.0161497 : 1.0;
    const Field field = field_of(load(name, scale), 0.004);
    const format::Grid& g = field.grid.grid;
    EXPECT_LE(g.lipschitz, 1.7322 + 1.7321 * g.quantum / g.voxel_size);
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double largest = 0.0;
    for (int i = 0; i < 300000; ++i) {
      Vector3d p;
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = g.origin[axis] + unit(random) * g.bricks[axis] * format::kBrickCells * g.voxel_size;
      largest = std::max(largest, field.map.sample(p).gradient.norm());
    }
    EXPECT_LE(largest, g.lipschitz) << name;
    EXPECT_GT(largest, 0.8 * g.lipschitz) << name << ": far too careful";
  }
}

TEST(DistanceGrid, LowerBoundHoldsForSealedSolids) {
  expect_lower_bound_holds(field_of(load("bunny_npm", 0.0161497), 0.004), 20000);
  expect_lower_bound_holds(field_of(box(Vector3d::Zero(), Vector3d::Constant(0.1)), 0.004), 20000);
}

TEST(DistanceGrid, LowerBoundHoldsBesideSeamsAndShells) {
  // a box without its lid, declared solid: the sign jumps across the opening
  const Field open = field_of(box(Vector3d::Zero(), Vector3d::Constant(0.1), {true, true, true, true, true, false}),
                              0.004, SurfaceKind::kSolid);
  EXPECT_GT(open.grid.seams.cells, 0u);
  EXPECT_GT(open.grid.seams.largest_jump, 0.02);
  EXPECT_GT(open.grid.grid.lipschitz_seam, open.grid.grid.lipschitz);
  expect_lower_bound_holds(open, 40000);
  expect_lower_bound_holds(field_of(load("teapot", 0.037), 0.003), 40000);
  expect_lower_bound_holds(field_of(load("sheet_open_2tri", 0.3), 0.004), 20000);
}

/// A box with a cavity, aligned and turned. The cavity and the wall above it are wide enough for positions far from all
/// triangles.
class FarDistances : public testing::TestWithParam<double> {};

TEST_P(FarDistances, AreBoundsWithTheirSign) {
  const Eigen::Matrix3d turn(Eigen::AngleAxisd(GetParam(), Vector3d(0.4, -0.5, 0.768).normalized()));
  const double h = 0.001;
  const Eigen::AlignedBox3d outer(Vector3d::Constant(-0.070), Vector3d(0.070, 0.070, 0.190));
  // aligned, the upper faces of the cavity lie hardly inside their bricks: the surface is nearly half a brick nearer
  // than the brick's centre
  const Eigen::AlignedBox3d cavity(Vector3d::Constant(-0.060), Vector3d::Constant(0.0587));
  TriangleMesh mesh = box(outer.min(), outer.max());
  const TriangleMesh hole = box(cavity.min(), cavity.max());
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), hole.vertices.begin(), hole.vertices.end());
  for (const auto& t : hole.triangles) mesh.triangles.push_back({t[0] + first, t[2] + first, t[1] + first});
  for (Vector3d& vertex : mesh.vertices) vertex = turn * vertex;
  const SolidSurface surface(std::move(mesh), SurfaceKind::kSolid, 2.0 * h);
  ASSERT_TRUE(surface.is_only_sealed_solids());
  const DistanceGrid grid = make_distance_grid(surface, h, default_band(h, 1.5 * h), {});
  BrickLattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis) lattice.size[axis] = grid.grid.bricks[axis];
  const Eigen::Map<const Vector3d> origin(grid.grid.origin);
  const double edge = format::kBrickCells * h;
  int far_inside = 0;
  int far_outside = 0;
  for (std::size_t i = 0; i < grid.index.size(); ++i) {
    if ((grid.index[i] & format::index_entry::kFar) == 0) continue;
    const BrickPosition p = lattice.position(i);
    const Vector3d at = origin + edge * Vector3d(p[0] + 0.5, p[1] + 0.5, p[2] + 0.5);
    const Vector3d in_box = turn.transpose() * at;
    const bool inside = outer.contains(in_box) && !cavity.contains(in_box);
    ASSERT_EQ((grid.index[i] & format::index_entry::kInside) != 0, inside) << at.transpose();
    const double distance = std::abs(surface.signed_distance(at));
    if (distance > 13.0 * edge) ++(inside ? far_inside : far_outside);
    if (inside) continue;
    ASSERT_LE(grid.far_clearance[i], distance) << at.transpose();
    ASSERT_GE(grid.far_clearance[i], (6.0 / 7.0) * distance - h) << at.transpose();
  }
  EXPECT_GT(far_inside, 20);
  EXPECT_GT(far_outside, 20);
}

INSTANTIATE_TEST_SUITE_P(Turned, FarDistances, testing::Values(0.0, 0.7));

TEST(DistanceGrid, RefusesAGridBeyondItsLimitAndNamesTheVoxel) {
  try {
    field_of(box(Vector3d::Zero(), Vector3d::Constant(100.0)), 1e-4);
    FAIL() << "took it";
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadData);
    EXPECT_NE(std::string(failure.what()).find("voxel_size"), std::string::npos);
  }
}

TEST(DistanceTransform, IsExact) {
  const BrickLattice lattice{{7, 9, 11}};
  std::vector<bool> set(lattice.count());
  std::mt19937_64 random(5);
  for (int i = 0; i < 6; ++i) set[random() % set.size()] = true;
  const std::vector<float> squared = squared_distance_transform(lattice, set);
  for (std::size_t i = 0; i < set.size(); ++i) {
    int best = 1 << 30;
    for (std::size_t j = 0; j < set.size(); ++j) {
      if (!set[j]) continue;
      int sum = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int d = lattice.position(i)[axis] - lattice.position(j)[axis];
        sum += d * d;
      }
      best = std::min(best, sum);
    }
    ASSERT_EQ(squared[i], static_cast<float>(best));
  }
}

}  // namespace
}  // namespace godobject::scene_compiler::distance_grid_test
