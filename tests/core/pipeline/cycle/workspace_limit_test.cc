#include "core/pipeline/cycle/workspace_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/random.h"

namespace godobject::test::workspace_limit_test {
namespace {

WorkspaceBox box_of(const Vector3& low, const Vector3& high) {
  WorkspaceBox box;
  box.limited = true;
  box.low = low;
  box.high = high;
  return box;
}

Pose pose_at(const Vector3& p, const Vector3& r = Vector3::Zero()) { return {exp_rotation(r), p}; }

/// Returns the share of the line from p0 to p1 that is in the box, by bisection. p0 is in the box.
double share_inside(const WorkspaceBox& box, const Vector3& p0, const Vector3& p1) {
  double inside = 0.0;
  double outside = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    const Vector3 p = p0 + middle * (p1 - p0);
    const bool within = ((p - box.low).array() >= 0.0).all() && ((box.high - p).array() >= 0.0).all();
    (within ? inside : outside) = middle;
  }
  return inside;
}

TEST(ClippedTo, EndsWhereTheOriginMeetsTheFirstFace) {
  Random random(1);
  int cut = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector3 low = random.in_cube(1.0);
    const Vector3 high = low + Vector3(random.between(0.0, 1.0), random.between(0.0, 1.0), random.between(0.1, 1.0));
    const WorkspaceBox box = box_of(low, high);
    const auto in_box = [&](int axis) { return random.between(low[axis], high[axis]); };
    Vector3 from(in_box(0), in_box(1), in_box(2));
    if (i % 5 == 0) from[i % 3] = i % 2 == 0 ? low[i % 3] : high[i % 3];  // starts at a face
    const Pose H0 = pose_at(from, random.motion(0.0, 3.0).rotation);
    Pose H1 = H0 * set_matrix(random.motion(1.5, 3.0));
    if (i % 7 == 0) H1.translation[i % 3] = H0.translation[i % 3];  // moves along a face
    const Pose end = clipped_to(box, H0, H1);
    ASSERT_TRUE(box.contains(end.translation)) << i;
    if (box.contains(H1.translation)) {
      ASSERT_TRUE(end == H1) << i;
      continue;
    }
    ++cut;
    const double share = share_inside(box, H0.translation, H1.translation);
    // the bisection rounds where the origin leaves a face slowly: 1e-16 m of a motion of 1e-4 m
    ASSERT_LT((end.translation - H0.translation - share * (H1.translation - H0.translation)).norm(), 1e-10) << i;
    // the rotation is shortened with it
    const Vector3 whole = log_rotation(H0.rotation.conjugate() * H1.rotation);
    const Vector3 turned = log_rotation(H0.rotation.conjugate() * end.rotation);
    ASSERT_LT((turned - share * whole).norm(), 1e-9) << i;
  }
  EXPECT_GT(cut, 1000);
}

TEST(ClippedTo, ChangesNothingWithoutABox) {
  WorkspaceBox box = box_of(Vector3::Constant(-0.1), Vector3::Constant(0.1));
  box.limited = false;
  const Pose far = pose_at({1.0, -2.0, 3.0}, {0.1, 0.2, 0.3});
  EXPECT_TRUE(clipped_to(box, Pose(), far) == far);
}

/// By hand: b_D = 20 Ns/m and k_D = 2000 N/m, doubled by k_VC,x = 2.
TEST(WorkspacePush, IsASpringAndADamperAlongEachAxis) {
  Parameters q;
  q.coupling_translation = 2.0;
  const Vector3 back(0.001, 0.0, -0.002);
  DeviceForce push = workspace_push(back, Vector3::Zero(), q);
  EXPECT_LT((push.spring_W.force - Vector3(4.0, 0.0, -8.0)).norm(), 1e-12);
  EXPECT_LT((push.total_W.force - Vector3(4.0, 0.0, -8.0)).norm(), 1e-12);
  push = workspace_push(back, {-0.1, 0.3, 0.1}, q);  // outwards along x and z, along the face in y
  EXPECT_LT((push.total_W.force - Vector3(8.0, 0.0, -12.0)).norm(), 1e-12);
  EXPECT_LT((push.spring_W.force - Vector3(4.0, 0.0, -8.0)).norm(), 1e-12);
  push = workspace_push(back, {0.05, 0.0, -0.1}, q);  // back into the box
  EXPECT_LT((push.total_W.force - Vector3(2.0, 0.0, -4.0)).norm(), 1e-12);
  push = workspace_push(back, {1.0, 0.0, -1.0}, q);  // fast: no pull
  EXPECT_TRUE(push.total_W.force.isZero(0.0));
  EXPECT_TRUE(push.total_W.torque.isZero(0.0) && push.spring_W.torque.isZero(0.0));
  // an axis without push is not damped, however small the others are
  push = workspace_push({0.0, 1e-300, 0.0}, {1.0, -1.0, 1.0}, q);
  EXPECT_LT((push.total_W.force - Vector3(0.0, 40.0, 0.0)).norm(), 1e-12);
}

/// The pose is moved to the nearest one in the box, and both ways add up to the device. The push is that of the way
/// back.
TEST(InputWithin, MovesTheDeviceIntoTheBox) {
  Random random(2);
  Parameters q;
  q.workspace = box_of(Vector3(-0.1, -0.2, -0.3), Vector3(0.1, 0.2, 0.3));
  int outside = 0;
  for (int i = 0; i < 500; ++i) {
    const Pose device = pose_at(random.in_cube(0.4), random.in_cube(1.0));
    const Motion velocity = random.motion(0.1, 0.2);
    const CycleInput input = input_within(device, velocity, q);
    EXPECT_EQ(input.H_WD.translation, q.workspace.nearest(device.translation));
    EXPECT_EQ(input.H_WD.rotation.coeffs(), device.rotation.coeffs());
    EXPECT_EQ(input.velocity_W.translation, velocity.translation);
    EXPECT_EQ(input.velocity_W.rotation, velocity.rotation);
    EXPECT_LT((input.H_WD.translation + input.beyond_W - device.translation).norm(), 1e-15);
    EXPECT_EQ(input.outside, !q.workspace.contains(device.translation));
    const DeviceForce push = workspace_push(input.H_WD.translation - device.translation, velocity.translation, q);
    EXPECT_EQ(input.push.spring_W.force, push.spring_W.force);
    EXPECT_EQ(input.push.total_W.force, push.total_W.force);
    outside += input.outside ? 1 : 0;
  }
  EXPECT_GT(outside, 100);
  EXPECT_LT(outside, 495);
  // a god object aims no farther than 100 m beyond the box, of 10 mm times 10^4; the push is that of the whole way
  q.mass.radius = 0.01;
  q.voxel_size = 0.002;
  for (const double distance : {99.0, 1e3, 1e150, 1e300}) {
    const CycleInput far = input_within(pose_at({0.0, 0.2 + distance, 0.0}, Vector3::Zero()), {}, q);
    EXPECT_NEAR(far.beyond_W.y(), std::min(distance, 100.0), 1e-9) << distance;
    EXPECT_NEAR(far.push.spring_W.force.y() / distance, -q.stiffness * q.coupling_translation, 1.0);
  }
  q.workspace.limited = false;
  const Pose far = pose_at({1.0, -2.0, 3.0}, {0.1, 0.2, 0.3});
  const CycleInput input = input_within(far, {}, q);
  EXPECT_TRUE(input.H_WD == far);
  EXPECT_FALSE(input.outside);
  EXPECT_TRUE(input.beyond_W.isZero(0.0));
}

TEST(PushFaces, AreTheSixHalfSpacesOfTheBox) {
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    const WorkspaceBox box = box_of(Vector3(-0.1, -0.2, -0.3), Vector3(0.4, 0.5, 0.6));
    const Pose H_WS = pose_at(Vector3(0.1, 0.2, 0.3) + random.in_cube(0.1), random.motion(0.0, 3.0).rotation);
    std::vector<std::pair<Vector3, double>> faces;
    push_faces(box, H_WS, [&](const Vector3& normal, double gain) { faces.emplace_back(normal, gain); });
    ASSERT_EQ(faces.size(), 6u);
    for (int k = 0; k < 50; ++k) {
      const Vector3 x = random.in_cube(0.6);
      const Vector3 end = H_WS * x;
      bool meets_all = true;
      for (const auto& [normal, gain] : faces) {
        ASSERT_NEAR(normal.norm(), 1.0, 1e-14);
        meets_all = meets_all && normal.dot(x) >= gain;
      }
      ASSERT_EQ(meets_all, box.contains(end)) << i;
    }
  }
}

}  // namespace
}  // namespace godobject::test::workspace_limit_test
