#include "core/scene/scene.h"

#include <gtest/gtest.h>

#include "tests/support/analytic_shapes.h"
#include "tests/support/scene_image_builder.h"

namespace godobject {
namespace {

TEST(Scene, OpensABallUnderABox) {
  test::SceneDescription d;
  d.distance = [](const Vector3& p) { return test::ball_distance(p, 0.02); };
  d.surface_min = Vector3::Constant(-0.02);
  d.surface_max = Vector3::Constant(0.02);
  const auto box = test::sample_box(Vector3(0.01, 0.02, 0.03), 5);
  d.points = box.points;
  d.normals = box.normals;
  const test::SceneImage image = test::build_scene_image(d);
  const Scene scene = test::open_scene(image);
  EXPECT_EQ(scene.pointshell.size, box.points.size());
  EXPECT_NEAR(scene.voxelmap.sample(Vector3(0.025, 0, 0)).distance, 0.005, 1e-3);
}

}  // namespace
}  // namespace godobject
