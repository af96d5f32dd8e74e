#include "toolchain/scene_compiler/mesh/slits.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "tests/scene_compiler/simple_meshes.h"
#include "toolchain/scene_compiler/mesh/mesh_edges.h"
#include "toolchain/scene_compiler/mesh/mesh_import.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler::slits_test {
namespace {

using Eigen::Vector3d;

constexpr double kTolerance = 1e-9;

/// Divides one side of an edge, or both in turn, at a place on the edge. The other side keeps it whole.
class Divider {
 public:
  Divider(TriangleMesh mesh, unsigned seed) : mesh_(std::move(mesh)), random_(seed) {}

  void divide() {
    const auto t = static_cast<std::uint32_t>(random_() % mesh_.triangles.size());
    const std::size_t i = random_() % 3;
    const auto [a, b, c] =
        std::array{mesh_.triangles[t][i], mesh_.triangles[t][(i + 1) % 3], mesh_.triangles[t][(i + 2) % 3]};
    const double at = std::uniform_real_distribution<double>(0.2, 0.8)(random_);
    const auto x = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back((1.0 - at) * mesh_.vertices[a] + at * mesh_.vertices[b]);
    mesh_.triangles[t] = {a, x, c};
    mesh_.triangles.push_back({x, b, c});
  }

  const TriangleMesh& mesh() const { return mesh_; }

 private:
  TriangleMesh mesh_;
  std::mt19937 random_;
};

double area_of(const TriangleMesh& mesh) {
  double twice = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    twice += (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
  }
  return 0.5 * twice;
}

TEST(Slits, CloseWhereOneSideOfAnEdgeIsDivided) {
  TriangleMesh mesh = test::box_mesh({2.0, 2.0, 2.0});
  mesh.vertices.emplace_back(0.0, -1.0, -1.0);  // on the edge of vertices 0 and 1
  mesh.triangles[0] = {0, 2, 8};                // was 0 2 1
  mesh.triangles.push_back({2, 1, 8});
  EXPECT_FALSE(MeshEdges(mesh).closed());
  EXPECT_EQ(close_slits(mesh, kTolerance), 1u);
  EXPECT_TRUE(MeshEdges(mesh).closed());
  EXPECT_EQ(mesh.triangles.size(), 14u);
  EXPECT_EQ(mesh.vertices.size(), 9u);
}

TEST(Slits, CloseWhereverASurfaceIsDivided) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const TriangleMesh whole = seed % 2 == 0 ? test::box_mesh({0.02, 0.03, 0.01}) : test::ball_mesh(0.02, 5);
    Divider divider(whole, seed);
    for (unsigned i = 0; i < 1 + seed; ++i) divider.divide();
    TriangleMesh mesh = divider.mesh();
    ASSERT_FALSE(MeshEdges(mesh).closed());
    EXPECT_GT(close_slits(mesh, kTolerance), 0u);
    EXPECT_TRUE(MeshEdges(mesh).closed()) << seed;
    EXPECT_NEAR(area_of(mesh), area_of(whole), 1e-12) << seed;
    EXPECT_EQ(mesh.vertices.size(), divider.mesh().vertices.size());
  }
}

TEST(Slits, LeaveHolesAndRimsOpen) {
  TriangleMesh hole = test::ball_mesh(0.02, 6);
  hole.triangles.pop_back();
  const std::size_t triangles = hole.triangles.size();
  EXPECT_EQ(close_slits(hole, kTolerance), 0u);
  EXPECT_EQ(hole.triangles.size(), triangles);
  TriangleMesh sheet = test::sheet_mesh(0.02);
  EXPECT_EQ(close_slits(sheet, kTolerance), 0u);
}

/// A vertex beside an edge, by more than the tolerance, leaves a hole.
TEST(Slits, StayOpenIfTheyAreWide) {
  for (const double aside : {0.5 * kTolerance, 2.0 * kTolerance}) {
    TriangleMesh mesh = test::box_mesh({2.0, 2.0, 2.0});
    mesh.vertices.emplace_back(0.0, -1.0 + aside, -1.0);
    mesh.triangles[0] = {0, 2, 8};
    mesh.triangles.push_back({2, 1, 8});
    close_slits(mesh, kTolerance);
    EXPECT_EQ(MeshEdges(mesh).closed(), aside < kTolerance);
  }
}

/// The pieces of a triangle as thin as the tolerance would be flat or turned, and an edge would get a third triangle.
TEST(Slits, AreLeftWhereACutWouldDoHarm) {
  constexpr double kWide = 0.1;
  for (const double height : {0.05, 1.0}) {
    for (const bool has_rib : {false, true}) {
      TriangleMesh mesh;
      mesh.vertices = {{0.0, 0.0, 0.0},  {3.0, 0.0, 0.0}, {1.0, height, 0.0}, {2.0, 0.06, 0.0},
                       {1.5, -1.0, 0.0}, {2.5, 1.0, 0.0}, {2.5, 0.0, 1.0}};
      mesh.triangles = {{0, 1, 2}, {2, 1, 5}, {3, 0, 4}, {1, 3, 4}};
      if (has_rib) mesh.triangles.push_back({3, 1, 6});
      const std::uint64_t cuts = close_slits(mesh, kWide);
      if (height > kWide) {
        EXPECT_EQ(cuts, has_rib ? 0u : 1u);
      }
      for (const auto& t : mesh.triangles) {
        if (std::find(t.begin(), t.end(), 6u) != t.end()) continue;  // the rib
        const Vector3d& a = mesh.vertices[t[0]];
        EXPECT_GT((mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).z(), 1e-3) << height << " " << has_rib;
      }
    }
  }
}

/// A part whose faces were divided on one side only is imported without an open edge, and its distances stay.
TEST(Slits, AreClosedOnImport) {
  Divider divider(test::box_mesh({0.02, 0.03, 0.01}), 7);
  for (int i = 0; i < 12; ++i) divider.divide();
  MeshReport report;
  const TriangleMesh mesh = clean_mesh(divider.mesh(), "box", report);
  EXPECT_GT(report.cuts_at_slits, 0u);
  EXPECT_EQ(report.boundary_edges, 0u);
  EXPECT_EQ(report.euler, 2);
  const SolidSurface surface(mesh, SurfaceKind::kSolid, 0.001);
  EXPECT_TRUE(surface.sealed());
  EXPECT_NEAR(surface.signed_distance({0.0, 0.0, 0.0}), -0.005, 1e-9);
  EXPECT_NEAR(surface.signed_distance({0.013, 0.0, 0.0}), 0.003, 1e-9);
}

}  // namespace
}  // namespace godobject::scene_compiler::slits_test
