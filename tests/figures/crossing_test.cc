#include "toolchain/figures/crossing.h"

#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scene_image_builder.h"
#include "toolchain/figures/scene_facts.h"

namespace godobject::figures {
namespace {

/// A body of two points at plus and minus 0.1 m along x of its mesh frame; its body frame is rotated.
test::SceneImage dumbbell() {
  test::SceneDescription description;
  description.distance = [](const Vector3& p) { return p.norm() - 0.02; };
  description.surface_min = Vector3::Constant(-0.02);
  description.surface_max = Vector3::Constant(0.02);
  description.points = {Vector3(0, 0.1, 0), Vector3(0, -0.1, 0)};
  description.H_MB = {exp_rotation(Vector3(0, 0, -std::numbers::pi / 2)), Vector3::Zero()};
  return test::build_scene_image(description);
}

ReplayRow at(double t, const Vector3& rotation, double z) {
  ReplayRow row;
  row.t = t;
  row.H_WS = {exp_rotation(rotation), Vector3(0, 0, z)};
  return row;
}

TEST(Crossing, IsThatOfTheFurthestPointAndCycle) {
  const test::SceneImage image = dumbbell();
  const SceneView scene = test::open_scene(image);
  const Barrier floor{.point = Vector3(0, 0, 0.01), .normal = Vector3(0, 0, 1)};
  const Vector3 upright(0, std::numbers::pi / 2, 0);  // takes the mesh's x to -z
  const ReplayLog log = {at(0.0, Vector3::Zero(), 0.05), at(0.1, upright, 0.08), at(0.2, Vector3::Zero(), 0.005)};
  const Crossing crossing = furthest_crossing(log, scene, floor);
  EXPECT_NEAR(crossing.distance, 0.03, 1e-8);  // 0.08 - 0.1 = -0.02, 0.03 below 0.01; points are floats
  EXPECT_EQ(crossing.t, 0.1);
}

TEST(Crossing, IsZeroOnTheRightSide) {
  const test::SceneImage image = dumbbell();
  const SceneView scene = test::open_scene(image);
  const Barrier floor{.point = Vector3::Zero(), .normal = Vector3(0, 0, 1)};
  EXPECT_EQ(furthest_crossing({at(0.0, Vector3::Zero(), 0.05)}, scene, floor).distance, 0.0);
}

TEST(SceneFacts, AreThoseOfTheImage) {
  const test::SceneImage image = dumbbell();
  SceneView scene = test::open_scene(image);
  scene.grid.voxel_size = 0.0005;
  scene.settings.friction = 0;
  EXPECT_EQ(scene_facts(scene), fmt::format("Voxels of 0.5 mm, 2 points of the moving body in {} levels, no friction.",
                                            scene.body.level_count));
  scene.settings.friction = 1;
  scene.settings.friction_static = 0.2;
  scene.settings.friction_kinetic = 0.18;
  const std::string facts = scene_facts(scene);
  EXPECT_NE(facts.find("friction 0.2 (static) and 0.18 (kinetic)."), std::string::npos) << facts;
}

}  // namespace
}  // namespace godobject::figures
