// The second direction alone: points of the still body against the field of the moving body.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "core/pipeline/contact/contact_cycle.h"
#include "tests/support/analytic_worlds.h"

namespace godobject::test::feature_direction_test {
namespace {

constexpr double kFeatureVoxel = 0.002;
constexpr double kFeatureMargin = 2e-5;
const Vector3 kTip(0.304, -0.107, 0.05);  // in W; the frame of the points begins elsewhere
const Vector3 kOrigin(0.3, -0.1, 0.04);

/// A body whose surface is only a field. The still body is one point.
class OnATip {
 public:
  template <class Shape>
  OnATip(const Shape& shape, const Pose& start)
      : field_(shape, kFeatureVoxel),
        tip_({{kTip - kOrigin}, {{0.0, 0.0, -1.0}}}, Vector3::Ones()),
        tip_shell_(tip_.pointshell()),
        body_shell_(body_.pointshell()),
        scene_(nothing_, body_shell_, {&field_, tip_shell_, kOrigin, 0.06}, parameters()) {
    memory_->search.start(scene_, {});
    state.H_WS = memory_->H_WD_last = start;
    state.started = true;
  }

  Status step(const Pose& device, const Motion& velocity_W = {}) {
    CycleInput input;
    input.H_WD = device;
    input.velocity_W = velocity_W;
    return contact_cycle<false>(scene_, input, *memory_, state, report);
  }
  const Parameters& parameters() {
    q_.mass = body_.mass;
    q_.voxel_size = kFeatureVoxel;
    q_.margin = kFeatureMargin;
    return q_;
  }

  ProxyState state;
  CycleReport report;

 private:
  Parameters q_;
  AnalyticField nothing_{HalfSpace{Vector3::UnitZ(), -1.0}, kFeatureVoxel};
  AnalyticField field_;
  SampledBody body_ = ball_body(0.02, 50);
  SampledBody tip_;
  Pointshell tip_shell_;
  Pointshell body_shell_;
  ContactScene<AnalyticField, AnalyticField> scene_;
  std::unique_ptr<ContactMemory> memory_ = std::make_unique<ContactMemory>();
};

Pose pose(const Vector3& translation, const Vector3& turn) { return {exp_rotation(turn), translation}; }

TEST(FeatureContacts, AreNoneUnlessTheyAreSet) {
  const FeatureContacts<AnalyticField> none;
  EXPECT_EQ(none.map, nullptr);
  EXPECT_EQ(none.origin_W, Vector3::Zero());
  EXPECT_EQ(none.body_radius, 0.0);
}

/// A ball about the body's origin comes to rest where its centre is nearest to the device: on the line from the tip.
TEST(FeatureDirection, HoldsABallOffATipAlongTheLineToTheDevice) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };
  constexpr double kRadius = 0.02;
  for (int i = 0; i < 20; ++i) {
    const Vector3 away = vector().normalized();
    const Vector3 turn = vector();
    OnATip run(Ball{Vector3::Zero(), kRadius}, pose(kTip + 0.03 * away, turn));
    const Vector3 device = kTip + 0.012 * away;
    for (int cycle = 0; cycle < 100; ++cycle) ASSERT_EQ(run.step(pose(device, turn)), Status::kOk);
    const Vector3 expected = kTip + (kRadius + kFeatureMargin) * away;
    ASSERT_LT((run.state.H_WS.translation - expected).norm(), 1e-6) << i;
    ASSERT_EQ(run.report.outcome, Outcome::kContact);
    ASSERT_EQ(run.report.contacts, 1u);
    const Parameters& q = run.parameters();
    const Vector3 force = q.stiffness * q.coupling_translation * (expected - device);
    ASSERT_LT((run.report.force.spring_W.force - force).norm(), 1e-2) << i;
    ASSERT_LT(run.report.force.spring_W.torque.norm(), 1e-4) << i;
  }
}

/// The wrench at rest is a push at the tip along the surface's normal there, into the body.
TEST(FeatureDirection, PushesAtTheTipAlongTheNormal) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };
  const Ball shape{{0.008, -0.005, 0.003}, 0.02};
  for (int i = 0; i < 20; ++i) {
    const Vector3 away = vector().normalized();
    const Vector3 turn = 0.5 * vector();
    const Quaternion R = exp_rotation(turn);
    OnATip run(shape, pose(kTip + 0.035 * away - R._transformVector(shape.center), turn));
    const Pose device = pose(kTip + 0.014 * away - R._transformVector(shape.center), turn);
    for (int cycle = 0; cycle < 1000; ++cycle) ASSERT_EQ(run.step(device), Status::kOk);
    ASSERT_EQ(run.report.outcome, Outcome::kContact);
    const Wrench& push = run.report.force.spring_W;
    const Vector3 into_body = (run.state.H_WS * shape.center - kTip).normalized();
    ASSERT_GT(push.force.norm(), 1.0) << i;
    ASSERT_LT((push.force.normalized() - into_body).norm(), 0.01) << i;
    const Vector3 lever = kTip - run.state.H_WS.translation;
    ASSERT_LT((push.torque - lever.cross(push.force)).norm(), 0.01 * 0.02 * push.force.norm()) << i;
    ASSERT_NEAR((run.state.H_WS * shape.center - kTip).norm(), shape.radius + kFeatureMargin, 1e-6) << i;
  }
}

/// Damping opposes the device's velocity towards the tip, and only that part.
TEST(FeatureDirection, DampsTheVelocityTowardsTheTip) {
  const Vector3 away = Vector3(1.0, 2.0, -2.0) / 3.0;
  const Vector3 along = away.cross(Vector3::UnitX()).normalized();
  const Vector3 turn(0.3, -0.8, 0.5);
  OnATip run(Ball{Vector3::Zero(), 0.02}, pose(kTip + 0.03 * away, turn));
  const Pose device = pose(kTip + 0.012 * away, turn);
  for (int cycle = 0; cycle < 100; ++cycle) ASSERT_EQ(run.step(device), Status::kOk);
  const auto damping = [&](const Vector3& velocity) {
    EXPECT_EQ(run.step(device, {velocity, Vector3::Zero()}), Status::kOk);
    return Vector3(run.report.force.total_W.force - run.report.force.spring_W.force);
  };
  const double b = run.parameters().damping;
  EXPECT_LT((damping(-0.05 * away) - b * 0.05 * away).norm(), 1e-3) << "towards the tip";
  EXPECT_LT((damping(0.05 * away) + b * 0.05 * away).norm(), 1e-3) << "away from the tip, less than the spring's push";
  EXPECT_LT(damping(0.05 * along).norm(), 1e-3) << "along the surface";
  EXPECT_LT((damping(0.04 * along - 0.03 * away) - b * 0.03 * away).norm(), 1e-3) << "both";
}

/// The device takes a plate through the tip at any speed, also in one cycle. The tip stays on its side of the plate.
TEST(FeatureDirection, LetsNoTipThroughAPlate) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };
  constexpr double kThickness = 0.002;
  for (const double speed : {2e-4, 2e-3, 2e-2}) {  // [m] a cycle
    const double side = speed == 2e-3 ? -1.0 : 1.0;
    OnATip run(Plate{kThickness}, pose(kTip - Vector3(0.0, 0.0, 0.01 * side), Vector3::Zero()));
    double z = -0.01 * side;
    double direction = side;
    int held = 0;
    for (int cycle = 0; cycle < 600; ++cycle) {
      z += direction * speed;
      if (std::fabs(z) > 0.015) direction = z > 0.0 ? -1.0 : 1.0;
      const Vector3 device = kTip + Vector3(0.004 * std::sin(0.05 * cycle), 0.004 * std::sin(0.07 * cycle), z);
      ASSERT_EQ(run.step(pose(device, 0.1 * vector())), Status::kOk);
      const double depth = side * (run.state.H_WS.inverse() * kTip).z();
      ASSERT_GT(depth, 0.5 * kThickness) << "cycle " << cycle << ", " << speed << " m a cycle";
      held += run.report.outcome != Outcome::kFree;
    }
    EXPECT_GT(held, 100) << "the plate should press on the tip much of the time";
  }
}

}  // namespace
}  // namespace godobject::test::feature_direction_test
