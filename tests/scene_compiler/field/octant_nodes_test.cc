#include "toolchain/scene_compiler/field/octant_nodes.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/scene_compiler/simple_meshes.h"
#include "toolchain/scene_compiler/field/distance_probe.h"
#include "toolchain/scene_compiler/mesh/triangle_tree.h"

namespace godobject::scene_compiler::octant_nodes_test {
namespace {

using Eigen::Vector3d;
using format::kBrickNodes;

constexpr double kVoxel = 0.002;

/// Bodies whose winding number is a whole one: parts that cross, lie in one another or are reversed, a thin plate, a
/// cavity, a sheet, a solid beside a sheet and a dilated one.
std::vector<test::BodyOfMesh> sealed_bodies() {
  const Eigen::Isometry3d aside(Eigen::Translation3d(0.011, 0.003, 0.002));
  const TriangleMesh box = test::moved(test::box_mesh({0.03, 0.02, 0.015}), test::odd_motion());
  const TriangleMesh ball = test::ball_mesh(0.012, 8);
  const TriangleMesh inner = test::ball_mesh(0.006, 6);
  const TriangleMesh sheet = test::moved(test::sheet_mesh(0.03), aside);
  return {{box},
          {test::box_mesh({0.03, 0.02, 0.0003})},
          {test::joined(ball, test::moved(test::box_mesh({0.01, 0.02, 0.02}), aside)), SurfaceKind::kSolid},
          {test::joined(ball, inner), SurfaceKind::kSolid},
          {test::joined(ball, test::inside_out(inner)), SurfaceKind::kSolid},
          {test::inside_out(box), SurfaceKind::kSolid},
          {test::moved(test::sheet_mesh(0.03), test::odd_motion()), SurfaceKind::kShell},
          {test::joined(test::moved(inner, Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.02))), sheet)},
          {box, SurfaceKind::kSolid, 0.003}};
}

TEST(OctantNodes, AreTheExactDistances) {
  std::mt19937 random(9);
  int body_number = 0;
  for (const test::BodyOfMesh& body : sealed_bodies()) {
    SCOPED_TRACE(body_number++);
    const SolidSurface surface(body.mesh, body.kind, 2.0 * kVoxel, body.dilation);
    const DistanceGrid field = make_distance_grid(surface, kVoxel, default_band(kVoxel, 1.5 * kVoxel), {});
    const SurfaceFacets no_facets;
    const BrickTree tree(field, no_facets);
    for (int k = 0; k < 40; ++k) {
      const auto brick = static_cast<std::uint32_t>(random() % tree.brick_count());
      const Octants octants = measure_octants(surface, tree, brick);
      for (unsigned octant = 0; octant < 8; ++octant) {
        for (int n = 0; n < format::kBrickValues; n += 1 + static_cast<int>(random() % 3)) {
          const Vector3d cell(n % kBrickNodes, n / kBrickNodes % kBrickNodes, n / kBrickNodes / kBrickNodes);
          const Vector3d first(octant & 1, octant >> 1 & 1, octant >> 2);
          const Vector3d p = tree.low(brick) + 0.5 * kVoxel * (cell + format::kBrickCells * first);
          const double exact = surface.signed_distance(p);
          ASSERT_NEAR(octants.bricks[octant].value[n], exact, 1e-7 * std::abs(exact) + 1e-12) << brick << " " << n;
        }
      }
    }
  }
}

/// Also along walks that begin at a place where another one has been.
TEST(DistanceProbe, TellsWhatTheSurfaceTells) {
  std::mt19937 random(10);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  const auto any = [&] { return Vector3d(place(random), place(random), place(random)); };
  int body_number = 0;
  for (const test::BodyOfMesh& body : sealed_bodies()) {
    SCOPED_TRACE(body_number++);
    const SolidSurface surface(body.mesh, body.kind, 2.0 * kVoxel, body.dilation);
    Vector3d center = Vector3d::Zero();
    for (const Vector3d& v : body.mesh.vertices) center += v / static_cast<double>(body.mesh.vertices.size());
    bool started = false;
    for (int walk = 0; walk < 20; ++walk) {
      DistanceProbe probe(surface);
      Vector3d p = center + 0.02 * any();
      const auto first = static_cast<float>(probe.signed_distance(p));
      DistanceProbe other(surface);
      const auto winding = probe.winding();
      if (winding) other.start(p, first, *winding);
      started = started || winding;
      for (int step = 0; step < 50; ++step) {
        p += std::pow(10.0, -3.0 + 1.5 * place(random)) * any();
        if ((p - center).norm() > 0.03) p = center + 0.02 * any();
        const double exact = surface.signed_distance(p);
        ASSERT_NEAR(probe.signed_distance(p), exact, 1e-12);
        ASSERT_NEAR(other.signed_distance(p), exact, 1e-12);
      }
    }
    const bool counted = surface.shell_triangles().empty() && body.dilation == 0.0;
    EXPECT_EQ(started, counted);
  }
}

}  // namespace
}  // namespace godobject::scene_compiler::octant_nodes_test
