#include "toolchain/scene_compiler/mesh/triangle_tree.h"

#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "tests/scene_compiler/brute_force.h"
#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"

namespace godobject::scene_compiler::triangle_tree_test {
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

/// The change along a segment is that of the winding number, which the oracle sums, also where solids cross each other.
TEST(TriangleTree, CountsTheTrianglesThatASegmentCrosses) {
  const Eigen::Isometry3d aside(Eigen::Translation3d(0.31, 0.22, 0.17));
  const TriangleMesh cube = test::box_mesh(Vector3d::Ones());
  const TriangleMesh crossing =
      joined(joined(cube, test::moved(cube, aside)), turned_inside_out(test::box_mesh(0.3 * Vector3d::Ones())));
  const TriangleTree tree = tree_of(crossing);
  const BruteForce truth(crossing);
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> place(-0.9, 1.1);
  int counted = 0;
  int changed = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d from(place(random), place(random), place(random));
    const Vector3d to =
        from + std::pow(10.0, -2.0 * std::abs(place(random))) * Vector3d(place(random), place(random), place(random));
    const std::optional<int> change = tree.winding_change(from, to);
    if (!change) continue;
    ++counted;
    changed += *change != 0 ? 1 : 0;
    ASSERT_NEAR(*change, truth.winding_number(to) - truth.winding_number(from), 1e-6) << i;
  }
  EXPECT_GT(counted, 3900);
  EXPECT_GT(changed, 300);
}

/// Through an edge or a corner, and to a place on a face, the count is unsure.
TEST(TriangleTree, CountsNoSegmentThroughAnEdge) {
  const TriangleTree tree = tree_of(test::box_mesh(Vector3d::Ones()));
  const Vector3d outside(2.0, 0.1, 0.2);
  EXPECT_EQ(tree.winding_change(outside, Vector3d(0.1, 0.1, 0.2)), 1);
  EXPECT_EQ(tree.winding_change(Vector3d(0.1, 0.1, 0.2), outside), -1);
  EXPECT_EQ(tree.winding_change(outside, Vector3d(-2.0, 0.1, 0.2)), 0);
  EXPECT_EQ(tree.winding_change(outside, Vector3d(0.5, 0.1, 0.2)), std::nullopt) << "ends on a face";
  EXPECT_EQ(tree.winding_change(Vector3d(0.5, 0.1, 0.2), outside), std::nullopt) << "begins on a face";
  EXPECT_EQ(tree.winding_change(Vector3d(1.0, 1.0, 0.2), Vector3d(0.0, 0.0, 0.2)), std::nullopt) << "through an edge";
  EXPECT_EQ(tree.winding_change(Vector3d::Ones(), Vector3d::Zero()), std::nullopt) << "through a corner";
  EXPECT_EQ(tree.winding_change(Vector3d(1.0, 0.0, 0.0), Vector3d(0.0, 0.0, 0.0)), std::nullopt) << "a diagonal";
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
}  // namespace godobject::scene_compiler::triangle_tree_test
