// The closed-form projection: exact for a single contact, finite for everything else.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/pipeline/corrected/corrected_cycle.h"
#include "core/pipeline/paper/paper_cycle.h"
#include "tests/support/analytic_worlds.h"

namespace godobject::test::corrected_test {
namespace {

using Floor = AnalyticField;
using PlainRun = AnalyticRun<Floor, CorrectedCycle<false>>;
using FrictionRun = AnalyticRun<Floor, CorrectedCycle<true>>;

constexpr double kBallRadius = 0.02;
constexpr double kRunVoxel = 0.002;

Pose at(double x, double z) {
  Pose pose;
  pose.translation = Vector3(x, 0.0, z);
  return pose;
}

TEST(Projection, RemovesExactlyThePenetrationWhateverTheLever) {
  const MassModel mass = box_body().mass;
  for (const double lever : {0.0, 1e-9, 0.002, 0.010, 0.020, 0.030}) {
    PenaltyContacts contacts;
    contacts.depth = 0.004;
    contacts.count = 1;
    const Vector3 point(lever, 0.0, -0.015);
    contacts.wrench_S.force = contacts.depth * Vector3::UnitZ();
    contacts.wrench_S.torque = point.cross(contacts.wrench_S.force);
    const Projection out = project(Motion{}, contacts, 0.003, 1.0, mass, nullptr, {});
    EXPECT_NEAR(out.motion.translation.z() + out.motion.rotation.cross(point).z(), 0.001, 1e-15) << "lever " << lever;
  }
}

TEST(Projection, LeavesMotionAwayFromTheSurfaceAlone) {
  PenaltyContacts contacts;
  contacts.depth = 0.002;
  contacts.wrench_S.force = 0.002 * Vector3::UnitZ();
  const Motion away{{0.0001, -0.0002, 0.0003}, {0.01, 0.0, 0.0}};
  const Projection out = project(away, contacts, 0.003, 0.2, ball_body().mass, nullptr, {});
  EXPECT_EQ(out.motion.translation, away.translation);
  EXPECT_EQ(out.motion.rotation, away.rotation);
}

/// Gauss' principle: no motion that meets the row is nearer to the unconstrained motion, in the metric of the mass.
TEST(Projection, IsTheNearestOfTheAllowedMotions) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };
  const MassModel mass = box_body().mass;
  const auto cost = [&](const Motion& a, const Motion& b) {
    const Vector3 r = a.rotation - b.rotation;
    return (a.translation - b.translation).squaredNorm() + r.dot(mass.inertia.cwiseProduct(r));
  };
  for (int i = 0; i < 2000; ++i) {
    PenaltyContacts contacts;
    contacts.depth = 0.003 + 0.0001 * normal(random);
    if (contacts.depth <= 0.0) continue;
    contacts.wrench_S.force = 0.01 * vector();
    contacts.wrench_S.torque = 0.0003 * vector();
    const Motion wanted{0.0002 * vector(), 0.003 * vector()};  // within the bounds of one step
    const Motion got = project(wanted, contacts, 0.003, 0.2, mass, nullptr, {}).motion;
    const double force = contacts.wrench_S.force.norm();
    const double p = contacts.depth - 0.003;
    const auto row = [&](const Motion& xi) {
      return (contacts.wrench_S.force.dot(xi.translation) + contacts.wrench_S.torque.dot(xi.rotation)) / force;
    };
    const double bound = p > 0.0 ? 0.2 * p : p;
    ASSERT_GE(row(got), bound - 1e-12);
    for (int j = 0; j < 20; ++j) {
      const Motion other{got.translation + 0.0001 * vector(), got.rotation + 0.002 * vector()};
      if (row(other) >= bound) {
        ASSERT_GE(cost(other, wanted), cost(got, wanted) - 1e-12);
      }
    }
  }
}

/// The walls on both sides are a tenth of a millimetre away from the ball. Their forces cancel and leave no direction.
TEST(Projection, FollowsBetweenOpposingContactsWithoutLeavingThem) {
  const AnalyticField slot(Slot{kBallRadius + 1e-4}, kRunVoxel);
  const SampledBody ball = ball_body();
  AnalyticRun<AnalyticField, CorrectedCycle<false>> run(slot, ball, Pose{});
  for (int k = 0; k < 4000; ++k) {
    ASSERT_EQ(run.step(at(0.0, 1e-5 * k)), Status::kOk);
    ASSERT_LT(std::fabs(run.state.H_WS.translation.x()), 2e-4);
    ASSERT_LT(run.depth(), 0.1 * kRunVoxel);
  }
  EXPECT_NEAR(run.state.H_WS.translation.z(), 0.04, 1e-3);
}

TEST(Corrected, StaysOutOfAFloorWithinATenthOfAVoxel) {
  const Floor floor(HalfSpace{}, kRunVoxel);
  const SampledBody ball = ball_body();
  PlainRun run(floor, ball, at(0.0, kBallRadius + 0.010));
  double deepest = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const double press = std::min(0.017, 5e-5 * k);
    ASSERT_EQ(run.step(at(1e-5 * k, kBallRadius + 0.010 - press)), Status::kOk);
    deepest = std::max(deepest, run.depth());
  }
  EXPECT_LE(deepest, 0.1 * kRunVoxel);
  // the ball does not hover either: its lowest sample point touches
  EXPECT_NEAR(run.depth(), 0.0, 0.1 * kRunVoxel);
  EXPECT_EQ(run.report.outcome, Outcome::kContact);
}

TEST(Corrected, StaysOnABallWithinATenthOfAVoxelWhileItSlidesAround) {
  const AnalyticField world(Ball{Vector3::Zero(), 0.1}, kRunVoxel);
  const SampledBody ball = ball_body();
  const auto pose = [](double angle, double distance) {
    return at(distance * std::sin(angle), distance * std::cos(angle));
  };
  AnalyticRun<AnalyticField, CorrectedCycle<false>> run(world, ball, pose(0.0, 0.13));
  double deepest = 0.0;
  for (int k = 0; k < 4000; ++k) {
    const double distance = 0.13 - std::min(0.015, 3e-5 * k);
    ASSERT_EQ(run.step(pose(5e-4 * k, distance)), Status::kOk);
    deepest = std::max(deepest, run.depth());
  }
  EXPECT_LE(deepest, 0.1 * kRunVoxel);
}

/// Pressed deeper than J over the contact point's shift per radian (5 mm here), an ellipsoid swings from side to side
/// unless the projection is relaxed. A box swings from edge to edge.
template <class Body>
void expect_quiet(const Body& body, double half_height, double press) {
  const Floor floor(HalfSpace{}, kRunVoxel);
  PlainRun run(floor, body, at(0.0, half_height + 0.001));
  Vector3 torque = Vector3::Zero();
  for (int k = 0; k < 3000; ++k) {
    ASSERT_EQ(run.step(at(0.0, half_height - std::min(press, 1e-5 * k))), Status::kOk);
    ASSERT_LE(run.depth(), 0.1 * kRunVoxel) << "cycle " << k << ", press " << press;
    if (k > 2000) {
      ASSERT_LT((run.report.force.spring_W.torque - torque).norm(), 1e-3) << "cycle " << k << ", press " << press;
    }
    torque = run.report.force.spring_W.torque;
  }
  EXPECT_NEAR(run.report.force.spring_W.force.z(), 2000.0 * press, 2000.0 * 0.1 * kRunVoxel);
}

SampledBody ellipsoid_body() {
  const Vector3 axes(0.06, 0.03, 0.02);
  SurfaceSamples samples = sample_ball(1.0, 4000);
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    samples.points[i] = samples.points[i].cwiseProduct(axes);
    samples.normals[i] = samples.normals[i].cwiseQuotient(axes).normalized();
  }
  const Vector3 squares = axes.cwiseProduct(axes);
  return {samples, (Vector3::Constant(squares.sum()) - squares) / 5.0};
}

TEST(Corrected, StaysQuietUnderAnEllipsoidHoweverDeepItIsPressed) {
  for (const double press : {0.002, 0.005, 0.0055, 0.007, 0.010, 0.020}) expect_quiet(ellipsoid_body(), 0.02, press);
}

TEST(Corrected, StaysQuietUnderABoxHoweverDeepItIsPressed) {
  for (const double press : {0.002, 0.005, 0.007, 0.010, 0.020}) expect_quiet(box_body(), 0.015, press);
}

TEST(Corrected, DoesNotLagInFreeAirBesideASurface) {
  const Floor floor(HalfSpace{}, 0.0005);
  const SampledBody ball = ball_body();
  PlainRun run(floor, ball, at(0.0, kBallRadius + 0.001));
  run.parameters.safety_distance = 0.00075;
  for (int k = 0; k < 200; ++k) {
    ASSERT_EQ(run.step(at(2e-3 * k, kBallRadius + 0.00076)), Status::kOk);
    ASSERT_LT(run.report.force.spring_W.force.norm(), 0.01) << "a force at 2 m/s, 0.01 mm above the safety layer";
  }
}

TEST(Corrected, DragsLessThanTwentyMillinewtonsWithoutFriction) {
  const Floor floor(HalfSpace{}, kRunVoxel);
  const SampledBody ball = ball_body();
  PlainRun run(floor, ball, at(0.0, kBallRadius));
  for (int k = 0; k < 700; ++k) ASSERT_EQ(run.step(at(0.0, kBallRadius - 1e-5 * k)), Status::kOk);
  for (int k = 0; k < 1000; ++k) {
    ASSERT_EQ(run.step(at(1e-4 * k, kBallRadius - 0.007)), Status::kOk);
    ASSERT_LT(std::fabs(run.report.force.spring_W.force.x()), 0.02);
  }
}

TEST(Corrected, LetsGoWithoutAPullOnRetreat) {
  const Floor floor(HalfSpace{}, kRunVoxel);
  const SampledBody ball = ball_body();
  PlainRun run(floor, ball, at(0.0, kBallRadius + 0.005));
  for (int k = 0; k < 1000; ++k) ASSERT_EQ(run.step(at(0.0, kBallRadius + 0.005 - 1e-5 * k)), Status::kOk);
  for (int k = 0; k < 1000; ++k) {
    ASSERT_EQ(run.step(at(0.0, kBallRadius - 0.005 + 5e-5 * k)), Status::kOk);
    ASSERT_GE(run.report.force.spring_W.force.z(), -1e-9);
  }
  EXPECT_EQ(run.report.outcome, Outcome::kFree);
}

TEST(Corrected, ComesOutWhenItStartedInside) {
  const Floor floor(HalfSpace{}, kRunVoxel);
  const SampledBody ball = ball_body();
  PlainRun run(floor, ball, at(0.0, kBallRadius - 0.005));
  run.state.inside = true;
  ASSERT_EQ(run.step(at(0.0, kBallRadius - 0.005)), Status::kOk);
  EXPECT_EQ(run.report.outcome, Outcome::kStartInside);
  for (int k = 0; k < 50; ++k) ASSERT_EQ(run.step(at(0.0, kBallRadius - 0.005)), Status::kOk);
  EXPECT_LE(run.depth(), 0.1 * kRunVoxel);
  EXPECT_EQ(run.report.outcome, Outcome::kContact);
}

/// Returns the ratio of tangential to normal force while the body slides at `speed`, steadily and 7 mm deep.
double sliding_ratio(const SampledBody& body, double half_height, double speed, double mu_kinetic, double viscous) {
  const Floor floor(HalfSpace{}, kRunVoxel);
  FrictionRun run(floor, body, at(0.0, half_height));
  run.parameters.friction = {0.2, mu_kinetic, viscous};
  for (int k = 0; k < 700; ++k) {
    if (run.step(at(0.0, half_height - 1e-5 * k)) != Status::kOk) return -1.0;
  }
  double ratio = 0.0;
  for (int k = 0; k < 2000; ++k) {
    if (run.step(at(speed * 1e-3 * k, half_height - 0.007)) != Status::kOk) return -1.0;
    const Vector3& f = run.report.force.spring_W.force;
    ratio = -f.x() / f.z();
  }
  return ratio;
}

TEST(Corrected, SlidesWithTheKineticRatioWithinOnePercent) {
  for (const double speed : {0.01, 0.1, 0.5}) {
    EXPECT_NEAR(sliding_ratio(ball_body(), kBallRadius, speed, 0.18, 0.0) / 0.18, 1.0, 0.01)
        << "ball at " << speed << " m/s";
  }
}

TEST(Corrected, AddsTheViscousForceOfItsSpeed) {
  // 14 N normal force (7 mm at 2000 N/m), 10 Ns/m at 0.1 m/s: 1 N beside mu_k N
  EXPECT_NEAR(sliding_ratio(ball_body(), kBallRadius, 0.1, 0.18, 10.0), 0.18 + 1.0 / 14.0, 0.002);
}

/// Returns the drift of the god object in 10 s of tremor of 8-12 Hz and 5 um encoder steps, inside the cone.
double stick_drift(const SampledBody& body, double half_height) {
  const Floor floor(HalfSpace{}, kRunVoxel);
  FrictionRun run(floor, body, at(0.0, half_height));
  run.parameters.friction = {0.2, 0.18, 0.0};
  for (int k = 0; k < 700; ++k) {
    if (run.step(at(0.0, half_height - 1e-5 * k)) != Status::kOk) return 1.0;
  }
  const auto tremor = [](double t) {
    const double x = 2e-4 * std::sin(2.0 * M_PI * 8.0 * t) + 1e-4 * std::sin(2.0 * M_PI * 11.3 * t);
    const double y = 2e-4 * std::sin(2.0 * M_PI * 9.1 * t + 1.0);
    const double z = 2e-4 * std::sin(2.0 * M_PI * 12.0 * t + 2.0);
    const auto encoder = [](double v) { return 5e-6 * std::round(v / 5e-6); };
    return Vector3(encoder(x + 3e-4), encoder(y), encoder(z));
  };
  Vector3 first = Vector3::Zero();
  for (int k = 0; k < 10500; ++k) {
    Pose device = at(0.0, half_height - 0.007);
    device.translation += tremor(1e-3 * k);
    if (run.step(device) != Status::kOk) return 1.0;
    if (k == 500) first = run.state.H_WS.translation;
  }
  return (run.state.H_WS.translation - first).head<2>().norm();
}

TEST(Corrected, HoldsAStaticContactWithinAMicrometreInTenSeconds) {
  EXPECT_LT(stick_drift(ball_body(), kBallRadius), 1e-6);
  EXPECT_LT(stick_drift(box_body(), 0.015), 1e-6);
}

TEST(Corrected, IsFiniteAndBoundedUnderJumpsOfTheDevice) {
  const AnalyticField plate(Plate{}, kRunVoxel);
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (const SampledBody& body :
       {ball_body(), box_body(), SampledBody({{Vector3::Zero()}, {Vector3::UnitZ()}}, Vector3::Zero())}) {
    AnalyticRun<AnalyticField, CorrectedCycle<true>> run(plate, body, at(0.0, 0.1));
    run.parameters.friction = {0.2, 0.18, 1.0};
    for (int k = 0; k < 2000; ++k) {
      Pose device;
      device.translation = 0.05 * Vector3(normal(random), normal(random), normal(random));
      device.rotation = exp_rotation(Vector3(normal(random), normal(random), normal(random)));
      ASSERT_EQ(run.step(device), Status::kOk);
      ASSERT_LT((run.state.H_WS.translation - device.translation).norm(), 1.0);
      ASSERT_NEAR(run.state.H_WS.rotation.norm(), 1.0, 1e-12);
    }
  }
}

TEST(DeviceForce, DampsTheApproachAndNeverPulls) {
  Parameters q;
  const Wrench coupling{{0.0, 0.0, 0.001}, Vector3::Zero()};  // 2 N out of the surface at k_D = 2000
  Motion velocity;
  velocity.translation = Vector3(0.5, 0.0, -0.05);
  EXPECT_TRUE(device_force(coupling, Pose{}, velocity, q).total_W.force.isApprox(Vector3(0.0, 0.0, 2.0 + 20.0 * 0.05)));
  velocity.translation = Vector3(0.0, 0.0, 0.05);
  EXPECT_TRUE(device_force(coupling, Pose{}, velocity, q).total_W.force.isApprox(Vector3(0.0, 0.0, 1.0)));
  velocity.translation = Vector3(0.0, 0.0, 1.0);
  EXPECT_TRUE(device_force(coupling, Pose{}, velocity, q).total_W.force.isZero());
  EXPECT_TRUE(device_force(Wrench{}, Pose{}, velocity, q).total_W.force.isZero());
}

}  // namespace
}  // namespace godobject::test::corrected_test
