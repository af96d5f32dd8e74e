// A session and its input: frames, refusals, and the effects of the workspace.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/random.h"
#include "tests/support/small_scenes.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::test::compiled_session_test {
namespace {

constexpr double kFarthest = 1e7;
const double kNotNumbers[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity()};

/// A ball of 20 mm whose mesh frame is shifted and turned, over a plate with its top at z = 10 mm.
SceneImage image_with(const std::optional<format::Workspace>& workspace = std::nullopt) {
  const SurfaceSamples ball = sample_ball(0.02, 200);
  SceneDescription description;
  const Vector3 half_edges(0.05, 0.05, 0.01);
  description.distance = [half_edges](const Vector3& p) { return box_distance(p, half_edges); };
  description.surface_min = -half_edges;
  description.surface_max = half_edges;
  description.voxel_size = 0.004;
  description.points = ball.points;
  description.normals = ball.normals;
  description.H_MB = {exp_rotation(Vector3(0.3, -0.5, 0.2)), Vector3(0.01, -0.02, 0.03)};
  description.workspace = workspace;
  return build_scene_image(description);
}

class CompiledSessionTest : public testing::TestWithParam<Solver> {
 protected:
  explicit CompiledSessionTest(const std::optional<format::Workspace>& workspace = std::nullopt)
      : image_(image_with(workspace)), scene_(open_scene(image_)) {
    EXPECT_EQ(god_object_.start(scene_, GetParam(), false), Status::kOk);
  }

  Pose mesh_pose(const Vector3& center, const Vector3& turn = Vector3::Zero()) const {
    return Pose{exp_rotation(turn), center} * scene_.H_MB.inverse();
  }
  Status update(const Pose& H_WM, const Motion& velocity = {}) {
    return god_object_->update({H_WM, velocity}, report_);
  }
  /// Presses the ball 2 mm into the plate.
  void press() {
    for (int k = 0; k <= 20; ++k) ASSERT_EQ(update(mesh_pose({0.0, 0.0, 0.031 - 1.5e-4 * k})), Status::kOk);
    ASSERT_GT(report_.force.total_W.force.z(), 0.5);
    ASSERT_GT(report_.contacts, 0u);
  }
  /// Expects the report of a refusal: the god object rests, and nothing is rendered.
  void expect_refusal(const Pose& H_WS) {
    EXPECT_EQ(report_.outcome, Outcome::kBadInput);
    EXPECT_TRUE(report_.H_WS == H_WS);
    EXPECT_TRUE(god_object_.state().H_WS == H_WS);
    for (const Wrench& wrench : {report_.force.spring_W, report_.force.total_W}) {
      EXPECT_TRUE(wrench.force.isZero(0.0) && wrench.torque.isZero(0.0));
    }
    EXPECT_EQ(report_.contacts, 0u);
    EXPECT_EQ(report_.substeps, 0u);
    EXPECT_EQ(report_.penetration, 0.0);
    EXPECT_FALSE(report_.outside);
  }

  SceneImage image_;
  SceneView scene_;
  OwnedGodObject god_object_;
  CycleReport report_;
};

INSTANTIATE_TEST_SUITE_P(Solvers, CompiledSessionTest,
                         testing::Values(Solver::kPaper, Solver::kCorrected, Solver::kContact));

TEST_P(CompiledSessionTest, RefusesEachNumberThatIsNotFiniteAndRests) {
  press();
  const Pose H_WS = god_object_.state().H_WS;
  Pose pose = mesh_pose({0.0, 0.0, 0.028});
  Motion velocity;
  std::vector<double*> numbers;
  for (int i = 0; i < 4; ++i) numbers.push_back(&pose.rotation.coeffs()[i]);
  for (int i = 0; i < 3; ++i) {
    for (Vector3* vector : {&pose.translation, &velocity.translation, &velocity.rotation}) {
      numbers.push_back(&(*vector)[i]);
    }
  }
  for (double* number : numbers) {
    const double good = *number;
    for (const double bad : kNotNumbers) {
      *number = bad;
      ASSERT_EQ(update(pose, velocity), Status::kNotFinite);
      expect_refusal(H_WS);
      if (velocity.translation.allFinite() && velocity.rotation.allFinite()) {
        ASSERT_EQ(god_object_->follow(pose, report_), Status::kNotFinite);
        expect_refusal(H_WS);
      }
    }
    *number = good;
  }
  EXPECT_EQ(update(pose, velocity), Status::kOk);
  EXPECT_GT(report_.force.total_W.force.z(), 0.5) << "the contact is still there";
}

TEST_P(CompiledSessionTest, TakesQuaternionsOfUnitLengthToAThousandth) {
  const Pose good = mesh_pose({0.01, 0.02, 0.1}, {0.4, -0.3, 0.2});
  const Pose expected = good * scene_.H_MB;
  for (const double error : {-0.9e-3, 0.0, 0.9e-3}) {
    Pose pose = good;
    pose.rotation.coeffs() *= 1.0 + error;
    ASSERT_EQ(update(pose), Status::kOk);
    EXPECT_LT((report_.H_WS.translation - expected.translation).norm(), 1e-15);
    EXPECT_LT((report_.H_WS.rotation.coeffs() - expected.rotation.coeffs()).norm(), 1e-15);
    ASSERT_EQ(god_object_->follow(pose, report_), Status::kOk);
    EXPECT_LT((report_.H_WS.rotation.coeffs() - expected.rotation.coeffs()).norm(), 1e-15);
  }
  const Pose H_WS = god_object_.state().H_WS;
  for (const double error : {-1.0, -1.1e-3, 1.1e-3, 1.0}) {
    Pose pose = good;
    pose.rotation.coeffs() *= 1.0 + error;
    ASSERT_EQ(update(pose), Status::kNotUnit) << error;
    expect_refusal(H_WS);
    ASSERT_EQ(god_object_->follow(pose, report_), Status::kNotUnit) << error;
    expect_refusal(H_WS);
  }
}

TEST_P(CompiledSessionTest, TakesCoordinatesAsFarAsAnImageHasThem) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Pose pose;
      pose.translation[axis] = side * kFarthest;
      god_object_->reset();
      ASSERT_EQ(god_object_->follow(pose, report_), Status::kOk);
      ASSERT_EQ(update(pose), Status::kOk);
      const Pose H_WS = god_object_.state().H_WS;
      pose.translation[axis] = side * std::nextafter(kFarthest, 1e8);
      ASSERT_EQ(update(pose), Status::kOutOfRange);
      expect_refusal(H_WS);
      ASSERT_EQ(god_object_->follow(pose, report_), Status::kOutOfRange);
      expect_refusal(H_WS);
    }
  }
}

TEST_P(CompiledSessionTest, SpeaksOfTheMeshAndReportsTheBody) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    Pose pose = set_matrix(random.motion(0.1, 3.0));
    pose.translation.z() += 0.3;
    god_object_->reset();
    ASSERT_EQ(update(pose), Status::kOk);
    EXPECT_EQ(report_.outcome, Outcome::kFree);
    const Pose body = pose * scene_.H_MB;
    EXPECT_LT((report_.H_WS.translation - body.translation).norm(), 1e-15);
    const Pose mesh = god_object_->mesh_pose();
    EXPECT_LT((mesh.translation - pose.translation).norm(), 1e-15);
    EXPECT_LT(log_rotation(mesh.rotation.conjugate() * pose.rotation).norm(), 1e-14);
    EXPECT_TRUE(report_.force.total_W.force.isZero(1e-12));
  }
}

TEST_P(CompiledSessionTest, FollowsWithTheReportOfAFreeCycleAndForgets) {
  press();
  const Pose pose = mesh_pose({0.0, 0.0, 0.0}, {0.1, 0.2, 0.3});  // inside of the plate
  ASSERT_EQ(god_object_->follow(pose, report_), Status::kOk);
  EXPECT_EQ(report_.outcome, Outcome::kFree);
  EXPECT_LT((report_.H_WS.translation - Vector3::Zero()).norm(), 1e-15);
  EXPECT_TRUE(report_.H_WS == god_object_.state().H_WS);
  EXPECT_EQ(report_.contacts + report_.substeps, 0u);
  EXPECT_EQ(report_.penetration, 0.0);
  EXPECT_FALSE(report_.outside);
  EXPECT_TRUE(report_.force.total_W.force.isZero(0.0) && report_.force.spring_W.force.isZero(0.0));
  EXPECT_FALSE(god_object_.state().started);
  // so does a reset: the next pose is a first pose
  ASSERT_EQ(update(pose), Status::kOk);
  EXPECT_EQ(report_.outcome, Outcome::kStartInside);
  EXPECT_TRUE(god_object_.state().inside);
  god_object_->reset();
  EXPECT_FALSE(god_object_.state().inside);
  EXPECT_FALSE(god_object_.state().started);
  ASSERT_EQ(update(mesh_pose({0.0, 0.0, 0.1})), Status::kOk);
  EXPECT_EQ(report_.outcome, Outcome::kFree);
}

TEST_P(CompiledSessionTest, DampsWithTheVelocityOfTheDevice) {
  press();
  const Pose pose = mesh_pose({0.0, 0.0, 0.028});
  for (int k = 0; k < 300; ++k) ASSERT_EQ(update(pose), Status::kOk);
  const Vector3 rest = report_.force.total_W.force;
  EXPECT_LT((report_.force.spring_W.force - rest).norm(), 1e-9) << "nothing moves";
  ASSERT_EQ(update(pose, {{0.0, 0.0, -0.05}, Vector3::Zero()}), Status::kOk);
  const double damping = god_object_.parameters().damping;
  EXPECT_NEAR(report_.force.total_W.force.z(), rest.z() + 0.05 * damping, 0.05 * 0.05 * damping + 0.01 * rest.z());
}

class SessionInAWorkspace : public CompiledSessionTest {
 protected:
  SessionInAWorkspace() : CompiledSessionTest(format::Workspace{{-0.1, -0.1, 0.05}, {0.1, 0.1, 0.3}}) {}
};
INSTANTIATE_TEST_SUITE_P(Solvers, SessionInAWorkspace,
                         testing::Values(Solver::kPaper, Solver::kCorrected, Solver::kContact));

TEST_P(SessionInAWorkspace, FollowsUntilTheDeviceIsInsideAndPushesAfterIt) {
  const Vector3 outside(0.0, 0.103, 0.2);
  ASSERT_EQ(update(mesh_pose(outside)), Status::kOk);
  EXPECT_TRUE(report_.outside);
  EXPECT_EQ(report_.outcome, Outcome::kFree);
  EXPECT_FALSE(god_object_.state().started);
  EXPECT_LT((report_.H_WS.translation - outside).norm(), 1e-15) << "it follows beyond the box";
  EXPECT_TRUE(report_.force.total_W.force.isZero(0.0));

  ASSERT_EQ(update(mesh_pose({0.0, 0.1, 0.2})), Status::kOk);  // exactly at the face, but for rounding
  ASSERT_EQ(update(mesh_pose({0.0, 0.09, 0.2})), Status::kOk);
  EXPECT_TRUE(god_object_.state().started);
  EXPECT_FALSE(report_.outside);
  ASSERT_EQ(update(mesh_pose(outside), {{5.0, 0.1, 0.0}, Vector3::Zero()}), Status::kOk);
  EXPECT_TRUE(report_.outside);
  const Parameters& q = god_object_.parameters();
  EXPECT_NEAR(report_.force.spring_W.force.y(), -0.003 * q.stiffness, 1e-6);
  EXPECT_NEAR(report_.force.total_W.force.y(), -0.003 * q.stiffness - 0.1 * q.damping, 1e-6);
  EXPECT_NEAR(report_.force.total_W.force.x(), 0.0, 1e-6);
  EXPECT_LE(report_.H_WS.translation.y(), 0.1);

  // a refusal outside is a refusal
  const Pose H_WS = god_object_.state().H_WS;
  Pose bad = mesh_pose(outside);
  bad.rotation.coeffs() *= 2.0;
  EXPECT_EQ(update(bad), Status::kNotUnit);
  expect_refusal(H_WS);
}

/// No numbers are lost between the box and the pose: a device within the box by a millionth of a micrometre is inside.
TEST_P(SessionInAWorkspace, IsOutsideByTheSmallestDistance) {
  ASSERT_EQ(update(mesh_pose({0.0, 0.0, 0.2})), Status::kOk);
  ASSERT_EQ(update(mesh_pose({0.0, 0.1 - 1e-12, 0.2})), Status::kOk);
  EXPECT_FALSE(report_.outside);
  ASSERT_EQ(update(mesh_pose({0.0, 0.1 + 1e-12, 0.2})), Status::kOk);
  EXPECT_TRUE(report_.outside);
}

}  // namespace
}  // namespace godobject::test::compiled_session_test
