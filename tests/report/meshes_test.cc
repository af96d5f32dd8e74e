#include "toolchain/report/contact_quality/meshes.h"

#include <array>
#include <numbers>

#include <gtest/gtest.h>

#include "toolchain/report/contact_quality/scenes.h"
#include "toolchain/scene_compiler/mesh/mesh_import.h"

namespace godobject::report {
namespace {

double volume(const TriangleMesh& mesh) {
  double six = 0.0;
  for (const auto& t : mesh.triangles) {
    six += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  }
  return six / 6.0;
}

TEST(Meshes, EncloseTheVolumeThatTheyShould) {
  EXPECT_NEAR(volume(box_mesh(Vector3(-1.0, 0.0, 2.0), Vector3(1.0, 3.0, 2.5))), 3.0, 1e-12);
  const std::vector<double> planes = {0.0, 1.0, 3.0};
  const auto corner =
      cell_solid({planes, planes, planes}, [](int i, int j, int k) { return i == 0 || j == 0 || k == 0; });
  EXPECT_NEAR(volume(corner), 27.0 - 8.0, 1e-12);
  const std::vector<double> xs = {-2.0, -1.0, 0.0, 1.0, 2.0};
  const std::vector<double> heights = {1.0, 1.0, 0.0, 1.0, 1.0};
  EXPECT_NEAR(volume(profile_solid(xs, heights, -1.0, 0.5)), 8.0 - 1.0, 1e-12);
  const std::vector<TurnedCorner> tube = {{0.0, -2.0}, {2.0, -2.0}, {2.0, 0.0}, {1.0, 0.0}, {1.0, -1.0}, {0.0, -1.0}};
  EXPECT_NEAR(volume(turned_solid(tube, 400)), std::numbers::pi * (4.0 * 2.0 - 1.0), 2e-3);
  EXPECT_NEAR(volume(ball_mesh(1.0, 100)), 4.0 / 3.0 * std::numbers::pi, 3e-3);
}

TEST(Meshes, OfAllScenesAndBodiesAreSound) {
  using scene_compiler::MeshReport;
  const auto expect_closed = [](const TriangleMesh& mesh, const std::string& name) {
    MeshReport report;
    scene_compiler::clean_mesh(mesh, name, report);
    EXPECT_EQ(report.boundary_edges, 0u) << name;
    EXPECT_EQ(report.nonmanifold_edges, 0u) << name;
    EXPECT_EQ(report.misoriented_edges, 0u) << name;
    EXPECT_EQ(report.welded_vertices, 0u) << name;
    EXPECT_EQ(report.degenerate_triangles, 0u) << name;
    EXPECT_GT(volume(mesh), 0.0) << name;
  };
  for (const BodyShape shape :
       {BodyShape::kSphere, BodyShape::kBox, BodyShape::kL, BodyShape::kNeedle, BodyShape::kPeg}) {
    expect_closed(body_mesh(shape, {}), name(shape));
  }
  for (const SceneSpec& scene : scenes()) {
    if (scene.kind == WorldKind::kCompiled && !scene.still.shell) expect_closed(placed(scene).mesh, scene.name);
  }
}

TEST(Scenes, MeshesLieOnTheExactSurfaceWhereTheBodiesAre) {
  // vertices of the mesh lie on the solid's surface, or far from the body's path
  for (const SceneSpec& scene : scenes()) {
    if (scene.kind != WorldKind::kCompiled || scene.still.shell) continue;
    int on_surface = 0;
    for (const Eigen::Vector3d& vertex : scene.still.mesh.vertices) {
      const double distance = scene.solid.distance(vertex);
      EXPECT_LT(distance, 1e-9) << scene.name;
      if (distance > -1e-9) ++on_surface;
    }
    EXPECT_GE(on_surface, 2) << scene.name;
  }
}

}  // namespace
}  // namespace godobject::report
