// The printed heuristic, defects included: the report shows what the paper gives, so its errors are regressions too.

#include <gtest/gtest.h>

#include <random>

#include "core/pipeline/corrected/corrected_cycle.h"
#include "core/pipeline/paper/paper_cycle.h"
#include "tests/support/analytic_worlds.h"

namespace godobject::test::paper_test {
namespace {

using Floor = AnalyticField;
using PaperRun = AnalyticRun<Floor, PaperCycle<false>>;

constexpr double kBallRadius = 0.02;
constexpr double kVoxel = 0.002;

Pose at_height(double z) {
  Pose pose;
  pose.translation.z() = z;
  return pose;
}

TEST(Paper, LeavesABallThatStartedTwoMillimetresDeepWhereItIs) {
  const Floor floor(HalfSpace{}, kVoxel);
  const SampledBody ball = ball_body();
  PaperRun run(floor, ball, at_height(kBallRadius - 0.002));
  for (int k = 0; k < 2000; ++k) ASSERT_EQ(run.step(at_height(kBallRadius - 0.002)), Status::kOk);
  EXPECT_NEAR(run.depth(), 1.98e-3, 0.02e-3);
}

/// Returns the height of the body after a press to 5 mm below contact. Lambda is nearly zero there, so region B glues
/// (ALGORITHM: (21) with (27)).
double hover_height(const SampledBody& body, double half_height) {
  const Floor floor(HalfSpace{}, kVoxel);
  PaperRun run(floor, body, at_height(half_height + 0.010));
  for (int k = 0; k < 5000; ++k) {
    const double travel = std::min(0.015, 5e-5 * k);
    if (run.step(at_height(half_height + 0.010 - travel)) != Status::kOk) return -1.0;
  }
  return -run.depth();
}

// The edge of the safety layer is at 3 mm; integer layers and slanted normals move it by some micrometres.
TEST(Paper, HoversABallAlmostThreeMillimetresAboveThePlane) {
  const double height = hover_height(ball_body(), kBallRadius);
  RecordProperty("height_um", static_cast<int>(height * 1e6));
  EXPECT_GE(height, 2.90e-3);
  EXPECT_LE(height, 3.01e-3);
}

TEST(Paper, HoversABoxAlmostThreeMillimetresAboveThePlane) {
  const double height = hover_height(box_body(), 0.015);
  RecordProperty("height_um", static_cast<int>(height * 1e6));
  EXPECT_GE(height, 2.90e-3);
  EXPECT_LE(height, 3.01e-3);
}

TEST(Paper, RendersTheHoverAsTooMuchForce) {
  const Floor floor(HalfSpace{}, kVoxel);
  const SampledBody ball = ball_body();
  PaperRun run(floor, ball, at_height(kBallRadius + 0.010));
  for (int k = 0; k < 5000; ++k) {
    ASSERT_EQ(run.step(at_height(kBallRadius + 0.010 - std::min(0.015, 5e-5 * k))), Status::kOk);
  }
  // the true force is k_D * 5 mm = 10 N; hovering 3 mm above adds 6 N
  EXPECT_NEAR(run.report.force.spring_W.force.z() / 10.0, 1.6, 0.02);
}

TEST(Paper, GivesTheDevicePoseInRegionC) {
  const Floor floor(HalfSpace{}, kVoxel);
  const SampledBody ball = ball_body();
  PaperRun run(floor, ball, at_height(0.1));
  ASSERT_EQ(run.step(at_height(0.05)), Status::kOk);
  EXPECT_EQ(run.state.H_WS.translation, at_height(0.05).translation);
  EXPECT_EQ(run.report.outcome, Outcome::kFree);
  EXPECT_TRUE(run.report.force.total_W.force.isZero());
}

/// A point in the middle of a voxel that is two layers from the plane: with a safety distance of two voxels V is
/// exactly 0, which is region C, not B.
TEST(Paper, GivesTheDevicePoseWhereThePenetrationIsZero) {
  const Floor floor(HalfSpace{}, kVoxel);
  const SampledBody point({{Vector3::Zero()}, {Vector3::UnitZ()}}, Vector3::Constant(1e-4));
  PaperRun run(floor, point, at_height(2.0 * kVoxel));
  run.parameters.safety_distance = 2.0 * kVoxel;
  const Pose device = at_height(4.0 * kVoxel);
  ASSERT_EQ(run.step(device), Status::kOk);
  EXPECT_EQ(run.state.H_WS.translation, device.translation);
}

/// One contact below a 60 x 40 x 30 mm box at (lever, 0, -15 mm). By hand for a lever of 10 mm: a_x^2 = 1500, a_z^2 =
/// 375, Q_L = (10, -sqrt(375 (1 - 100/1500))), r^2 = 450, sigma tau = J_y = 375 (mm^2): lambda = 37500 / (37500 +
/// 450^2) = 0.156, removed share lambda + (1 - lambda) 100 / 450 = 0.344. A consistent pair would remove all of p.
TEST(PaperCorrection, RemovesOnlyAShareOfThePenetration) {
  const MassModel mass = box_body().mass;
  const struct {
    double lever, share;
  } expected[] = {{0.0, 0.0}, {0.002, 0.0209}, {0.010, 0.3438}, {0.020, 0.6935}, {0.030, 0.8906}};
  for (const auto& [lever, share] : expected) {
    PenaltyContacts contacts;
    contacts.depth = 0.004;
    contacts.count = 1;
    const Vector3 point(lever, 0.0, -0.015);
    contacts.wrench_S.force = contacts.depth * Vector3::UnitZ();
    contacts.wrench_S.torque = point.cross(contacts.wrench_S.force);
    const Correction c = correction(contacts, 0.003, mass);
    const double removed = c.delta.translation.z() + c.delta.rotation.cross(point).z();
    EXPECT_NEAR(removed / 0.001, share, 1e-4) << "lever " << lever;
  }
}

TEST(PaperCorrection, IsFiniteOnWhateverWrenchComes) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };
  const Vector3 bodies[] = {{1e-4, 2e-4, 3e-4}, {0.0, 1e-4, 1e-4}, {1e-4, 1e-4, 2e-4}, {0.0, 0.0, 0.0}};
  for (const Vector3& inertia : bodies) {
    const MassModel mass = MassModel::make(inertia, 0.05, 0.05);
    for (int i = 0; i < 20000; ++i) {
      PenaltyContacts contacts;
      contacts.depth = 0.01 * normal(random);
      contacts.wrench_S.force = vector() * std::pow(10.0, 12.0 * normal(random) / 3.0 - 4.0) * (i % 7 != 0);
      contacts.wrench_S.torque = vector() * std::pow(10.0, 12.0 * normal(random) / 3.0 - 6.0) * (i % 5 != 0);
      const Correction c = correction(contacts, 0.003, mass);
      ASSERT_TRUE(c.delta.translation.allFinite() && c.delta.rotation.allFinite());
      ASSERT_TRUE(c.u_x.allFinite() && c.u_r.allFinite());
      ASSERT_GE(c.distribution, 0.0);
      ASSERT_LE(c.distribution, 1.0);
    }
  }
}

TEST(PaperFriction, SticksSlipsAndAddsItsViscousShareAsAlgorithmOneSays) {
  const Vector3 restricted(0.0, 0.0, -1.0);
  EXPECT_EQ(paper_friction(restricted, Vector3(0.19, 0.0, 0.0), 0.2, 0.18, 0.01), Vector3(-0.19, 0.0, 0.0));
  EXPECT_TRUE(
      paper_friction(restricted, Vector3(0.5, 0.0, 0.0), 0.2, 0.18, 0.01).isApprox(Vector3(-0.18 - 0.005, 0.0, 0.0)));
  EXPECT_TRUE(paper_friction(Vector3::Zero(), Vector3(0.5, 0.0, 0.0), 0.2, 0.18, 0.01).isZero());
  EXPECT_TRUE(paper_friction(restricted, Vector3::Zero(), 0.0, 0.0, 0.0).isZero());
}

TEST(ConstrainedMotion, StopsAtTheWallInRegionA) {
  EXPECT_TRUE(constrained_motion({1.0, 0.0, -2.0}, Vector3::UnitZ(), 0.5, 0.0).isApprox(Vector3(1.0, 0.0, 0.0)));
  EXPECT_TRUE(constrained_motion({1.0, 0.0, 2.0}, Vector3::UnitZ(), 0.5, 0.0).isApprox(Vector3(1.0, 0.0, 2.0)));
}

TEST(ConstrainedMotion, ApproachesAsFarAsContactInRegionB) {
  EXPECT_TRUE(constrained_motion({1.0, 0.0, -2.0}, Vector3::UnitZ(), 0.5, -0.5).isApprox(Vector3(1.0, 0.0, -0.5)));
  EXPECT_TRUE(constrained_motion({1.0, 0.0, -0.2}, Vector3::UnitZ(), 0.5, -0.5).isApprox(Vector3(1.0, 0.0, -0.2)));
}

TEST(ProxyFilter, TakesTheShareThatTheCutOffGives) {
  Pose previous, target, device;
  target.translation.x() = 1e-3;
  device.translation.x() = 8e-3;  // 7 mm beyond the target: 20 Hz
  const Pose filtered = filter_proxy(previous, target, device, 1e-3);
  EXPECT_NEAR(filtered.translation.x(), 1e-3 * (1.0 - std::exp(-2.0 * M_PI * 20.0 * 1e-3)), 1e-12);
}

}  // namespace
}  // namespace godobject::test::paper_test
