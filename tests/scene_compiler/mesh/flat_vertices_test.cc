#include "toolchain/scene_compiler/mesh/flat_vertices.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/scene_compiler/brute_force.h"
#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"
#include "tests/support/random.h"
#include "toolchain/scene_compiler/mesh/mesh_edges.h"

namespace godobject::scene_compiler::flat_vertices_test {
namespace {

using Eigen::Vector3d;

constexpr double kFlat = 1e-7;

/// Divides each triangle into four.
TriangleMesh divided(const TriangleMesh& mesh) {
  TriangleMesh fine;
  fine.vertices = mesh.vertices;
  std::map<std::set<std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, fresh] = middles.try_emplace({a, b}, static_cast<std::uint32_t>(fine.vertices.size()));
    if (fresh) fine.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
    return found->second;
  };
  for (const auto& t : mesh.triangles) {
    const std::uint32_t m[3] = {middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
    fine.triangles.push_back({t[0], m[0], m[2]});
    fine.triangles.push_back({t[1], m[1], m[0]});
    fine.triangles.push_back({t[2], m[2], m[1]});
    fine.triangles.push_back({m[0], m[1], m[2]});
  }
  return fine;
}

/// Expects a closed mesh with the distances of the one before.
void expect_same_surface(const TriangleMesh& before, const TriangleMesh& after) {
  EXPECT_TRUE(MeshEdges(after).closed());
  const BruteForce was(before);
  const BruteForce is(after);
  test::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p = 0.03 * random.in_cube(1.0);
    ASSERT_NEAR(is.distance(p), was.distance(p), kFlat) << p.transpose();
    if (was.distance(p) < kFlat) continue;
    ASSERT_EQ(is.winding_number(p) > 0.5, was.winding_number(p) > 0.5) << p.transpose();
  }
}

TEST(FlatVertices, LeaveTheTwelveTrianglesOfABox) {
  for (const bool turned : {false, true}) {
    const TriangleMesh box = test::box_mesh({0.03, 0.02, 0.015});
    const TriangleMesh fine = divided(divided(divided(turned ? test::moved(box, test::odd_motion()) : box)));
    TriangleMesh mesh = fine;
    remove_flat_vertices(mesh, kFlat);
    EXPECT_LE(mesh.triangles.size(), 14u) << "of " << fine.triangles.size();
    expect_same_surface(fine, mesh);
  }
}

TEST(FlatVertices, KeepCavitiesAndConesAsTheyAre) {
  for (const TriangleMesh& coarse :
       {hollow_block({0.03, 0.028, 0.026}, {0.0101, 0.0083, 0.0067}), cone_mesh(0.01, 0.02, 30)}) {
    const TriangleMesh fine = divided(divided(coarse));
    TriangleMesh mesh = fine;
    remove_flat_vertices(mesh, kFlat);
    EXPECT_LE(mesh.triangles.size(), 2 * coarse.triangles.size());
    expect_same_surface(fine, mesh);
  }
}

/// Removals add up on a finely divided cylinder: each alone is flat.
TEST(FlatVertices, OfAFineCylinderKeepItsSurface) {
  constexpr double kRadius = 0.01;
  constexpr std::uint32_t kAround = 1024, kRings = 9;
  TriangleMesh mesh;
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      mesh.vertices.emplace_back(kRadius * std::cos(angle), kRadius * std::sin(angle), 1e-3 * ring);
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t a = ring * kAround + i, b = ring * kAround + (i + 1) % kAround;
      mesh.triangles.push_back({a, b, a + kAround});
      mesh.triangles.push_back({b, b + kAround, a + kAround});
    }
  }
  const auto foot = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.emplace_back(0.0, 0.0, 0.0);
  mesh.vertices.emplace_back(0.0, 0.0, 1e-3 * (kRings - 1));
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const std::uint32_t next = (i + 1) % kAround, top = (kRings - 1) * kAround;
    mesh.triangles.push_back({foot, next, i});
    mesh.triangles.push_back({foot + 1, top + i, top + next});
  }
  for (const double flat : {1e-6, 1e-5, 3e-5}) {
    TriangleMesh less = mesh;
    remove_flat_vertices(less, flat);
    EXPECT_LT(less.triangles.size(), mesh.triangles.size());
    const BruteForce is(less);
    double farthest = 0.0;
    for (std::size_t v = 0; v < mesh.vertices.size(); v += 3) {
      farthest = std::max(farthest, is.distance(mesh.vertices[v]));
    }
    EXPECT_LE(farthest, flat) << less.triangles.size() << " triangles";
  }
}

TEST(FlatVertices, AreNoneWhereTheSurfaceBends) {
  TriangleMesh ball = test::ball_mesh(0.012, 12);
  const std::size_t triangles = ball.triangles.size();
  remove_flat_vertices(ball, kFlat);
  EXPECT_EQ(ball.triangles.size(), triangles);
}

/// The rim of a hole keeps its vertices.
TEST(FlatVertices, KeepOpenRims) {
  TriangleMesh mesh = divided(divided(test::box_mesh({0.03, 0.02, 0.015})));
  mesh.triangles.pop_back();
  const auto open = [](const TriangleMesh& of) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    const MeshEdges edges(of);
    for (const auto& edge : edges.all()) {
      if (edges.sides(edge).size() == 1) found.insert({edge.low, edge.high});
    }
    return found;
  };
  const auto before = open(mesh);
  remove_flat_vertices(mesh, kFlat);
  EXPECT_EQ(open(mesh), before);
  EXPECT_EQ(before.size(), 3u);
}

}  // namespace
}  // namespace godobject::scene_compiler::flat_vertices_test
