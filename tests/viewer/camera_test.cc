#include "toolchain/viewer/camera.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/viewer/boxes.h"

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

TEST(Camera, ZoomBringsItNearer) {
  const Stage stage;
  View view = stage.view();
  const double distance = (make_camera(view).eye - make_camera(view).target).norm();
  view.zoom = 2.0;
  EXPECT_NEAR((make_camera(view).eye - make_camera(view).target).norm(), 0.5 * distance, 1e-12);
}

}  // namespace
}  // namespace godobject::viewer
