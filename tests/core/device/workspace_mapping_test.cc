#include "core/device/workspace_mapping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/random.h"

namespace godobject {
namespace {

using test::Random;

constexpr double kCyclePeriod = 1e-3;

double distance(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm() + log_rotation(a.rotation.conjugate() * b.rotation).norm();
}

WorkspaceMappingParameters any_parameters(Random& random) {
  return {set_matrix(random.motion(0.5, 3.0)), random.between(0.2, 5.0), 0.2};
}

TEST(WorkspaceMapping, IdentityLeavesEverythingAsItIs) {
  Random random(1);
  const Pose start = set_matrix(random.motion(0.5, 3.0));
  WorkspaceMapping mapping({}, start);
  EXPECT_LT(distance(mapping.scene_pose(), start), 1e-14);
  const Pose next = set_matrix(random.motion(0.5, 3.0));
  ASSERT_EQ(mapping.update(next, true, kCyclePeriod), Status::kOk);
  EXPECT_LT(distance(mapping.scene_pose(), next), 1e-14);
  const Wrench F = {random.in_cube(5.0), random.in_cube(1.0)};
  EXPECT_LT((mapping.wrench_at_hand(F).force - F.force).norm(), 1e-14);
  EXPECT_LT((mapping.wrench_at_hand(F).torque - F.torque).norm(), 1e-14);
}

TEST(WorkspaceMapping, ScalesTranslationsAndKeepsAngles) {
  WorkspaceMappingParameters parameters;
  parameters.H_WR = {exp_rotation(Vector3(0.0, 0.0, 0.5 * M_PI)), Vector3(1.0, 2.0, 3.0)};
  parameters.scale = 4.0;
  Pose H_RG;
  H_RG.translation = Vector3(0.1, 0.0, 0.2);
  WorkspaceMapping mapping(parameters, H_RG);
  EXPECT_LT((mapping.scene_pose().translation - Vector3(1.0, 2.4, 3.8)).norm(), 1e-14);
  H_RG.translation.x() += 0.01;
  H_RG.rotation = exp_rotation(Vector3(0.3, 0.0, 0.0));  // about x of the room, y of the scene
  ASSERT_EQ(mapping.update(H_RG, true, kCyclePeriod), Status::kOk);
  EXPECT_LT((mapping.scene_pose().translation - Vector3(1.0, 2.44, 3.8)).norm(), 1e-14);
  const Quaternion turned = mapping.scene_pose().rotation * parameters.H_WR.rotation.conjugate();
  EXPECT_LT((log_rotation(turned) - Vector3(0.0, 0.3, 0.0)).norm(), 1e-14);
}

TEST(WorkspaceMapping, PowerAtTheHandIsPowerInTheScene) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    Pose H_RG = set_matrix(random.motion(0.5, 3.0));
    WorkspaceMapping mapping(any_parameters(random), H_RG);
    // clutch several times, to get any offset
    for (int k = 0; k < 300; ++k) {
      H_RG = H_RG * set_matrix(random.motion(0.001, 0.01));
      ASSERT_EQ(mapping.update(H_RG, k % 200 > 50, kCyclePeriod), Status::kOk);
    }
    while (mapping.engagement() < 1.0) ASSERT_EQ(mapping.update(H_RG, true, kCyclePeriod), Status::kOk);

    const Motion velocity_R = {random.in_cube(1.0), random.in_cube(2.0)};
    const Motion velocity_W = mapping.velocity_in_scene(velocity_R);
    // the velocity is that of the mapped pose
    constexpr double kStep = 1e-6;
    Pose moved = H_RG;
    moved.translation += kStep * velocity_R.translation;
    moved.rotation = exp_rotation(kStep * velocity_R.rotation) * H_RG.rotation;
    const Pose before = mapping.scene_pose();
    ASSERT_EQ(mapping.update(moved, true, kCyclePeriod), Status::kOk);
    const Pose after = mapping.scene_pose();
    ASSERT_LT(((after.translation - before.translation) / kStep - velocity_W.translation).norm(), 1e-8);
    ASSERT_LT((log_rotation(after.rotation * before.rotation.conjugate()) / kStep - velocity_W.rotation).norm(), 1e-8);

    const Wrench F_G_W = {random.in_cube(10.0), random.in_cube(1.0)};
    const Wrench F_G_R = mapping.wrench_at_hand(F_G_W);
    const double in_scene = F_G_W.force.dot(velocity_W.translation) + F_G_W.torque.dot(velocity_W.rotation);
    const double at_hand = F_G_R.force.dot(velocity_R.translation) + F_G_R.torque.dot(velocity_R.rotation);
    ASSERT_NEAR(at_hand, in_scene, 1e-11) << i;
  }
}

TEST(WorkspaceMapping, StiffnessAtTheHandIsScaleSquaredOfTheScenes) {
  for (const double scale : {0.1, 1.0, 3.0}) {
    WorkspaceMappingParameters parameters;
    parameters.H_WR.rotation = exp_rotation(Vector3(0.4, -0.8, 0.3));
    parameters.scale = scale;
    Pose H_RG;
    WorkspaceMapping mapping(parameters, H_RG);
    const Pose rest = mapping.scene_pose();
    const Vector3 hand(0.003, -0.001, 0.002);
    const Vector3 turn(0.001, 0.002, -0.003);
    H_RG.translation = hand;
    H_RG.rotation = exp_rotation(turn);
    ASSERT_EQ(mapping.update(H_RG, true, kCyclePeriod), Status::kOk);
    const double k = 1000.0;
    const double k_r = 25.0;
    const Pose& H_WG = mapping.scene_pose();
    const Wrench F_G_W = {-k * (H_WG.translation - rest.translation),
                          -k_r * log_rotation(H_WG.rotation * rest.rotation.conjugate())};
    const Wrench F_G_R = mapping.wrench_at_hand(F_G_W);
    EXPECT_LT((F_G_R.force + scale * scale * k * hand).norm(), 1e-12 * k);
    EXPECT_LT((F_G_R.torque + k_r * turn).norm(), 1e-12 * k_r);
  }
}

TEST(WorkspaceMapping, ClutchingMovesNeitherPoseNorForceAtOnce) {
  Random random(3);
  Pose H_RG = set_matrix(random.motion(0.5, 3.0));
  const WorkspaceMappingParameters parameters = any_parameters(random);
  WorkspaceMapping mapping(parameters, H_RG);
  const Wrench F_G_W = {Vector3(3.0, -4.0, 12.0), Vector3(0.3, 0.4, 1.2)};
  Pose last = mapping.scene_pose();
  Wrench last_wrench = mapping.wrench_at_hand(F_G_W);
  int changes = 0;
  bool closed = true;
  for (int k = 0; k < 20000; ++k) {
    const bool was_closed = closed;
    if (random.integer(0, 99) == 0) closed = !closed;
    changes += closed != was_closed ? 1 : 0;
    const Motion step = random.motion(1e-4, 1e-3);
    H_RG = H_RG * set_matrix(step);
    ASSERT_EQ(mapping.update(H_RG, closed, kCyclePeriod), Status::kOk);
    const Motion moved = get_motion(last.inverse() * mapping.scene_pose());
    if (closed && was_closed) {
      ASSERT_NEAR(moved.translation.norm(), parameters.scale * step.translation.norm(), 1e-13);
      ASSERT_NEAR(moved.rotation.norm(), step.rotation.norm(), 1e-13);
    } else {
      ASSERT_LT(distance(last, mapping.scene_pose()), 1e-13) << k;
    }
    const Wrench wrench = mapping.wrench_at_hand(F_G_W);
    // a step is at most 1/200 of the whole, because the fade time is 200 cycles
    ASSERT_LE((wrench.force - last_wrench.force).norm(), parameters.scale * 13.0 / 200.0 * (1.0 + 1e-9));
    ASSERT_LE((wrench.torque - last_wrench.torque).norm(), 1.3 / 200.0 * (1.0 + 1e-9));
    last = mapping.scene_pose();
    last_wrench = wrench;
  }
  EXPECT_GT(changes, 100);
}

TEST(WorkspaceMapping, OpenClutchIsAtRestAndWithoutForceInTheEnd) {
  WorkspaceMapping mapping({}, Pose());
  Pose away;
  away.translation.x() = 1.0;
  const Motion moving = {Vector3::Ones(), Vector3::Ones()};
  for (int k = 0; k < 200; ++k) {
    EXPECT_EQ(mapping.velocity_in_scene(moving).translation, moving.translation) << "damping fades with the wrench";
    ASSERT_EQ(mapping.update(away, false, kCyclePeriod), Status::kOk);
  }
  EXPECT_NEAR(mapping.engagement(), 0.0, 1e-12);
  EXPECT_LT(mapping.wrench_at_hand({Vector3::Ones(), Vector3::Ones()}).force.norm(), 1e-12);
  EXPECT_EQ(mapping.velocity_in_scene(moving).translation.norm(), 0.0);
  EXPECT_LT(distance(mapping.scene_pose(), Pose()), 1e-15);
}

TEST(WorkspaceMapping, ManyClutchingsDoNotDrift) {
  Random random(4);
  WorkspaceMapping mapping(any_parameters(random), Pose());
  const Pose start = mapping.scene_pose();
  const Pose other = set_matrix(random.motion(0.5, 3.0));
  // move there and back, and open and close the clutch at both ends
  for (int k = 0; k < 100000; ++k) {
    for (const Pose& end : {other, Pose()}) {
      ASSERT_EQ(mapping.update(end, true, kCyclePeriod), Status::kOk);
      ASSERT_EQ(mapping.update(end, false, kCyclePeriod), Status::kOk);
      ASSERT_EQ(mapping.update(end, true, kCyclePeriod), Status::kOk);
    }
  }
  EXPECT_LT(distance(mapping.scene_pose(), start), 1e-10);
  EXPECT_NEAR(mapping.scene_pose().rotation.norm(), 1.0, 1e-14);
}

TEST(WorkspaceMapping, RefusesAPoseThatIsNotFinite) {
  WorkspaceMapping mapping({}, Pose());
  Pose bad;
  bad.rotation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(mapping.update(bad, false, kCyclePeriod), Status::kNotFinite);
  EXPECT_EQ(mapping.engagement(), 1.0);
  EXPECT_LT(distance(mapping.scene_pose(), Pose()), 1e-15);
}

}  // namespace
}  // namespace godobject
