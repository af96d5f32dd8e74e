#include "toolchain/scene_compiler/trimming/touchable_points.h"
#include "toolchain/scene_compiler/field/brick_packing.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/scene/voxelmap.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/scene_compiler/field/refinement.h"
#include "toolchain/scene_compiler/points/sphere_tree.h"
#include "toolchain/scene_compiler/trimming/pruned_tree.h"

namespace godobject::scene_compiler::touchable_points_test {
namespace {

using Eigen::Vector3d;

/// A cube of 100 mm with a hollow in it.
SolidSurface hollow_cube(const Vector3d& low, const Vector3d& high) {
  return {joined(box(Vector3d::Constant(-0.05), Vector3d::Constant(0.05)), turned_inside_out(box(low, high))),
          SurfaceKind::kSolid, 0.0};
}

TEST(NotSealedOff, LeavesOutACavityBehindThickWalls) {
  const SolidSurface cube = hollow_cube({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01});
  ASSERT_GT(cube.signed_distance(Vector3d::Zero()), 0.0);
  const std::vector<Vector3d> points = {{0.05, 0.0, 0.0}, {0.05, 0.05, 0.05}, {0.01, 0.0, 0.0}, {0.01, -0.01, 0.01}};
  const std::vector<bool> sealed = {true, true, false, false};
  EXPECT_EQ(not_sealed_off(cube, points, 0.004, 0.1), sealed);
  const std::vector<bool> all(4, true);
  EXPECT_EQ(not_sealed_off(cube, points, 0.02, 0.1), all) << "walls of twice the depth do not hold";
  EXPECT_EQ(not_sealed_off(cube, points, 0.004, 0.02), all) << "the other body may have begun within";
}

TEST(NotSealedOff, LeavesACavityThatAThinWallClosesOrNone) {
  const std::vector<Vector3d> points = {{0.05, 0.0, 0.0}, {-0.01, 0.0, 0.0}};
  const std::vector<bool> all(2, true);
  EXPECT_EQ(not_sealed_off(hollow_cube({-0.01, -0.01, -0.01}, {0.045, 0.01, 0.01}), points, 0.004, 0.1), all);
  // open to the outside through a slot
  TriangleMesh slot = box({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}, {true, true, true, true, true, false});
  EXPECT_EQ(not_sealed_off(SolidSurface(slot, SurfaceKind::kSolid, 0.0), points, 0.004, 0.1), all);
  EXPECT_EQ(not_sealed_off(SolidSurface(box({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}), SurfaceKind::kSolid, 0.0),
                           points, 0.004, 0.1),
            all);
}

TEST(LeastPiece, IsTheLongestEdgeOfTheShortestPiece) {
  EXPECT_DOUBLE_EQ(least_piece(joined(box({0, 0, 0}, {1, 2, 3}), box({10, 10, 10}, {10.5, 10.25, 10.125}))), 0.5);
}

/// The field of a cube about the origin.
DistanceGrid cube_field(double half, double voxel_size) {
  const SolidSurface cube(box(Vector3d::Constant(-half), Vector3d::Constant(half)), SurfaceKind::kSolid, 0.0);
  DistanceGrid field = make_distance_grid(cube, voxel_size, default_band(voxel_size, 1.5 * voxel_size), {});
  round_distances(field);
  return field;
}

/// By brute force over poses: points that came below the band stay, and points that stay are not far from that.
TEST(WithinReach, KeepsWhatComesNearAndLittleMore) {
  constexpr double kVoxel = 0.004;
  const DistanceGrid field = cube_field(0.03, kVoxel);
  const std::vector<format::Brick> bricks = packed_bricks(field);
  const Voxelmap map(field.grid, field.index, bricks, field.refined, field.exact, field.facet_lists());
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };
  int left_out = 0;
  for (int scene = 0; scene < 40; ++scene) {
    format::Workspace workspace{};
    const Vector3 at = (0.04 + 0.1 * share(random)) * vector().normalized();
    for (int axis = 0; axis < 3; ++axis) {
      workspace.low[axis] = at[axis];
      workspace.high[axis] = at[axis] + 0.03 * share(random);
    }
    std::vector<Vector3d> points;
    for (int i = 0; i < 40; ++i) points.push_back(0.25 * share(random) * vector().normalized());
    const std::vector<bool> stays = within_reach_of_field(field, workspace, points);
    // the mirror image: the field moves, the points around it rest
    const std::vector<bool> features = within_reach_of_body(field, workspace, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      double least = field.grid.band;
      double least_of_feature = field.grid.band;
      for (int k = 0; k < 300; ++k) {
        Vector3 origin;
        for (int axis = 0; axis < 3; ++axis)
          origin[axis] = workspace.low[axis] + share(random) * (workspace.high[axis] - workspace.low[axis]);
        const Vector3 turned = points[i].norm() * vector().normalized();
        least = std::min(least, map.sample(origin + turned).distance);
        const double far = (points[i] - origin).norm();
        least_of_feature = std::min(least_of_feature, map.sample(far * vector().normalized()).distance);
      }
      ASSERT_TRUE(stays[i] || least == field.grid.band) << points[i].norm();
      ASSERT_TRUE(features[i] || least_of_feature == field.grid.band);
      if (!stays[i]) ++left_out;
    }
  }
  EXPECT_GT(left_out, 100);
}

TEST(PrunedTree, KeepsOrderBitsAndStructureWhateverGoes) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (int run = 0; run < 200; ++run) {
    const std::size_t n = 1 + random() % 300;
    std::vector<Eigen::Vector3f> points(n);
    for (Eigen::Vector3f& p : points) p = {normal(random), normal(random), normal(random)};
    std::vector<std::vector<std::uint32_t>> levels;
    for (std::size_t size = n;; size = size * 2 / 5) {
      std::vector<std::uint32_t> level;
      for (std::uint32_t i = 0; i < size; ++i) level.push_back(i);
      levels.insert(levels.begin(), level);
      if (size <= 4) break;
    }
    const SphereTree tree = build_sphere_tree(points, levels);
    std::vector<float> axes = by_axis(points, tree.order);
    std::vector<float> normals = run % 2 == 0 ? axes : std::vector<float>{};
    std::vector<format::Node> nodes = tree.nodes;
    std::vector<bool> stays(n);
    const double part = static_cast<double>(random() % 101) / 100.0;
    for (std::size_t i = 0; i < n; ++i) stays[i] = static_cast<double>(random() % 1000) < 1000.0 * part;
    stays[random() % n] = true;
    std::vector<Eigen::Vector3f> expected;
    for (std::size_t i = 0; i < n; ++i) {
      if (stays[i]) expected.push_back(points[tree.order[i]]);
    }
    format::Body header{};
    leave_out_points(stays, {axes, normals, nodes}, header);
    ASSERT_EQ(header.point_count, expected.size());
    ASSERT_EQ(header.node_count, nodes.size());
    ASSERT_LE(nodes.size(), 2 * expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_EQ(axes[axis * expected.size() + i], expected[i][static_cast<Eigen::Index>(axis)]);
    }
    ASSERT_EQ(normals.size(), run % 2 == 0 ? axes.size() : 0u);
    for (std::uint32_t k = 0; k < nodes.size(); ++k) {
      const format::Node& node = nodes[k];
      ASSERT_GT(node.point_count, 0u);
      ASSERT_LT(node.level, header.level_count);
      for (std::uint32_t i = node.first_point; i < node.first_point + node.point_count; ++i) {
        const Eigen::Vector3f center(node.center[0], node.center[1], node.center[2]);
        ASSERT_LE((expected[i] - center).cast<double>().norm(), node.radius * (1.0 + 1e-6));
      }
      std::uint32_t next = node.first_point;
      int children = 0;
      for (std::uint32_t child = k + 1; child < node.skip; child = nodes[child].skip, ++children) {
        ASSERT_EQ(nodes[child].first_point, next);
        ASSERT_EQ(nodes[child].level, node.level + 1);
        next += nodes[child].point_count;
      }
      ASSERT_EQ(node.leaf == 1, children == 0);
      ASSERT_NE(children, 1);
      if (children > 0) {
        ASSERT_EQ(next, node.first_point + node.point_count);
      }
    }
  }
}

}  // namespace
}  // namespace godobject::scene_compiler::touchable_points_test
