#include "toolchain/scene_compiler/mesh/needles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/scene_compiler/simple_meshes.h"
#include "toolchain/scene_compiler/mesh/mesh_edges.h"

namespace godobject::scene_compiler::needles_test {
namespace {

using Eigen::Vector3d;

constexpr double kFlat = 1e-6;
constexpr double kLongest = std::numbers::sqrt2 * kFlat;

/// Divides an edge, and both its triangles, at a length from its low end.
void divide_edge(TriangleMesh& mesh, const MeshEdges::Edge& edge, const MeshEdges& edges, double from_low) {
  const Vector3d along = mesh.vertices[edge.high] - mesh.vertices[edge.low];
  const auto x = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(mesh.vertices[edge.low] + from_low / along.norm() * along);
  for (const MeshEdges::Side& side : edges.sides(edge)) {
    auto& triangle = mesh.triangles[side.triangle];
    auto rest = triangle;
    *std::find(triangle.begin(), triangle.end(), edge.high) = x;
    *std::find(rest.begin(), rest.end(), edge.low) = x;
    mesh.triangles.push_back(rest);
  }
}

double shortest_edge(const TriangleMesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      shortest = std::min(shortest, (mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm());
    }
  }
  return shortest;
}

double volume_of(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6.0;
  }
  return sum;
}

/// Expects what holds after every call: two triangles at each edge, none twice, and each vertex where it was.
void expect_done(const TriangleMesh& mesh, const std::vector<Vector3d>& vertices) {
  EXPECT_TRUE(MeshEdges(mesh).closed());
  EXPECT_EQ(mesh.vertices, vertices) << "no vertex moves";
  std::set<std::set<std::uint32_t>> triangles;
  for (const auto& t : mesh.triangles) EXPECT_TRUE(triangles.insert({t[0], t[1], t[2]}).second);
}

TEST(Needles, GoWhereverTheyAre) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const TriangleMesh whole = seed % 2 == 0 ? test::box_mesh({0.02, 0.03, 0.01}) : test::ball_mesh(0.02, 5);
    TriangleMesh mesh = whole;
    std::set<std::uint32_t> divided;  // ends of divided edges: one needle at each
    for (unsigned i = 0; i < 1 + seed / 4; ++i) {
      const MeshEdges edges(mesh);
      const MeshEdges::Edge& edge = edges.all()[random() % edges.all().size()];
      const double length = (mesh.vertices[edge.high] - mesh.vertices[edge.low]).norm();
      if (!divided.insert(edge.low).second || !divided.insert(edge.high).second) continue;
      const double at = std::uniform_real_distribution<double>(0.01, 0.95)(random) * kFlat;
      divide_edge(mesh, edge, edges, random() % 2 == 0 ? at : length - at);
    }
    ASSERT_LT(shortest_edge(mesh), kFlat);
    const double volume = volume_of(mesh);
    const std::vector<Vector3d> vertices = mesh.vertices;
    collapse_needles(mesh, kFlat);
    expect_done(mesh, vertices);
    EXPECT_EQ(mesh.triangles.size(), whole.triangles.size());
    EXPECT_GT(shortest_edge(mesh), kLongest);
    EXPECT_NEAR(volume_of(mesh), volume, 1e-3 * kLongest);  // a surface of less than 1e-2 m^2, moved so far
  }
}

/// Several vertices beside each other on an edge: a pull makes needles of the next ones. All go if all are near to the
/// edge's end, and else none is pulled too far.
TEST(Needles, GoInRows) {
  for (const double step : {0.05, 0.3, 0.45, 0.6, 0.9}) {
    for (int count = 1; count <= 12; ++count) {
      SCOPED_TRACE(testing::Message() << count << " vertices, " << step << " apart");
      const TriangleMesh whole = test::box_mesh({0.02, 0.03, 0.01});
      for (std::size_t number = 0; number < MeshEdges(whole).all().size(); ++number) {
        TriangleMesh mesh = whole;
        auto edge = MeshEdges(mesh).all()[number];
        for (int i = 0; i < count; ++i) {  // from the high end to the low one
          const MeshEdges edges(mesh);
          const auto same = [&](const auto& e) { return e.low == edge.low && e.high == edge.high; };
          edge = *std::find_if(edges.all().begin(), edges.all().end(), same);
          divide_edge(mesh, edge, edges, (count - i) * step * kFlat);
          edge.high = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
        }
        const std::vector<Vector3d> vertices = mesh.vertices;
        if (number % 2 != 0) std::reverse(mesh.triangles.begin(), mesh.triangles.end());
        collapse_needles(mesh, kFlat);
        expect_done(mesh, vertices);
        if (count * step <= 1.0) {
          EXPECT_EQ(mesh.triangles.size(), whole.triangles.size());
        }
        for (const Vector3d& v : vertices) {
          double nearest = std::numeric_limits<double>::infinity();
          for (const auto& t : mesh.triangles) {
            for (const std::uint32_t u : t) nearest = std::min(nearest, (mesh.vertices[u] - v).norm());
          }
          EXPECT_LE(nearest, kLongest);
        }
      }
    }
  }
}

TEST(Needles, AreNotHigherAndHaveNoLongerSide) {
  for (const double share : {0.99, 1.5}) {
    TriangleMesh mesh = test::box_mesh({1.0, 1.0, 1.0});
    const MeshEdges edges(mesh);
    divide_edge(mesh, edges.all()[3], edges, share * kFlat);
    const std::size_t triangles = mesh.triangles.size();
    collapse_needles(mesh, kFlat);
    EXPECT_EQ(mesh.triangles.size(), share < 1.0 ? triangles - 2 : triangles);
  }
  TriangleMesh plate = test::box_mesh({0.02, 0.03, 1.1 * kFlat});
  collapse_needles(plate, kFlat);
  EXPECT_EQ(plate.triangles.size(), 12u);
}

/// Bodies as small as needles: whatever goes, no triangle is left twice and no edge with more than two.
TEST(Needles, OfTinyBodiesLeaveNoneFoldedOntoItself) {
  for (const double size : {0.3, 0.7, 0.95, 1.05, 1.3}) {
    for (const TriangleMesh& body : {test::box_mesh(Vector3d::Constant(size * kFlat)), test::ball_mesh(size * kFlat, 3),
                                     test::needle_mesh(0.01, size * kFlat)}) {
      TriangleMesh mesh = body;
      collapse_needles(mesh, kFlat);
      expect_done(mesh, body.vertices);
    }
  }
}

/// By hand: the second triangle is a needle, whose collapse pulls the upper vertex of the first one down. Only then is
/// the first triangle, which was looked at before, low enough to be a needle.
TEST(Needles, AreFoundWhereAPullMakesThem) {
  TriangleMesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.0}, {1.3, 0.0, 0.0}, {0.65, 1.2, 0.0}, {0.95, 0.6, 0.0}, {30.0, 30.0, 0.0}};
  for (Vector3d& v : mesh.vertices) v *= kFlat;
  mesh.triangles = {{0, 1, 2}};
  collapse_needles(mesh, kFlat);
  EXPECT_EQ(mesh.triangles.size(), 1u) << "too high";
  mesh.triangles = {{0, 1, 2}, {2, 3, 4}};
  collapse_needles(mesh, kFlat);
  EXPECT_TRUE(mesh.triangles.empty());
}

/// A vertex beside both ends, but in no triangle with both: its edges to them would become one, with more triangles.
TEST(Needles, StayIfTheSurfaceWouldJoinItself) {
  TriangleMesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.0}, {0.5 * kLongest, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {1, 4, 3}};  // 4 is a neighbour of both ends, too
  const auto triangles = mesh.triangles;
  collapse_needles(mesh, kFlat);
  EXPECT_EQ(mesh.triangles, triangles);
}

TEST(Needles, OfNothingAreNone) {
  TriangleMesh mesh;
  collapse_needles(mesh, kFlat);
  EXPECT_TRUE(mesh.triangles.empty());
}

}  // namespace
}  // namespace godobject::scene_compiler::needles_test
