// The distance out of a lost margin: hand cases, the bound of the solver's motions, and the nearest of all poses.
#include "toolchain/watch/way_out.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "core/pipeline/contact/qp/least_constraint.h"
#include "tests/support/random.h"
#include "toolchain/report/analytic/solid.h"
#include "toolchain/report/contact_quality/reference.h"
#include "toolchain/report/extremes/run.h"

namespace godobject::watch {
namespace {

constexpr double kMargin = 1e-4;
constexpr double kRegained = 0.3;

using report::make_rig;
using report::Optimum;
using report::OptimumProblem;

/// Returns the points of a rig within `reach` of the surface.
std::vector<Touch> touches_of(const WatchedSession& session, const Pose& H_WS, double reach) {
  std::vector<Touch> touches;
  for (const Direction& direction : session.directions) {
    for (const Vector3& p : direction.points) {
      const double gap = direction.field->distance(H_WS * p);
      if (gap > reach) continue;
      touches.push_back({p, H_WS.rotation.conjugate() * direction.field->gradient(H_WS * p), gap - kMargin});
    }
  }
  return touches;
}

double smallest_gap(const WatchedSession& session, const Pose& H_WS) {
  double smallest = HUGE_VAL;
  for (const Touch& touch : touches_of(session, H_WS, HUGE_VAL)) smallest = std::min(smallest, touch.left);
  return smallest + kMargin;
}

Parameters parameters(double rho) {
  Parameters q;
  q.voxel_size = 0.01;
  q.margin = kMargin;
  q.coupling_rotation = rho * rho;
  return q;
}

Vector6 six(const Motion& m, double rho) {
  Vector6 z;
  z << m.translation, rho * m.rotation;
  return z;
}

TEST(WayOut, IsNoneWhereNothingIsLostOrNobodyKnowsIt) {
  const Parameters q = parameters(0.1);
  EXPECT_EQ(way_out({}, q), Vector6::Zero());
  EXPECT_EQ(way_out({{Vector3::Zero(), Vector3::UnitZ(), 0.01 * kMargin}}, q), Vector6::Zero());
  // the same gap on both sides of one point: no motion gains on both
  EXPECT_EQ(
      way_out({{Vector3::Zero(), Vector3::UnitZ(), -0.5 * kMargin}, {Vector3::Zero(), -Vector3::UnitZ(), -kMargin}}, q),
      Vector6::Zero());
}

TEST(WayOut, IsTheLostGapOnAPlaneAndGrowsAsAWedgeNarrows) {
  const Parameters q = parameters(0.1);
  const double lost = 0.4 * kMargin;
  const Vector6 plane = way_out({{Vector3::Zero(), Vector3::UnitZ(), -lost}}, q);
  EXPECT_NEAR(plane[2], kRegained * lost, 1e-12 * kMargin);
  EXPECT_NEAR(plane.norm(), kRegained * lost, 1e-12 * kMargin);
  for (const double half_angle : {0.5, 0.05, 0.005}) {
    const double c = std::cos(half_angle);
    const double s = std::sin(half_angle);
    const Vector6 out = way_out({{Vector3::Zero(), {c, 0.0, s}, -lost}, {Vector3::Zero(), {-c, 0.0, s}, -lost}}, q);
    EXPECT_NEAR(out[2], kRegained * lost / s, 1e-9 * kMargin / s);
    EXPECT_NEAR(out.norm(), out[2], 1e-9 * out[2]);
  }
  // a quarter of a voxel at most
  EXPECT_NEAR(way_out({{Vector3::Zero(), Vector3::UnitZ(), -1.0}}, q)[2], 0.25 * q.voxel_size, 1e-12);
}

/// Two ends of a bar across a bore, each at height z above the middle; the bar turns about y with the lever z.
TEST(WayOut, IsATurnWhereTheWallsLeaveNothingElse) {
  const double rho = 0.3;
  const double lost = 0.2 * kMargin;
  for (const double height : {0.01, 0.001, 0.0001}) {
    const Vector6 out =
        way_out({{{1.0, 0.0, height}, {-1.0, 0.0, 0.0}, -lost}, {{-1.0, 0.0, -height}, {1.0, 0.0, 0.0}, -lost}},
                parameters(rho));
    EXPECT_NEAR(std::fabs(out[4]), rho * kRegained * lost / height, 1e-6 * out.norm());
    EXPECT_NEAR(out.norm(), std::fabs(out[4]), 1e-9 * out.norm());
  }
}

TEST(WayOut, BoundsHowFarAMotionEndsFromTheDevice) {
  test::Random random(3);
  const Parameters q = parameters(0.05);
  const CouplingMetric metric{.gyration = 0.05, .tolerance = 1e-3 * kMargin, .still = 1e-8};
  int lost = 0;
  int farther = 0;
  double sharpest = 0.0;
  for (int problem = 0; problem < 3000; ++problem) {
    std::vector<Touch> touches;
    ContactRows rows;
    for (int i = 0; i < 1 + problem % 12; ++i) {
      const Touch touch{random.in_cube(0.05), random.direction(), random.between(-0.5, 2.0) * kMargin};
      touches.push_back(touch);
      const double missing = -touch.left;
      rows.push(rows.count, touch.normal_S, touch.point_S, missing > 0.0 ? kRegained * missing : missing);
    }
    const Motion wanted = random.motion(2e-4, 2e-3);
    ConstrainedStep step;
    WorkMeter work;
    least_constraint(rows, wanted, metric, nullptr, {}, work, step);
    const Vector6 out = way_out(touches, q);
    if (step.infeasible || out.isZero(0.0)) continue;
    ++lost;
    const Vector6 w = six(wanted, metric.gyration);
    const double ends = (six(step.motion, metric.gyration) - w).norm();
    farther += ends > w.norm() ? 1 : 0;
    sharpest = std::max(sharpest, ends / (out - w).norm());
    EXPECT_LE(ends, (out - w).norm() + 4.0 * metric.tolerance) << "problem " << problem;
  }
  std::printf("[ measured ] %d with a lost margin, %d end farther than rest, at most %.6f of the way out's distance\n",
              lost, farther, sharpest);
  EXPECT_GT(lost, 1000);
  EXPECT_GT(farther, 20);
  EXPECT_GT(sharpest, 0.999);
}

/// A flat box that fits into a bore, but not with the margin. Held at rest, the god object turns until it has the
/// margin. It ends as far from the device as the nearest pose with the margin, no cycle goes farther than the distance
/// out, and none leads by more than a margin away.
TEST(WayOut, LeadsAFlatBoxInANarrowBoreToTheNearestPoseWithTheMargin) {
  report::Setup setup{
      .row = "test", .world = "bore", .body = "flat", .motion = "jump", .seed = 3340209945, .points = 4};
  setup.width = 1.0006691466318443;
  setup.voxel = 0.08036260279223173;
  setup.coupling_rotation = 9.32990778049228;
  const auto rig = make_rig(setup, {});
  const WatchedSession session = rig->watched();
  const Parameters& q = session.parameters;
  const double rho_squared = q.coupling_rotation / q.coupling_translation;
  const double rho = std::sqrt(rho_squared);
  const Pose H_WD = report::device_path(setup).front();
  ASSERT_GT(smallest_gap(session, H_WD), 0.0) << "it does not start inside";
  ASSERT_LT(smallest_gap(session, H_WD), q.margin);
  CycleReport report;
  Pose last = H_WD;
  double most_gained = 0.0;
  for (int k = 0; k < 400; ++k) {
    ASSERT_EQ(rig->update(H_WD, {}, report), Status::kOk);
    const Vector6 out = way_out(touches_of(session, last, 1.5 * q.voxel_size), q);
    const double ends = report::metric_distance(report.H_WS, H_WD, rho_squared);
    EXPECT_LE(ends, (out - six(get_motion(last.inverse() * H_WD), rho)).norm() + 0.01 * q.margin) << "cycle " << k;
    most_gained = std::max(most_gained, ends - report::metric_distance(last, H_WD, rho_squared));
    last = report.H_WS;
  }
  EXPECT_LT(most_gained, 1.01 * q.margin);
  EXPECT_GT(most_gained, 0.5 * q.margin);

  const analytic::Solid within_the_margin({analytic::Bore{setup.width * setup.scale - q.margin}});
  OptimumProblem problem{
      .H_WD = H_WD, .points_B = {}, .pieces = {}, .rho_squared = rho_squared, .largest_step = 1e-3 * setup.scale};
  for (const double x : {-0.8, 0.8}) {
    for (const double y : {-0.6, 0.6}) problem.points_B.emplace_back(setup.scale * Vector3(x, y, 0.0));
  }
  problem.pieces = [&](const Vector3& p_W, std::vector<analytic::Piece>& pieces) {
    within_the_margin.pieces(p_W, pieces);
  };
  double nearest = HUGE_VAL;
  test::Random random(4);
  for (int start = 0; start < 40; ++start) {
    const Motion turned{Vector3::Zero(), 0.02 * random.direction()};
    const Optimum optimum = report::polish(problem, H_WD * set_matrix(turned));
    if (optimum.converged && optimum.violation < 1e-3 * q.margin)
      nearest = std::min(nearest, std::sqrt(optimum.objective));
  }
  const double ended = report::metric_distance(report.H_WS, H_WD, rho_squared);
  std::printf(
      "[ measured ] ends %.6g m from the device, the nearest pose with the margin is %.6g m away; %.3g margins in one "
      "cycle\n",
      ended, nearest, most_gained / q.margin);
  EXPECT_NEAR(ended, nearest, 0.01 * nearest);
}

}  // namespace
}  // namespace godobject::watch
