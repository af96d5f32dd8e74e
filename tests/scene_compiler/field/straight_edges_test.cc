#include "toolchain/scene_compiler/field/straight_edges.h"

#include <array>
#include <cstdio>
#include <map>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/scene/edge.h"
#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"
#include "tests/support/random.h"

namespace godobject::scene_compiler::straight_edges_test {
namespace {

using Eigen::Vector3d;
using Vector3Map = Eigen::Map<const Vector3d>;

constexpr double kEdgeVoxel = 0.002;
constexpr double kLargestRadius = 2.4 * kEdgeVoxel;

/// Divides each triangle into four, so straight edges consist of many mesh edges.
TriangleMesh divided(const TriangleMesh& mesh) {
  TriangleMesh fine;
  std::map<std::array<double, 3>, std::uint32_t> numbers;
  const auto number = [&](const Vector3d& p) {
    const auto [found, fresh] =
        numbers.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(fine.vertices.size()));
    if (fresh) fine.vertices.push_back(p);
    return found->second;
  };
  for (const auto& t : mesh.triangles) {
    std::array<std::uint32_t, 3> corner{};
    std::array<std::uint32_t, 3> middle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d& a = mesh.vertices[t[i]];
      const Vector3d& b = mesh.vertices[t[(i + 1) % 3]];
      corner[i] = number(a);
      middle[i] = number(0.5 * (a + b));
    }
    fine.triangles.push_back({corner[0], middle[0], middle[2]});
    fine.triangles.push_back({corner[1], middle[1], middle[0]});
    fine.triangles.push_back({corner[2], middle[2], middle[1]});
    fine.triangles.push_back(middle);
  }
  return fine;
}

Vector3d anywhere_about(const format::Edge& edge, test::Random& random) {
  const double t = random.between(edge.begin, edge.end);
  const Vector3d across = random.direction().cross(Vector3Map(edge.along)).normalized();
  return Vector3Map(edge.point) + t * Vector3Map(edge.along) + random.between(0.0, edge.radius) * across;
}

/// Checks places where an edge has a weight: its wedge is the surface there, no other edge has a weight, and reaches()
/// is true for cubes around the place.
std::size_t expect_exact(const SolidSurface& surface, const char* what) {
  const std::vector<format::Edge> edges = straight_edges(surface, kEdgeVoxel, kLargestRadius);
  test::Random random(3);
  double worst = 0.0;
  int shared = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (int i = 0; i < 60; ++i) {
      const Vector3d p = anywhere_about(edges[e], random);
      if (edge_weight(edges[e], p).value == 0.0) continue;
      worst = std::max(worst, std::abs(wedge_distance(edges[e], p).value - surface.signed_distance(p)));
      for (std::size_t other = 0; other < edges.size(); ++other) {
        if (other != e && edge_weight(edges[other], p).value > 0.0) ++shared;
      }
      const double half = random.between(0.0, 4.0 * kEdgeVoxel);
      EXPECT_TRUE(reaches(edges[e], p + random.in_cube(half), half)) << what;
    }
  }
  EXPECT_LE(worst, 1e-3 * kEdgeVoxel) << what;
  EXPECT_EQ(shared, 0) << what;
  std::printf("%-14s %zu stretches, their wedges off by %.1e m at most\n", what, edges.size(), worst);
  return edges.size();
}

TEST(StraightEdges, AreTheTwelveOfABoxHoweverItIsMeshed) {
  TriangleMesh mesh = test::moved(test::box_mesh({0.06, 0.08, 0.1}), test::odd_motion());
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(expect_exact(SolidSurface(mesh, SurfaceKind::kSolid, kEdgeVoxel), "box"), 12u) << i;
    mesh = divided(mesh);
  }
}

/// As read from a file, half a metre off.
TriangleMesh float_corners(TriangleMesh mesh) {
  for (Vector3d& vertex : mesh.vertices) {
    vertex = (vertex + Vector3d(0.5, -0.4, 0.3)).cast<float>().cast<double>();
  }
  return mesh;
}

TEST(StraightEdges, AreTheTwelveOfABoxInSinglePrecision) {
  TriangleMesh mesh = test::moved(test::box_mesh({0.03, 0.04, 0.05}), test::odd_motion());
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(expect_exact(SolidSurface(float_corners(mesh), SurfaceKind::kSolid, kEdgeVoxel), "float box"), 12u) << i;
    mesh = divided(mesh);
  }
}

/// Eleven steps from a square end the allowed radius is the end radius exactly, but for the rounding of the vertices.
TEST(StraightEdges, HaveRadiiThatAnImageTakesHoweverVerticesAreRounded) {
  test::Random random(17);
  for (int i = 0; i < 60; ++i) {
    TriangleMesh mesh = test::box_mesh({8.0 * kEdgeVoxel, 9.0 * kEdgeVoxel, 11.0 * kEdgeVoxel});
    const double rounding = kEdgeVoxel * std::pow(10.0, random.between(-9.0, -5.0));
    for (Vector3d& vertex : mesh.vertices) vertex += random.in_cube(rounding);
    const auto edges = straight_edges(SolidSurface(mesh, SurfaceKind::kSolid, kEdgeVoxel), kEdgeVoxel, kLargestRadius);
    EXPECT_EQ(edges.size(), 12u) << rounding;
    for (const format::Edge& edge : edges) {
      EXPECT_GE(edge.radius, edge.end_radius) << rounding;
      EXPECT_TRUE(edge.slope >= 0.0 && edge.slope <= 1.0) << edge.slope;
    }
  }
}

TEST(StraightEdges, AreExactOrNotAtAllWhereSolidsLieInOrOnSolids) {
  const TriangleMesh box = test::box_mesh({0.06, 0.08, 0.1});
  const auto expect = [&box](const TriangleMesh& other, const char* what, SurfaceKind kind = SurfaceKind::kSolid) {
    expect_exact(SolidSurface(test::joined(box, other), kind, kEdgeVoxel), what);
  };
  expect(test::box_mesh({0.02, 0.02, 0.02}), "box in box", SurfaceKind::kAuto);
  expect(test::inside_out(test::box_mesh({0.02, 0.02, 0.02})), "hollow");
  expect(test::box_mesh({0.02, 0.03, 0.05}, {-0.03, -0.04, 0.01}), "in the corner");
  expect(test::inside_out(test::box_mesh({0.02, 0.03, 0.05}, {-0.03, -0.04, 0.01})), "corner cut out");
  expect(test::box_mesh({0.02, 0.02, 0.04}, {-0.03, -0.04, 0.03}), "flush post");
  expect(test::box_mesh({0.02, 0.08, 0.1}, {0.03, -0.04, -0.05}), "side by side");
  expect(box, "twice");
  TriangleMesh fold;  // a closed quadrangle without a volume
  fold.vertices = {{0.038, -0.02, -0.02}, {0.038, 0.02, -0.02}, {0.038, 0.02, 0.02}, {0.038, -0.02, 0.02}};
  fold.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}};
  expect(fold, "fold");
}

TEST(StraightEdges, AreExactOrNotAtAllBesideThickShells) {
  for (const double thickness : {2.0, 6.0, 12.0}) {
    for (const double above : {1.2, 4.0, 4.3}) {
      TriangleMesh sheet = test::sheet_mesh(0.2);
      for (Vector3d& vertex : sheet.vertices) vertex.z() += 0.05 + above * kEdgeVoxel;
      const SolidSurface surface(test::joined(test::box_mesh({0.06, 0.08, 0.1}), sheet), SurfaceKind::kAuto,
                                 thickness * kEdgeVoxel);
      expect_exact(surface, "beside a shell");
    }
  }
}

/// No brick is halved for edges that cannot be separated.
TEST(StraightEdges, OnOneLineAreApart) {
  TriangleMesh mesh = test::box_mesh({0.06, 0.08, 0.1});
  mesh = test::joined(mesh, test::box_mesh({0.06, 0.08, 0.1}, {-0.03, -0.04, 0.05}));  // one on top of the other
  const auto edges = straight_edges(SolidSurface(mesh, SurfaceKind::kSolid, kEdgeVoxel), kEdgeVoxel, kLargestRadius);
  for (const format::Edge& one : edges) {
    for (const format::Edge& other : edges) {
      if (&one == &other || std::abs(Vector3Map(one.along).dot(Vector3Map(other.along))) < 0.999) continue;
      const Vector3d between = Vector3Map(other.point) - Vector3Map(one.point);
      if (between.cross(Vector3Map(one.along)).norm() > 1e-6) continue;  // another line
      const double t = between.dot(Vector3Map(one.along));
      const double sign = Vector3Map(one.along).dot(Vector3Map(other.along));
      const auto [from, to] = std::minmax({t + sign * other.begin, t + sign * other.end});
      EXPECT_TRUE(from >= one.end + 0.49 * kEdgeVoxel || to <= one.begin - 0.49 * kEdgeVoxel);
    }
  }
}

TEST(StraightEdges, OfABoxInsideOutAreTheSame) {
  const TriangleMesh mesh = test::inside_out(test::box_mesh({0.06, 0.08, 0.1}));
  EXPECT_EQ(expect_exact(SolidSurface(mesh, SurfaceKind::kSolid, kEdgeVoxel), "inside out"), 12u);
}

TEST(StraightEdges, KeepTheirDistanceFromWhatElseIsNear) {
  const SolidSurface surface(test::box_mesh({0.06, 0.08, 0.1}), SurfaceKind::kSolid, kEdgeVoxel);
  for (const format::Edge& edge : straight_edges(surface, kEdgeVoxel, kLargestRadius)) {
    EXPECT_EQ(edge.side, 1.0);
    EXPECT_DOUBLE_EQ(edge.radius, kLargestRadius);
    // the next face is perpendicular to the end: R = kShare times the distance to it
    const double left_over = edge.begin - std::max(0.0, kEndRadius * kEdgeVoxel / kShare);
    EXPECT_GE(left_over, -1e-9);
    EXPECT_LE(left_over, 0.25 * kEdgeVoxel);
  }
}

TEST(StraightEdges, AreExactOnEngineeredParts) {
  EXPECT_GT(expect_exact(SolidSurface(load("bracket", 1.0), SurfaceKind::kAuto, kEdgeVoxel), "bracket"), 20u);
  expect_exact(SolidSurface(load("gear", 1.0), SurfaceKind::kAuto, kEdgeVoxel), "gear");
  expect_exact(SolidSurface(load("anchor_part", 1.0), SurfaceKind::kAuto, kEdgeVoxel), "anchor");
}

TEST(StraightEdges, AreExactWherePartsRunIntoOneAnother) {
  expect_exact(SolidSurface(load("teapot", 0.037), SurfaceKind::kAuto, kEdgeVoxel), "teapot");
  const TriangleMesh two = test::joined(test::box_mesh({0.06, 0.08, 0.1}),
                                        test::moved(test::box_mesh({0.06, 0.05, 0.2}), test::odd_motion()));
  EXPECT_GT(expect_exact(SolidSurface(two, SurfaceKind::kSolid, kEdgeVoxel), "two boxes"), 12u);
}

TEST(StraightEdges, StopBeforeAHole) {
  TriangleMesh mesh = test::box_mesh({0.06, 0.08, 0.1});
  mesh.triangles.resize(mesh.triangles.size() - 2);  // the last face
  const SolidSurface surface(mesh, SurfaceKind::kSolid, kEdgeVoxel);
  expect_exact(surface, "open box");
  EXPECT_EQ(straight_edges(surface, kEdgeVoxel, kLargestRadius).size(), 8u);
}

TEST(StraightEdges, AreNoneOfSheetsAndBalls) {
  EXPECT_TRUE(
      straight_edges(SolidSurface(test::sheet_mesh(0.1), SurfaceKind::kShell, kEdgeVoxel), kEdgeVoxel, kLargestRadius)
          .empty());
  EXPECT_TRUE(straight_edges(SolidSurface(test::ball_mesh(0.03, 40), SurfaceKind::kSolid, kEdgeVoxel), kEdgeVoxel,
                             kLargestRadius)
                  .empty());
}

}  // namespace
}  // namespace godobject::scene_compiler::straight_edges_test
