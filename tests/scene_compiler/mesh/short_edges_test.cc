#include "toolchain/scene_compiler/mesh/short_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/scene_compiler/simple_meshes.h"
#include "toolchain/scene_compiler/mesh/mesh_edges.h"

namespace godobject::scene_compiler::short_edges_test {
namespace {

using Eigen::Vector3d;

constexpr double kLongest = 1e-6;

/// Divides an edge, and both its triangles, at a length from one end. So two needles come about that end.
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

TEST(ShortEdges, GoWithTheirNeedlesWhateverTheSurface) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(seed);
    const TriangleMesh whole = seed % 2 == 0 ? test::box_mesh({0.02, 0.03, 0.01}) : test::ball_mesh(0.02, 5);
    TriangleMesh mesh = whole;
    std::set<std::uint32_t> divided;  // ends of divided edges: one needle at each
    for (unsigned i = 0; i < 1 + seed / 4; ++i) {
      const MeshEdges edges(mesh);
      const MeshEdges::Edge& edge = edges.all()[random() % edges.all().size()];
      const double length = (mesh.vertices[edge.high] - mesh.vertices[edge.low]).norm();
      if (!divided.insert(edge.low).second || !divided.insert(edge.high).second) continue;
      const double at = std::uniform_real_distribution<double>(0.01, 0.9)(random) * kLongest;
      divide_edge(mesh, edge, edges, random() % 2 == 0 ? at : length - at);
    }
    ASSERT_TRUE(MeshEdges(mesh).closed());
    ASSERT_LT(shortest_edge(mesh), kLongest);
    const double volume = volume_of(mesh);
    const std::vector<Vector3d> vertices = mesh.vertices;
    collapse_short_edges(mesh, kLongest);
    EXPECT_TRUE(MeshEdges(mesh).closed()) << seed;
    EXPECT_EQ(mesh.triangles.size(), whole.triangles.size()) << seed;
    EXPECT_GT(shortest_edge(mesh), kLongest) << seed;
    EXPECT_NEAR(volume_of(mesh), volume, 1e-3 * kLongest) << seed;  // a surface of less than 1e-2 m^2, moved so far
    EXPECT_EQ(mesh.vertices, vertices) << "no vertex moves";
  }
}

/// A row of vertices, each near to the next one: together they are long, so some stay.
TEST(ShortEdges, DoNotPullAVertexFartherThanTheirLength) {
  constexpr double kStep = 0.4 * kLongest;
  constexpr std::uint32_t kCount = 20;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kCount; ++i) mesh.vertices.emplace_back(kStep * i, 0.0, 0.0);
  mesh.vertices.emplace_back(0.0, 1.0, 0.0);
  for (std::uint32_t i = 0; i + 1 < kCount; ++i) mesh.triangles.push_back({i, i + 1, kCount});
  collapse_short_edges(mesh, kLongest);
  EXPECT_LT(mesh.triangles.size(), kCount / 2);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& t : mesh.triangles) {
      for (const std::uint32_t v : t) nearest = std::min(nearest, (mesh.vertices[v] - mesh.vertices[i]).norm());
    }
    EXPECT_LE(nearest, kLongest) << i;
  }
}

TEST(ShortEdges, StayIfTheyAreLonger) {
  for (const double share : {0.99, 1.01}) {
    TriangleMesh mesh = test::box_mesh({1.0, 1.0, 1.0});
    const MeshEdges edges(mesh);
    divide_edge(mesh, edges.all()[3], edges, share * kLongest);
    const std::size_t triangles = mesh.triangles.size();
    collapse_short_edges(mesh, kLongest);
    EXPECT_EQ(mesh.triangles.size(), share < 1.0 ? triangles - 2 : triangles);
  }
}

/// A vertex beside both ends, but in no triangle with both: its edges to them would become one, with more triangles.
TEST(ShortEdges, StayIfTheSurfaceWouldJoinItself) {
  TriangleMesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.0}, {0.5 * kLongest, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {1, 4, 3}};  // 4 is a neighbour of both ends, too
  const auto triangles = mesh.triangles;
  collapse_short_edges(mesh, kLongest);
  EXPECT_EQ(mesh.triangles, triangles);
}

TEST(ShortEdges, OfNothingAreNone) {
  TriangleMesh mesh;
  collapse_short_edges(mesh, kLongest);
  EXPECT_TRUE(mesh.triangles.empty());
}

}  // namespace
}  // namespace godobject::scene_compiler::short_edges_test
