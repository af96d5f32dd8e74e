#include "toolchain/live/same_scene.h"

#include <gtest/gtest.h>

#include "tests/support/small_scenes.h"
#include "tests/viewer/boxes.h"

namespace godobject::live::same_scene_test {
namespace {

/// A ball of 20 mm radius over a plate of 100 x 100 x 20 mm; a box reaches as far as the ball does.
class IsSameScene : public testing::Test {
 protected:
  bool is_same(const Vector3& still_edges, double reach) {
    const double edge = reach / std::sqrt(3.0);
    return is_same_scene({viewer::box(still_edges), viewer::box(Vector3(edge, edge, edge))}, scene_);
  }

  test::SceneImage image_ = test::ball_over_plate();
  SceneView scene_ = test::open_scene(image_);
};

TEST_F(IsSameScene, AcceptsBodiesOfTheImagesSizes) { EXPECT_TRUE(is_same(Vector3(0.05, 0.05, 0.01), 0.02)); }

TEST_F(IsSameScene, RefusesOtherSizes) {
  EXPECT_FALSE(is_same(Vector3(0.07, 0.05, 0.01), 0.02)) << "another still body";
  EXPECT_FALSE(is_same(Vector3(0.05, 0.05, 0.01), 0.025)) << "a larger moving body";
  EXPECT_FALSE(is_same(Vector3(0.05, 0.05, 0.01), 0.015)) << "a smaller moving body";
}

/// A workspace leaves out sample points. The others may then reach less far than the mesh does, but not farther.
TEST_F(IsSameScene, AllowsThatPointsAreLeftOut) {
  scene_.workspace.limited = true;
  EXPECT_TRUE(is_same(Vector3(0.05, 0.05, 0.01), 0.025));
  EXPECT_FALSE(is_same(Vector3(0.05, 0.05, 0.01), 0.015));
}

}  // namespace
}  // namespace godobject::live::same_scene_test
