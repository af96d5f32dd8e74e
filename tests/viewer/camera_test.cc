#include "toolchain/viewer/camera.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/viewer/boxes.h"
#include "toolchain/scene_compiler/mesh/mesh_import.h"
#include "toolchain/scene_compiler/mesh/triangle_tree.h"

namespace godobject::viewer {
namespace {

constexpr double kPi = std::numbers::pi;

/// A small box on a large plate.
struct Stage {
  scene_compiler::TriangleMesh plate = box(Vector3(0.2, 0.2, 0.01));
  scene_compiler::TriangleMesh body = box(Vector3(0.02, 0.02, 0.02));
  Pose H_WS{Quaternion::Identity(), Vector3(0, 0, 0.03)};
  Pose H_WD{Quaternion::Identity(), Vector3(0, 0, 0.02)};

  View view() const { return {.still = plate, .moving = body, .placements = {{H_WD, H_WS}}, .direction = {}}; }
};

void expect_right_handed(const Camera& camera) {
  EXPECT_NEAR(camera.right.dot(camera.forward), 0.0, 1e-12);
  EXPECT_NEAR((camera.right.cross(camera.up) + camera.forward).norm(), 0.0, 1e-12);
}

TEST(Camera, StandsWhereItIsTold) {
  const Stage stage;
  View view = stage.view();
  view.direction = ViewDirection{.azimuth = kPi / 2, .elevation = 0.0};  // up z: azimuth from x towards y
  const Camera camera = make_camera(view);
  EXPECT_NEAR((camera.forward - Vector3(0, -1, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((camera.up - Vector3(0, 0, 1)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((camera.right - Vector3(-1, 0, 0)).norm(), 0.0, 1e-12);
  expect_right_handed(camera);
}

TEST(Camera, LooksStraightDownToo) {
  const Stage stage;
  View view = stage.view();
  view.direction = ViewDirection{.azimuth = 0.0, .elevation = kPi / 2};
  const Camera camera = make_camera(view);
  EXPECT_NEAR((camera.forward - Vector3(0, 0, -1)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(camera.right.norm(), 1.0, 1e-12);
  expect_right_handed(camera);
}

TEST(Camera, SeesTheWholeMovingBodyInBothPoses) {
  const Stage stage;
  const Camera camera = make_camera(stage.view());
  for (const Pose& pose : {stage.H_WD, stage.H_WS}) {
    for (const Vector3& vertex : stage.body.vertices) {
      const Vector3 ray = pose * vertex - camera.eye;
      const double depth = ray.dot(camera.forward);
      EXPECT_LT(std::abs(ray.dot(camera.right)), depth * std::tan(kHalfView));
      EXPECT_LT(std::abs(ray.dot(camera.up)), depth * std::tan(kHalfView));
    }
  }
}

TEST(Camera, SeesEveryPlacementThatIsToBeCompared) {
  const Stage stage;
  View view = stage.view();
  const Pose aside{Quaternion::Identity(), Vector3(0.15, 0, 0.03)};
  view.placements.push_back({stage.H_WD, aside});
  const Camera camera = make_camera(view);
  for (const Vector3& vertex : stage.body.vertices) {
    const Vector3 ray = aside * vertex - camera.eye;
    EXPECT_LT(std::abs(ray.dot(camera.right)), ray.dot(camera.forward) * std::tan(kHalfView));
    EXPECT_LT(std::abs(ray.dot(camera.up)), ray.dot(camera.forward) * std::tan(kHalfView));
  }
}

TEST(Camera, ChoosesToLookFromTheBodysSideOfThePlate) {
  const Stage stage;
  const Camera camera = make_camera(stage.view());
  EXPECT_GT(camera.eye.z(), 0.03);
  EXPECT_LT(std::abs(camera.forward.z()), 0.5);  // the poses differ along z: seen from the side
}

TEST(Camera, LooksFromAsideAtAnEarInTheHandle) {
  // the ear fills the handle: no direction shows the place where they touch, and the body hides much of the
  // surroundings
  scene_compiler::MeshReport report;
  const std::filesystem::path meshes = GODOBJECT_MESH_FOLDER;
  const auto teapot = scene_compiler::import_mesh(meshes / "teapot.ply", 0.037, report);
  const auto bunny = scene_compiler::import_mesh(meshes / "bunny_npm.ply", 0.0161497, report);
  const Pose H_WD{Quaternion(0.07492, 0.13961, -0.96715, -0.19878), Vector3(-0.11534, -0.09560, -0.07883)};
  const Pose H_WS{Quaternion(0.07064, 0.12966, -0.96464, -0.21835), Vector3(-0.11692, -0.11086, -0.08246)};
  const View view{.still = teapot, .moving = bunny, .placements = {{H_WD, H_WS}}, .up_axis = 1, .direction = {}};
  const Vector3 eye = make_camera(view).eye;
  std::vector<scene_compiler::TriangleTree::Triangle> triangles;
  for (const auto& t : bunny.triangles)
    triangles.push_back({H_WS * bunny.vertices[t[0]], H_WS * bunny.vertices[t[1]], H_WS * bunny.vertices[t[2]],
                         static_cast<std::uint32_t>(triangles.size())});
  const scene_compiler::TriangleTree body(std::move(triangles));
  for (const Vector3& on_handle : {Vector3(-0.105, 0.02, 0.0), Vector3(-0.100, -0.01, 0.0)}) {
    scene_compiler::TriangleTree::RayHit hit{};
    EXPECT_FALSE(body.first_hit(on_handle, (eye - on_handle).normalized(), 0.0, 10.0, hit)) << on_handle.transpose();
  }
}

TEST(Camera, ZoomBringsItNearer) {
  const Stage stage;
  View view = stage.view();
  const double distance = (make_camera(view).eye - make_camera(view).target).norm();
  view.zoom = 2.0;
  EXPECT_NEAR((make_camera(view).eye - make_camera(view).target).norm(), 0.5 * distance, 1e-12);
}

}  // namespace
}  // namespace godobject::viewer
