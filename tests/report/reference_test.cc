// The reference optimum for god objects, compared with optima computed by hand.

#include "toolchain/report/contact_quality/reference.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/analytic_shapes.h"

namespace godobject::report {
namespace {

using analytic::Ball;
using analytic::HalfSpace;
using analytic::Solid;

constexpr double kRhoSquared = 0.025;
constexpr double kMicrometre = 1e-6;

OptimumProblem problem_in(const Solid& solid, const std::vector<Vector3>& points, const Pose& H_WD) {
  return {.H_WD = H_WD,
          .points_B = points,
          .pieces = [solid](const Vector3& p, std::vector<analytic::Piece>& out) { solid.pieces(p, out); },
          .rho_squared = kRhoSquared};
}

Pose at(const Vector3& translation, const Vector3& rotation = Vector3::Zero()) {
  Pose pose;
  pose.translation = translation;
  pose.rotation = exp_rotation(rotation);
  return pose;
}

Solid groove() {
  const double c = std::sqrt(0.5);
  return Solid({HalfSpace{.n = Vector3(c, 0.0, c)}, HalfSpace{.n = Vector3(-c, 0.0, c)}});
}

TEST(Reference, PutsABallOnAPlaneAboveTheDevice) {
  // a point at the bottom: the ball neither turns nor moves sideways
  std::vector<Vector3> points = test::sample_ball(0.02, 1500).points;
  points.push_back(Vector3(0.0, 0.0, -0.02));
  const Optimum found = polish(problem_in(Solid({HalfSpace{}}), points, at(Vector3(0.01, 0.02, 0.013))),
                               at(Vector3(0.012, 0.018, 0.03), Vector3(0.05, -0.02, 0.03)));
  ASSERT_TRUE(found.converged);
  EXPECT_LT((found.H_WS.translation - Vector3(0.01, 0.02, 0.02)).norm(), 20.0 * kMicrometre);  // turns to its facets
  EXPECT_LE(found.objective, 0.007 * 0.007 + 1e-12);
  EXPECT_LT(found.violation, kMicrometre);
}

TEST(Reference, CentresABoxInAGroove) {
  // A square bar with its edge down: 45 degree walls, faces flat against them. Its centre stands 20 mm sqrt(2) above
  // the bottom of the V.
  const Vector3 half(0.02, 0.03, 0.02);
  const auto points = test::sample_box(half, 7).points;
  const double height = 0.02 * std::sqrt(2.0);
  const Vector3 edge_down(0.0, std::atan(1.0), 0.0);
  const Optimum found = polish(problem_in(groove(), points, at(Vector3(0.0, 0.004, height - 0.006), edge_down)),
                               at(Vector3(0.001, 0.0, height + 0.004), edge_down + Vector3(0.01, 0.02, -0.01)));
  ASSERT_TRUE(found.converged);
  EXPECT_LT((found.H_WS.translation - Vector3(0.0, 0.004, height)).norm(), kMicrometre);
  EXPECT_LT(get_motion(at(Vector3::Zero(), edge_down).inverse() * found.H_WS).rotation.norm(), 1e-6);
  EXPECT_NEAR(found.objective, 0.006 * 0.006, 1e-9);
}

TEST(Reference, PutsABallIntoACorner) {
  const Solid corner(
      {HalfSpace{.n = Vector3::UnitX()}, HalfSpace{.n = Vector3::UnitY()}, HalfSpace{.n = Vector3::UnitZ()}});
  std::vector<Vector3> points = test::sample_ball(0.02, 800).points;
  for (int axis = 0; axis < 3; ++axis) points.push_back(-0.02 * Vector3::Unit(axis));
  const Optimum found =
      polish(problem_in(corner, points, at(Vector3(0.015, 0.013, 0.017))), at(Vector3(0.022, 0.025, 0.021)));
  ASSERT_TRUE(found.converged);
  EXPECT_LT((found.H_WS.translation - Vector3::Constant(0.02)).norm(), kMicrometre);
  EXPECT_LT(found.H_WS.rotation.vec().norm(), 1e-6);
}

TEST(Reference, TurnsABodyThatRestsOnOnePoint) {
  // One point with a lever: minimise (x, rho r) subject to one row, by hand to first order x = lambda n,
  // r = lambda (P x n) / rho^2, with lambda = depth / (1 + |P x n|^2 / rho^2). A small depth keeps it first order.
  const Vector3 p(0.05, 0.0, -0.01);
  constexpr double kDepth = 1e-5;
  const Optimum found =
      polish(problem_in(Solid({HalfSpace{}}), {p}, at(Vector3(0.0, 0.0, 0.01 - kDepth))), at(Vector3(0.0, 0.0, 0.011)));
  ASSERT_TRUE(found.converged);
  const double lambda = kDepth / (1.0 + 0.05 * 0.05 / kRhoSquared);
  EXPECT_NEAR(found.H_WS.translation.z(), 0.01 - kDepth + lambda, 1e-9);
  EXPECT_NEAR(get_motion(found.H_WS).rotation.y(), -lambda * 0.05 / kRhoSquared, 1e-8);
}

TEST(Reference, GoesToTheDeviceWhereItIsFree) {
  const Pose H_WD = at(Vector3(0.3, 0.1, 0.2), Vector3(0.4, 0.5, 0.1));
  const Optimum found =
      polish(problem_in(Solid({HalfSpace{}}), test::sample_ball(0.02, 200).points, H_WD), at(Vector3(0.0, 0.0, 0.05)));
  ASSERT_TRUE(found.converged);
  EXPECT_LT(metric_distance(found.H_WS, H_WD, kRhoSquared), kMicrometre);
}

TEST(OptimumGap, IsTheDistanceOfTheGodObjectFromTheOptimum) {
  const Vector3 half(0.03, 0.02, 0.015);
  const auto problem = problem_in(Solid({HalfSpace{}}), test::sample_box(half, 5).points, at(Vector3(0.0, 0.0, 0.008)));
  const OptimumGap above = optimum_gap(problem, at(Vector3(0.0, 0.0, 0.0151)), false);
  ASSERT_TRUE(above.known);
  EXPECT_NEAR(above.distance, 1e-4, kMicrometre);
  EXPECT_NEAR(above.excess, 1e-4, kMicrometre);
  const OptimumGap aside = optimum_gap(problem, at(Vector3(0.0003, 0.0, 0.015)), false);
  EXPECT_NEAR(aside.distance, 3e-4, kMicrometre);
}

TEST(OptimumGap, LeavesASaddle) {
  // A box balances on its lower edge, at height R of its centre; the device holds it so, far too deep. Tilted by a its
  // centre stands at R cos(a), so the objective is (R cos(a) - z)^2 + rho^2 a^2: at a = 0 a maximum, if it is deep
  // enough.
  constexpr double kHalf = 0.2;
  const double radius = kHalf * std::sqrt(2.0);
  const double z = radius - 0.15;
  double low = 0.1, high = 0.785;  // of the tilt where the objective's derivative is 0
  for (int i = 0; i < 60; ++i) {
    const double a = 0.5 * (low + high);
    ((radius * std::cos(a) - z) * radius * std::sin(a) > kRhoSquared * a ? low : high) = a;
  }
  const Vector3 edge_down(0.0, std::atan(1.0), 0.0);
  const auto problem = problem_in(Solid({HalfSpace{}}), test::sample_box(Vector3(kHalf, 0.1, kHalf), 5).points,
                                  at(Vector3(0.0, 0.0, z), edge_down));
  const OptimumGap gap = optimum_gap(problem, at(Vector3(0.0, 0.0, radius), edge_down), true);
  ASSERT_TRUE(gap.known);
  EXPECT_NEAR(gap.distance, std::hypot(radius - radius * std::cos(low), std::sqrt(kRhoSquared) * low), 1e-5);
  EXPECT_GT(gap.excess, 0.001);
}

}  // namespace
}  // namespace godobject::report
