#include "toolchain/scene_compiler/mesh/triangle_tree.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/scene_compiler/brute_force.h"
#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TriangleTree tree_of(const TriangleMesh& mesh) {
  std::vector<TriangleTree::Triangle> triangles;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    triangles.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], i});
  }
  return TriangleTree(std::move(triangles));
}

/// A square sheet at z = 0 from -half to half with n x n squares of two triangles.
TriangleMesh sheet(int n, double half) {
  TriangleMesh mesh;
  const double step = 2.0 * half / n;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) mesh.vertices.emplace_back(-half + x * step, -half + y * step, 0.0);
  }
  const auto at = [n](int x, int y) { return static_cast<std::uint32_t>(x + (n + 1) * y); };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return mesh;
}

TEST(TriangleTree, MeetsASheetWithRaysThroughTheEdgesAndCornersOfItsTriangles) {
  const int n = 16;
  const TriangleTree tree = tree_of(sheet(n, 8.0));
  TriangleTree::RayHit hit{};
  for (const double up : {1.0, -1.0}) {
    // planes of boxes lie at whole numbers; halves are on diagonals
    for (double x = -7.0; x <= 7.0; x += 0.25) {
      for (double y = -7.0; y <= 7.0; y += 0.25) {
        for (const double zero : {0.0, -0.0}) {
          EXPECT_TRUE(tree.first_hit({x, y, -0.5 * up}, {zero, zero, up}, 0.0, 1.0, hit)) << x << " " << y;
          EXPECT_DOUBLE_EQ(hit.t, 0.5);
          EXPECT_FALSE(tree.first_hit({x, y, 0.5 * up}, {zero, zero, up}, 0.0, 1.0, hit)) << x << " " << y;
        }
      }
    }
  }
}

/// The exact sum counts each of the solids around a point, whatever its half angles add up to, and so does the sum with
/// dipoles within their error.
TEST(TriangleTree, CountsNestedSolids) {
  TriangleMesh nested;
  double expected = 0.0;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> within(-0.2, 0.2);
  for (int i = 1; i <= 9; ++i) {
    const TriangleMesh ball = test::ball_mesh(i, 7);
    const bool inside_out = i % 4 == 0;
    nested = joined(nested, inside_out ? turned_inside_out(ball) : ball);
    expected += inside_out ? -1.0 : 1.0;
    const TriangleTree tree = tree_of(nested);
    const TriangleTree turned = tree_of(turned_inside_out(nested));
    for (int j = 0; j < 50; ++j) {
      const Vector3d p(within(random), within(random), within(random));
      EXPECT_NEAR(tree.winding_number(p, kInfinity), expected, 1e-12);
      EXPECT_NEAR(turned.winding_number(p, kInfinity), -expected, 1e-12);
      EXPECT_NEAR(tree.winding_number(50.0 * p + Vector3d(30.0, 0.0, 0.0), kInfinity), 0.0, 1e-12);
      EXPECT_NEAR(tree.winding_number(p, 6.0), expected, 0.01 * i);
    }
  }
}

TEST(TriangleTree, AddsUpTheAnglesOfSizesFromAtomsToPlanets) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (const double scale : {1e-10, 1e-5, 1.0, 1e7}) {
    TriangleMesh soup;
    for (std::uint32_t i = 0; i < 300; ++i) {
      for (int corner = 0; corner < 3; ++corner) {
        soup.vertices.emplace_back(scale * normal(random), scale * normal(random), scale * normal(random));
      }
      soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const TriangleTree tree = tree_of(soup);
    const BruteForce truth(soup);
    for (int i = 0; i < 200; ++i) {
      const Vector3d p = scale * Vector3d(normal(random), normal(random), normal(random));
      EXPECT_NEAR(tree.winding_number(p, kInfinity), truth.winding_number(p), 1e-10) << scale;
    }
  }
}

TEST(TriangleTree, HasHalfOfTheJumpOnAFaceAndNoNumberThatIsNotFiniteOnEdgesAndCorners) {
  const TriangleMesh cube = box(Vector3d::Zero(), Vector3d::Ones());
  const TriangleTree tree = tree_of(cube);
  // seen from its own plane a triangle counts as one side or the other: +-1/2 about 1/2
  EXPECT_NEAR(std::abs(tree.winding_number({0.3, 0.4, 0.0}, kInfinity) - 0.5), 0.5, 1e-12);
  for (const double x : {0.0, 0.5, 1.0}) {
    for (const double y : {0.0, 0.5, 1.0}) {
      for (const double z : {0.0, 0.5, 1.0}) {
        const double winding = tree.winding_number({x, y, z}, kInfinity);
        EXPECT_GE(winding, -1e-12) << x << y << z;
        EXPECT_LE(winding, 1.0 + 1e-12) << x << y << z;
      }
    }
  }
}

}  // namespace
}  // namespace godobject::scene_compiler
