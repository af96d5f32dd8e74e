#include "core/pipeline/cycle/parameters.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/random.h"
#include "tests/support/scene_image_builder.h"

namespace godobject::test::parameters_test {
namespace {

/// Moments 1, 2 and 2.5 (10^-4 m^2): sums of two second moments 1.75, 0.75 and 0.25. The semi-axes squared are five
/// times the second moments; the determinant is 5 (10^-12 m^6).
TEST(MassModel, IsThatOfABodyByHand) {
  const MassModel mass = MassModel::make(Vector3(1e-4, 2e-4, 2.5e-4), 0.07, 0.08);
  EXPECT_LT((mass.inertia - Vector3(1e-4, 2e-4, 2.5e-4)).norm(), 1e-18);
  EXPECT_LT((mass.inverse_inertia - Vector3(1e4, 5e3, 4e3)).norm(), 1e-9);
  EXPECT_NEAR(mass.sigma, 1.7099759466766968e-4, 1e-15);
  EXPECT_LT((mass.ellipsoid - Vector3(8.75e-4, 3.75e-4, 1.25e-4)).norm(), 1e-17);
  EXPECT_EQ(mass.radius, 0.07);
  EXPECT_EQ(mass.sphere.radius, 0.07);
  EXPECT_TRUE(mass.sphere.center.isZero(0.0));
}

/// A solid ball is its own ellipsoid.
TEST(MassModel, HasTheEllipsoidOfTheSameMoments) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 squares(random.between(0.1, 1.0), random.between(0.1, 1.0), random.between(0.1, 1.0));
    // the moments of a solid ellipsoid with these squared semi-axes
    const Vector3 moments = 0.2 * (Vector3::Constant(squares.sum()) - squares);
    const MassModel mass = MassModel::make(moments, 1.0, 1.0);
    ASSERT_LT((mass.ellipsoid - squares).norm(), 1e-14);
    ASSERT_NEAR(mass.inertia.cwiseProduct(mass.inverse_inertia).prod(), 1.0, 1e-14);
    ASSERT_NEAR(mass.sigma * mass.sigma * mass.sigma, moments.prod(), 1e-14);
  }
}

/// A hundredth of the largest moment, and a thousandth of the extent squared, at least. Each bound wins once.
TEST(MassModel, HasInertiaAboutEveryAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    Vector3 needle = Vector3::Constant(3e-4);
    needle[axis] = 1e-9;
    const MassModel mass = MassModel::make(needle, 0.03, 0.03);
    EXPECT_NEAR(mass.inertia[axis], 3e-6, 1e-18);
    EXPECT_NEAR(mass.inverse_inertia[axis], 1.0 / 3e-6, 1e-6);
    EXPECT_EQ(mass.inertia[(axis + 1) % 3], 3e-4);
    EXPECT_GT(mass.ellipsoid[axis], 1e-3);
    EXPECT_NEAR(mass.ellipsoid[(axis + 1) % 3], 2.5e-9, 1e-16);  // 2.5 (1e-9 + 3e-4 - 3e-4): more than a millionth
  }
  const MassModel point = MassModel::make(Vector3::Zero(), 0.001, 0.04);
  EXPECT_LT((point.inertia - Vector3::Constant(1.6e-9)).norm(), 1e-22);
  EXPECT_LT((point.ellipsoid - Vector3::Constant(1.6e-15)).norm(), 1e-28);
  EXPECT_EQ(point.radius, 0.001);
  // a tiny body of some inertia in a long extent: the extent wins
  const MassModel small = MassModel::make(Vector3(1e-9, 2e-9, 3e-9), 0.04, 0.04);
  EXPECT_LT((small.inertia - Vector3(1.6e-9, 2e-9, 3e-9)).norm(), 1e-22);
  // a flat body: squared semi-axes of 0, 5e-4 and 5e-4, of which the first becomes a millionth of the others
  const MassModel flat = MassModel::make(Vector3(2e-4, 1e-4, 1e-4), 0.05, 0.05);
  EXPECT_LT((flat.ellipsoid - Vector3(5e-10, 5e-4, 5e-4)).norm(), 1e-17);
}

TEST(Parameters, BeginWithTheDefaultsOfTheSceneFile) {
  const Parameters q;
  EXPECT_EQ(q.period, 1e-3);
  EXPECT_EQ(q.safety_distance, 3e-3);
  EXPECT_EQ(q.voxel_size, 2e-3);
  EXPECT_EQ(q.margin, 2e-5);
  EXPECT_EQ(q.correction_gain, 0.2);
  EXPECT_EQ(q.stiffness, 2000.0);
  EXPECT_EQ(q.damping, 20.0);
  EXPECT_EQ(q.coupling_translation, 1.0);
  EXPECT_EQ(q.coupling_rotation, 0.025);
  EXPECT_EQ(q.point_budget, std::numeric_limits<std::uint32_t>::max());
  EXPECT_EQ(q.friction.static_ratio + q.friction.kinetic_ratio + q.friction.viscous, 0.0);
  EXPECT_EQ(q.paper_friction.translation_static + q.paper_friction.translation_kinetic, 0.0);
  EXPECT_EQ(q.paper_friction.rotation_static + q.paper_friction.rotation_kinetic + q.paper_friction.viscous, 0.0);
  EXPECT_FALSE(q.workspace.limited);
  EXPECT_EQ(q.mass.inertia, Vector3::Ones());
  EXPECT_EQ(q.mass.sigma, 1.0);
  EXPECT_EQ(q.mass.radius, 1.0);
}

/// A scene with another number in each place: none may be mistaken for another.
SceneView scene_of_numbers() {
  SceneView scene;
  format::Settings& s = scene.settings;
  s.point_budget = 17;
  s.safety_distance = 0.011;
  s.margin = 0.012;
  s.stiffness = 13.0;
  s.damping = 14.0;
  s.coupling_translation = 15.0;
  s.coupling_rotation = 16.0;
  s.friction_static = 0.21;
  s.friction_kinetic = 0.22;
  s.friction_viscous = 0.23;
  s.paper_rotation_static = 0.24;
  s.paper_rotation_kinetic = 0.25;
  s.paper_viscous = 0.26;
  s.period = 0.27e-3;
  scene.grid.voxel_size = 0.027;
  scene.body.inertia[0] = 0.031;
  scene.body.inertia[1] = 0.032;
  scene.body.inertia[2] = 0.033;
  scene.body.radius = 0.34;
  scene.body.sphere_center[0] = 0.35;
  scene.body.sphere_center[1] = 0.36;
  scene.body.sphere_center[2] = 0.37;
  scene.body.sphere_radius = 0.38;
  scene.workspace.limited = true;
  scene.workspace.low = Vector3(-1.0, -2.0, -3.0);
  scene.workspace.high = Vector3(1.0, 2.0, 3.0);
  return scene;
}

TEST(Parameters, TakeEachNumberOfTheSceneToItsPlace) {
  const Parameters q = Parameters::make(scene_of_numbers());
  EXPECT_EQ(q.period, 0.27e-3);
  EXPECT_EQ(q.correction_gain, 0.2);
  EXPECT_EQ(q.point_budget, 17u);
  EXPECT_EQ(q.safety_distance, 0.011);
  EXPECT_EQ(q.margin, 0.012);
  EXPECT_EQ(q.stiffness, 13.0);
  EXPECT_EQ(q.damping, 14.0);
  EXPECT_EQ(q.coupling_translation, 15.0);
  EXPECT_EQ(q.coupling_rotation, 16.0);
  EXPECT_EQ(q.friction.static_ratio, 0.21);
  EXPECT_EQ(q.friction.kinetic_ratio, 0.22);
  EXPECT_EQ(q.friction.viscous, 0.23);
  EXPECT_EQ(q.paper_friction.translation_static, 0.21);
  EXPECT_EQ(q.paper_friction.translation_kinetic, 0.22);
  EXPECT_EQ(q.paper_friction.rotation_static, 0.24);
  EXPECT_EQ(q.paper_friction.rotation_kinetic, 0.25);
  EXPECT_EQ(q.paper_friction.viscous, 0.26);
  EXPECT_EQ(q.voxel_size, 0.027);
  EXPECT_EQ(q.mass.inertia, Vector3(0.031, 0.032, 0.033));
  EXPECT_EQ(q.mass.radius, 0.34);
  EXPECT_EQ(q.mass.sphere.center, Vector3(0.35, 0.36, 0.37));
  EXPECT_EQ(q.mass.sphere.radius, 0.38);
  EXPECT_TRUE(q.workspace.limited);
  EXPECT_EQ(q.workspace.low, Vector3(-1.0, -2.0, -3.0));
  EXPECT_EQ(q.workspace.high, Vector3(1.0, 2.0, 3.0));
}

TEST(Parameters, HaveNoBudgetWhereTheSceneHasNone) {
  SceneView scene = scene_of_numbers();
  scene.settings.point_budget = 0;
  EXPECT_EQ(Parameters::make(scene).point_budget, std::numeric_limits<std::uint32_t>::max());
  scene.settings.point_budget = 1;
  EXPECT_EQ(Parameters::make(scene).point_budget, 1u);
}

/// The extent that replaces the inertia of a point is its radius, or a voxel if that is larger.
TEST(Parameters, GiveAPointTheExtentOfAVoxel) {
  SceneView scene = scene_of_numbers();
  for (double& moment : scene.body.inertia) moment = 0.0;
  EXPECT_NEAR(Parameters::make(scene).mass.inertia.x(), 1e-6 * 0.34 * 0.34, 1e-18);
  scene.body.radius = 1e-9;
  EXPECT_NEAR(Parameters::make(scene).mass.inertia.x(), 1e-6 * 0.027 * 0.027, 1e-20);
}

}  // namespace
}  // namespace godobject::test::parameters_test
