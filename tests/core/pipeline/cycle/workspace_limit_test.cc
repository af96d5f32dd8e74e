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

/// A body that yields along each axis by a share of the push. Returns the number of solves.
int push_with(const WorkspaceBox& box, double tolerance, const Vector3& target, const Matrix3& yield, Vector3& push,
              bool& converged) {
  int calls = 0;
  push.setZero();
  converged = push_within(box, tolerance, [&](const Vector3& wanted) noexcept {
    ++calls;
    // a push that would turn into a pull ends at zero first
    EXPECT_TRUE((push.cwiseProduct(wanted).array() >= 0.0).all()) << push.transpose() << " then " << wanted.transpose();
    push = wanted;
    return Vector3(target - yield * wanted);
  });
  return calls;
}

TEST(PushWithin, FindsThePushOfEachFaceInTwoStepsWhereAxesAreFree) {
  Random random(2);
  int solves[4] = {0, 0, 0, 0};
  for (int i = 0; i < 5000; ++i) {
    const WorkspaceBox box = box_of(Vector3(-0.1, -0.2, -0.3), Vector3(0.1, 0.2, 0.3));
    const Vector3 target = random.in_cube(0.6);
    const Vector3 yields(random.between(0.03, 1.0), i % 2 == 0 ? 1.0 : random.between(0.03, 1.0), 1.0);
    Vector3 push;
    bool converged = false;
    const int calls = push_with(box, 1e-9, target, yields.asDiagonal(), push, converged);
    ASSERT_TRUE(converged) << i;
    ASSERT_LE(calls, 3) << i;
    ++solves[calls];
    const Vector3 end = target - yields.cwiseProduct(push);
    ASSERT_LT((end - box.nearest(end)).norm(), 2e-9) << i;
    for (int axis = 0; axis < 3; ++axis) {
      const double beyond = target[axis] - box.nearest(target)[axis];
      ASSERT_NEAR(yields[axis] * push[axis], beyond, 2e-9) << i;  // no push without need, and onto the face, not beyond
    }
  }
  EXPECT_GT(solves[1], 50);  // the target was inside
  EXPECT_GT(solves[2], 50);
  EXPECT_GT(solves[3], 50);
}

/// Contacts couple the axes: a push along one moves the others. At the solution each face either pushes and is met, or
/// does not push and is not crossed.
TEST(PushWithin, FindsPushesThatFacesCanGiveWhereAxesAreCoupled) {
  Random random(3);
  int found = 0;
  constexpr int kCases = 5000;
  for (int i = 0; i < kCases; ++i) {
    const WorkspaceBox box = box_of(Vector3::Constant(-0.1), Vector3::Constant(0.1));
    const Vector3 target = random.in_cube(0.2);
    // a projection onto a plane of contact, softened: symmetric, with eigenvalues of 0 to 1
    const Vector3 n = random.direction();
    const Matrix3 yield = Matrix3::Identity() - random.between(0.0, 0.9) * n * n.transpose();
    Vector3 push;
    bool converged = false;
    const int calls = push_with(box, 1e-6, target, yield, push, converged);
    ASSERT_LE(calls, 7) << i;
    const Vector3 end = target - yield * push;
    const double beyond = (end - box.nearest(end)).cwiseAbs().maxCoeff();
    if (!converged) {
      ASSERT_EQ(calls, 7) << i;
      continue;
    }
    ++found;
    ASSERT_LE(beyond, 1e-6) << i;
    for (int axis = 0; axis < 3; ++axis) {
      if (push[axis] > 0.0) {
        ASSERT_NEAR(end[axis], box.high[axis], 1e-6) << i;
      }
      if (push[axis] < 0.0) {
        ASSERT_NEAR(end[axis], box.low[axis], 1e-6) << i;
      }
    }
  }
  EXPECT_GT(found, kCases * 7 / 10);
}

/// Along an axis the end moves by at most the push, so a push that grows by less than what is missing cannot suffice.
TEST(PushWithin, GrowsAPushByNoLessThanIsMissing) {
  Random random(5);
  int steps = 0;
  for (int i = 0; i < 2000; ++i) {
    const WorkspaceBox box = box_of(Vector3::Constant(-0.1), Vector3::Constant(0.1));
    const Vector3 target = random.in_cube(0.2);
    const Vector3 n = random.direction();
    const Matrix3 yield = Matrix3::Identity() - random.between(0.0, 0.9) * n * n.transpose();
    Vector3 last = Vector3::Zero();
    Vector3 missing = Vector3::Zero();  // to the face of each axis that is pushed, or crossed
    push_within(box, 1e-6, [&](const Vector3& push) noexcept {
      const Vector3 end = target - yield * push;
      for (int axis = 0; axis < 3; ++axis) {
        const bool let_go = push[axis] == 0.0 && last[axis] != 0.0;  // a face does not pull
        if (!let_go) {
          EXPECT_GE(std::fabs(push[axis] - last[axis]), std::fabs(missing[axis]) - 1e-12) << i << ", axis " << axis;
        }
        steps += missing[axis] != 0.0 ? 1 : 0;
        const double nearest = box.nearest(end)[axis];
        missing[axis] = end[axis] - (push[axis] > 0.0 ? 0.1 : push[axis] < 0.0 ? -0.1 : nearest);
      }
      last = push;
      return end;
    });
  }
  EXPECT_GT(steps, 5000);
}

/// By hand: the face at x = 0.1 pushes by 0.1. This moves y from 0.095 to 0.105, beyond its face. Each push p, q moves
/// the other axis outwards by a tenth of it: p - 0.1 q = 0.1 and q - 0.1 p = -0.005, so q = 0.005 / 0.99.
TEST(PushWithin, FollowsAPushThatMovesAnotherAxisOutOfTheBox) {
  const WorkspaceBox box = box_of(Vector3::Constant(-0.1), Vector3::Constant(0.1));
  for (int axis = 0; axis < 3; ++axis) {
    const int other = (axis + 1) % 3;
    for (const double side : {-1.0, 1.0}) {
      Matrix3 yield = Matrix3::Identity();
      yield(axis, other) = yield(other, axis) = -0.1;
      Vector3 target = Vector3::Zero();
      target[axis] = side * 0.2;
      target[other] = side * 0.095;
      Vector3 push;
      bool converged = false;
      push_with(box, 1e-5, target, yield, push, converged);
      EXPECT_TRUE(converged);
      EXPECT_NEAR(push[axis], side * (0.1 + 0.0005 / 0.99), 2e-5);
      EXPECT_NEAR(push[other], side * 0.005 / 0.99, 2e-5);
    }
  }
}

TEST(PushWithin, GivesUpWhereTheBodyDoesNotYield) {
  const WorkspaceBox box = box_of(Vector3::Constant(-0.1), Vector3::Constant(0.1));
  Vector3 push;
  bool converged = true;
  EXPECT_EQ(push_with(box, 1e-9, {0.2, 0.0, 0.0}, Matrix3::Zero(), push, converged), 7);
  EXPECT_FALSE(converged);
  // within the tolerance nothing is pushed
  EXPECT_EQ(push_with(box, 1e-3, {0.1009, -0.1009, 0.0}, Matrix3::Zero(), push, converged), 1);
  EXPECT_TRUE(converged);
  EXPECT_TRUE(push.isZero(0.0));
  EXPECT_EQ(push_with(box, 1e-3, {0.0, -0.1011, 0.0}, Matrix3::Zero(), push, converged), 7);
  EXPECT_FALSE(converged);
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
