#include "toolchain/scene_compiler/mesh/near_triangles.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/scene_compiler/simple_meshes.h"

namespace godobject::scene_compiler::near_triangles_test {
namespace {

using Eigen::Vector3d;

TriangleTree tree_over(const TriangleMesh& mesh) {
  std::vector<TriangleTree::Triangle> triangles;
  for (const auto& t : mesh.triangles) {
    triangles.push_back(
        {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], static_cast<std::uint32_t>(triangles.size())});
  }
  return TriangleTree(std::move(triangles));
}

/// Triangles of all sizes and shapes anywhere, some without area.
TriangleMesh random_triangles(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  const auto any = [&] { return Vector3d(place(random), place(random), place(random)); };
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const double size = std::pow(10.0, -2.0 - 2.0 * place(random));
    const Vector3d at = any();
    mesh.vertices.insert(mesh.vertices.end(), {at, at + size * any(), i % 7 == 0 ? at : Vector3d(at + size * any())});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

/// In any ball, and in balls within it, the distances must be those of a search, to the bit.
void expect_as_searched(const TriangleMesh& mesh, std::mt19937& random) {
  const TriangleTree tree = tree_over(mesh);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  const auto any = [&] { return Vector3d(place(random), place(random), place(random)); };
  const auto in_ball = [&](const Vector3d& center, double radius) -> Vector3d {
    return center + radius * std::abs(place(random)) * any().normalized();
  };
  const auto expect_same = [&](const NearTriangles& near, const Vector3d& p) {
    TriangleTree::Nearest nearest{};
    ASSERT_TRUE(tree.nearest(p, std::numeric_limits<double>::infinity(), nearest));
    EXPECT_EQ(near.distance(p), std::sqrt(nearest.squared_distance));
  };
  for (int i = 0; i < 60; ++i) {
    const Vector3d center = 1.5 * any();
    const double radius = std::pow(10.0, -1.5 + 1.5 * place(random));
    const NearTriangles near(tree, center, radius);
    const double part = std::abs(place(random));
    const Vector3d aside = in_ball(center, (1.0 - part) * radius);
    const NearTriangles nearer(near, aside, part * radius);
    EXPECT_LE(nearer.size(), near.size());
    for (int k = 0; k < 20; ++k) {
      expect_same(near, in_ball(center, radius));
      expect_same(nearer, in_ball(aside, part * radius));
    }
  }
}

TEST(NearTriangles, GiveTheDistancesOfASearch) {
  std::mt19937 random(4);
  for (int i = 0; i < 5; ++i) expect_as_searched(random_triangles(random), random);
  expect_as_searched(test::ball_mesh(0.8, 20), random);
  expect_as_searched(test::box_mesh({1.0, 1.0, 1e-4}), random);
  expect_as_searched(test::sheet_mesh(1.0), random);
}

TEST(NearTriangles, OfAnEmptyTreeAreFarAway) {
  const NearTriangles near(TriangleTree(), Vector3d::Zero(), 1.0);
  EXPECT_EQ(near.size(), 0u);
  EXPECT_EQ(near.distance(Vector3d::Ones()), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace godobject::scene_compiler::near_triangles_test
