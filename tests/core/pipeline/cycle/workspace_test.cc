// The workspace of a scene: the body's centre does not leave it, and the device feels its faces.

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tests/support/analytic_shapes.h"
#include "tests/support/scene_image_builder.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::test::workspace_test {
namespace {

constexpr double kWorldRadius = 0.06;
constexpr double kBodyRadius = 0.02;
constexpr double kWorldVoxel = 0.003;
constexpr double kStiffness = 2000.0;

enum class Body { kPoints, kCentre };  // kCentre: the ball as one point; stored distances are less by its radius

SceneImage make_image(Body body, const std::optional<format::Workspace>& workspace) {
  SceneDescription d;
  const double radius = kWorldRadius + (body == Body::kCentre ? kBodyRadius : 0.0);
  d.distance = [radius](const Vector3& p) { return ball_distance(p, radius); };
  d.surface_min = Vector3::Constant(-radius);
  d.surface_max = Vector3::Constant(radius);
  d.voxel_size = kWorldVoxel;
  d.workspace = workspace;
  if (body == Body::kCentre) {
    d.points = {Vector3::Zero()};
  } else {
    const SurfaceSamples samples = sample_ball(kBodyRadius, 600);
    d.points = samples.points;
    d.normals = samples.normals;
    d.settings.friction = 1;
    d.settings.friction_static = 0.2;
    d.settings.friction_kinetic = 0.18;
  }
  d.H_MB.translation = Vector3(0.01, -0.02, 0.03);
  d.H_MB.rotation = exp_rotation(Vector3(0.3, -0.5, 0.2));
  d.settings.damping = 20.0;
  SceneImage image = build_scene_image(d);
  if (body == Body::kCentre) {  // a point has no extent, but an image requires one
    section_item<format::Body>(image, format::SectionId::kBody).radius = 1e-9;
    seal(image);
  }
  return image;
}

struct Pipeline {
  Solver solver;
  bool friction;
  Body body;
};
constexpr Pipeline kPipelines[] = {
    {Solver::kPaper, false, Body::kPoints},     {Solver::kPaper, true, Body::kPoints},
    {Solver::kCorrected, false, Body::kPoints}, {Solver::kCorrected, true, Body::kPoints},
    {Solver::kContact, false, Body::kPoints},   {Solver::kContact, true, Body::kPoints},
    {Solver::kContact, false, Body::kCentre},
};

/// A god object with its own image.
class Session {
 public:
  Session(const Pipeline& pipeline, const std::optional<format::Workspace>& workspace)
      : image_(make_image(pipeline.body, workspace)), scene_(open_scene(image_)) {
    EXPECT_EQ(god_object_.start(scene_, pipeline.solver, pipeline.friction), Status::kOk);
  }

  /// Runs a cycle with the body's centre at `center`.
  Status update(const Vector3& center, const Vector3& turn = Vector3::Zero(),
                const Vector3& velocity = Vector3::Zero()) {
    Pose H_WB;
    H_WB.translation = center;
    H_WB.rotation = exp_rotation(turn);
    return god_object_->update({H_WB * scene_.H_MB.inverse(), {velocity, Vector3::Zero()}}, report);
  }
  const Vector3& center() const { return god_object_.state().H_WS.translation; }
  double depth() const { return -smallest_distance(scene_.voxelmap, scene_.pointshell, god_object_.state().H_WS); }
  const SceneView& scene() const { return scene_; }
  OwnedGodObject& god_object() { return god_object_; }

  CycleReport report;

 private:
  SceneImage image_;
  SceneView scene_;
  OwnedGodObject god_object_;
};

class InAWorkspace : public testing::TestWithParam<Pipeline> {};
INSTANTIATE_TEST_SUITE_P(Workspace, InAWorkspace, testing::ValuesIn(kPipelines), [](const auto& pipeline) {
  return std::string(format::kSolverNames[static_cast<int>(pipeline.param.solver)]) +
         (pipeline.param.friction ? "WithFriction" : "") + (pipeline.param.body == Body::kCentre ? "OfABall" : "");
});

/// The bound holds to the last bit, for any device motion and any solver.
TEST_P(InAWorkspace, KeepsTheCentreWithinItInRandomMotions) {
  constexpr int kWatched = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
  std::mt19937 random(20);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };
  int outside = 0;
  int at_face_in_contact = 0;
  std::feclearexcept(kWatched);
  for (int session = 0; session < 12; ++session) {
    // near a place on the sphere that the centre may touch; now and then without extent along an axis
    const Vector3 at = (kWorldRadius + kBodyRadius) * vector().normalized();
    format::Workspace workspace{};
    for (int axis = 0; axis < 3; ++axis) {
      workspace.low[axis] = at[axis] - 0.02 * share(random);
      workspace.high[axis] = share(random) < 0.1 ? workspace.low[axis] : at[axis] + 0.02 * share(random);
    }
    Session run(GetParam(), workspace);
    const WorkspaceBox& box = run.scene().workspace;
    ASSERT_TRUE(box.limited);
    Vector3 device = at * 1.2;
    Vector3 turn = Vector3::Zero();
    Vector3 velocity = Vector3::Zero();
    Vector3 spin = Vector3::Zero();
    bool was_free = false;
    for (int cycle = 0; cycle < 1200; ++cycle) {
      if (cycle % 30 == 0) {
        velocity = std::pow(10.0, -2.0 + 3.0 * share(random)) * (vector().normalized() - 10.0 * (device - at));
        spin = 10.0 * vector();
      }
      device += 1e-3 * velocity;
      if (cycle % 97 == 0) device = at + 0.05 * vector();
      turn += 1e-3 * spin;
      ASSERT_EQ(run.update(device, turn, velocity), Status::kOk);
      if (!run.god_object().state().started) {
        ASSERT_TRUE(run.report.force.total_W.force.isZero(0.0));
        continue;
      }
      ASSERT_TRUE(box.contains(run.center())) << run.center().transpose() << " in cycle " << cycle;
      ASSERT_TRUE(run.report.H_WS == run.god_object().state().H_WS);
      ASSERT_EQ(run.report.outside, !box.contains(device));
      if (run.report.outside) ++outside;
      const bool at_face = (run.center() - box.low).cwiseMin(box.high - run.center()).minCoeff() == 0.0;
      if (run.report.contacts > 0 && at_face) ++at_face_in_contact;
      if (GetParam().solver == Solver::kContact) {
        was_free = was_free || run.depth() < 0.0;
        if (was_free) {
          ASSERT_LT(run.depth(), 0.0) << "cycle " << cycle;
        }
      }
    }
  }
  EXPECT_EQ(std::fetestexcept(kWatched), 0);
  EXPECT_GT(outside, 1000);
  EXPECT_GT(at_face_in_contact, 100);
}

TEST_P(InAWorkspace, FeelsItsFacesAsStiffAsTheCouplingAndNeverPulled) {
  Session run(GetParam(), format::Workspace{{-0.1, -0.1, 0.1}, {0.1, 0.1, 0.3}});
  ASSERT_EQ(run.update({0.095, 0.0, 0.2}), Status::kOk);
  ASSERT_EQ(run.update({0.105, 0.0, 0.0}), Status::kOk);
  const Vector3 expected(-kStiffness * 0.005, 0.0, kStiffness * 0.1);
  EXPECT_LT((run.report.force.spring_W.force - expected).norm(), 1e-9);
  EXPECT_LT((run.report.force.total_W.force - expected).norm(), 1e-9);
  EXPECT_TRUE(run.report.force.total_W.torque.isZero(1e-9));
  EXPECT_TRUE(run.report.outside);
  // into the face at 0.1 m/s: 2 N more; fast out of it: no force, but no pull either; along it: no change
  ASSERT_EQ(run.update({0.105, 0.0, 0.2}, Vector3::Zero(), {0.1, 5.0, -5.0}), Status::kOk);
  EXPECT_LT((run.report.force.total_W.force - Vector3(-12.0, 0.0, 0.0)).norm(), 1e-9);
  ASSERT_EQ(run.update({0.105, 0.0, 0.2}, Vector3::Zero(), {-5.0, 0.0, 0.0}), Status::kOk);
  EXPECT_LT(run.report.force.total_W.force.norm(), 1e-9);
  // back inside
  ASSERT_EQ(run.update({0.05, 0.0, 0.2}), Status::kOk);
  EXPECT_FALSE(run.report.outside);
  EXPECT_TRUE(run.report.force.total_W.force.isZero(1e-12));
}

TEST_P(InAWorkspace, RendersNothingUntilTheDeviceHasBeenWithinIt) {
  Session run(GetParam(), format::Workspace{{-0.1, -0.1, 0.07}, {0.1, 0.1, 0.3}});
  for (int k = 0; k < 50; ++k) {  // inside the still body, and below the workspace
    ASSERT_EQ(run.update({0.0, 0.0, 0.001 * k}), Status::kOk);
    ASSERT_TRUE(run.report.outside);
    ASSERT_TRUE(run.report.force.total_W.force.isZero(0.0));
    ASSERT_FALSE(run.god_object().state().started);
  }
  ASSERT_EQ(run.update({0.0, 0.0, 0.09}), Status::kOk);
  EXPECT_TRUE(run.god_object().state().started);
  EXPECT_FALSE(run.report.outside);
  run.god_object()->reset();
  ASSERT_EQ(run.update({0.0, 0.2, 0.09}), Status::kOk);
  EXPECT_TRUE(run.report.force.total_W.force.isZero(0.0));
}

TEST_P(InAWorkspace, IsTheSameToTheLastBitWithinItAsWithoutOne) {
  Session limited(GetParam(), format::Workspace{{-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}});
  Session everywhere(GetParam(), std::nullopt);
  for (int k = 0; k < 2000; ++k) {
    const double angle = 8e-4 * k;
    const double press = 0.025 * std::sin(M_PI * k / 2000.0);
    const double distance = kWorldRadius + kBodyRadius + 0.02 - press;
    const Vector3 center = distance * Vector3(std::sin(angle), 0.0, std::cos(angle));
    ASSERT_EQ(limited.update(center, {0.0, 0.0, 1e-3 * k}), Status::kOk);
    ASSERT_EQ(everywhere.update(center, {0.0, 0.0, 1e-3 * k}), Status::kOk);
    ASSERT_TRUE(limited.report.H_WS == everywhere.report.H_WS) << "cycle " << k;
    ASSERT_EQ(limited.report.force.total_W.force, everywhere.report.force.total_W.force);
    ASSERT_EQ(limited.report.force.total_W.torque, everywhere.report.force.total_W.torque);
    ASSERT_EQ(limited.report.outcome, everywhere.report.outcome);
  }
}

TEST_P(InAWorkspace, RefusesAVelocityThatMakesAForceBeyondAllNumbers) {
  Session run(GetParam(), format::Workspace{{-0.1, -0.1, 0.1}, {0.1, 0.1, 0.3}});
  ASSERT_EQ(run.update({0.0, 0.0, 0.2}), Status::kOk);
  const Vector3 before = run.center();
  EXPECT_EQ(run.update({0.2, 0.0, 0.2}, Vector3::Zero(), {1.7e308, 0.0, 0.0}), Status::kNotFinite);
  EXPECT_TRUE(run.report.force.total_W.force.isZero(0.0));
  EXPECT_EQ(run.center(), before);
}

/// The surface pushes the body against a face. There the body must not get stuck: it follows the device to the nearest
/// place that face and surface allow.
TEST(Workspace, LetsTheContactSolverSlideAlongAFaceThatASurfacePushesItAgainst) {
  constexpr double kFace = 0.02;
  const double reach = kWorldRadius + kBodyRadius;
  for (const Pipeline& pipeline : {kPipelines[4], kPipelines[6]}) {
    Session run(pipeline, format::Workspace{{-0.1, -0.1, -0.1}, {kFace, 0.1, 0.2}});
    double worst = 0.0;
    for (int k = 0; k < 3000; ++k) {
      const double angle = 0.5 * std::sin(M_PI * std::max(0, k - 500) / 1250.0);
      const double height = std::max(0.07, 0.1 - 1e-4 * k);
      const Vector3 device(k == 0 ? 0.0 : kFace + 0.001, height * std::sin(angle), height * std::cos(angle));
      ASSERT_EQ(run.update(device, Vector3::Zero()), Status::kOk);
      ASSERT_LE(run.center().x(), kFace);
      if (k < 500) continue;
      // the face cuts a circle out of the sphere; `best` is the circle's point nearest to the device
      const double radius = std::sqrt(reach * reach - kFace * kFace);
      const Vector3 best(kFace, radius * std::sin(angle), radius * std::cos(angle));
      worst = std::max(worst, (run.center() - best).norm());
    }
    // points and nodes lie on chords of the two balls, a fifth of a millimetre inside each
    EXPECT_LT(worst, 0.2 * kWorldVoxel) << (pipeline.body == Body::kCentre ? "ball" : "points");
  }
}

}  // namespace
}  // namespace godobject::test::workspace_test
