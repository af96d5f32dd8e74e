// The theory of parts that fit tightly, by cases that are computed by hand.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "toolchain/report/assembly/backlash.h"
#include "toolchain/report/assembly/jamming.h"
#include "toolchain/report/assembly/screw.h"
#include "toolchain/report/assembly/section.h"
#include "toolchain/report/assembly/thread_mesh.h"
#include "toolchain/report/contact_quality/meshes.h"

namespace godobject::report {
namespace {

/// A peg of diameter 2, whose tip touches the left wall and whose right side touches the rim, 1 above.
const std::array<PlaneContact, 2> kLeaning = {
    {{.point = {-1.0, 0.0}, .normal = {1.0, 0.0}}, {.point = {1.0, 1.0}, .normal = {-1.0, 0.0}}}};

TEST(Jamming, HoldsAPushAlongTheSideWhereTheDepthIsMuTimesTheDiameter) {
  const PlaneLoad along_the_side{.force = {0.0, -1.0}, .moment = 1.0};
  EXPECT_NEAR(holding_friction(kLeaning, along_the_side), 0.5, 1e-8);
  EXPECT_NEAR(whitney_friction(1.0, 2.0, 0.0, 1.0), 0.5, 1e-12);
}

TEST(Jamming, HoldsADrawerByDepthOverTwiceTheLever) {
  for (const double lever : {1.0, 1.5, 3.0}) {
    EXPECT_NEAR(holding_friction(kLeaning, {.force = {0.0, -1.0}, .moment = lever}), 1.0 / (2.0 * lever), 1e-8);
    EXPECT_NEAR(holding_friction(kLeaning, {.force = {0.0, 1.0}, .moment = lever}), 1.0 / (2.0 * lever), 1e-8);
  }
}

TEST(Jamming, HoldsAnyLoadOnceThePegIsWedged) {
  // the line through both places lies within both cones of friction: they can press against each other
  for (const double lever : {0.0, 0.3, 0.7}) {
    EXPECT_NEAR(holding_friction(kLeaning, {.force = {0.0, -1.0}, .moment = lever}), 0.5, 1e-8);
  }
  EXPECT_NEAR(wedging_friction(kLeaning), 0.5, 1e-12);
}

TEST(Jamming, AgreesWithWhitneysDiagramUnderSideForces) {
  for (const double force : {0.2, 0.5, 1.0}) {
    for (const double moment : {0.8, 1.0, 2.0}) {
      const PlaneLoad load{.force = {-force, -1.0}, .moment = moment};
      const double mu = whitney_friction(1.0, 2.0, force, moment);
      ASSERT_LT(force * mu, 1.0);  // both places touch
      EXPECT_NEAR(holding_friction(kLeaning, load), mu, 1e-7) << force << " " << moment;
      const double lambda = 1.0 / (2.0 * mu);
      EXPECT_NEAR(moment, lambda - mu * (1.0 + lambda) * force, 1e-9);
    }
  }
}

TEST(Jamming, HoldsNoLoadThatPullsOffBothPlaces) {
  const std::array<PlaneContact, 2> floor = {
      {{.point = {-1.0, 0.0}, .normal = {0.0, 1.0}}, {.point = {1.0, 0.0}, .normal = {0.0, 1.0}}}};
  EXPECT_TRUE(std::isinf(holding_friction(floor, {.force = {0.0, 1.0}, .moment = 0.0})));
  EXPECT_NEAR(holding_friction(floor, {.force = {0.3, -1.0}, .moment = 0.0}), 0.3, 1e-8);  // a block on a floor
}

TEST(Screw, MeasuresAGeneratedThread) {
  const Thread thread;
  const Screw screw = measure_screw(bolt_mesh(thread, 0.036), nut_mesh(thread, 0.014, 0.0, 0.012), 0.01, 0.03);
  EXPECT_NEAR(screw.pitch, thread.pitch, 1e-9);
  // facets between the steps of a turn tilt the sections of the flanks
  EXPECT_NEAR(screw.flank_angle, thread.flank_angle, 0.01);
  EXPECT_NEAR(screw.outer_radius, thread.crest, 1e-12);
  EXPECT_NEAR(screw.inner_radius, thread.root + thread.radial_play, 1e-12);
}

TEST(Screw, LocksASquareThreadByItsLeadAngle) {
  const Screw square{
      .pitch = 2.0 * std::numbers::pi * 0.1, .flank_angle = 0.0, .inner_radius = 0.9, .outer_radius = 1.1};
  EXPECT_NEAR(self_locking_friction(square, 1.0), 0.1, 1e-12);
  EXPECT_NEAR(raising_torque(square, 1.0, 0.0), 0.1, 1e-12);  // no work is lost: torque x 2 pi = pitch
  // an inclined plane: tan(lead angle + friction angle)
  EXPECT_NEAR(raising_torque(square, 1.0, 0.2), std::tan(std::atan(0.1) + std::atan(0.2)), 1e-12);
  EXPECT_NEAR(raising_torque(square, 1.0, -0.1), 0.0, 1e-12);  // at the boundary it lowers without torque
}

/// Returns the sides of a rectangle.
std::vector<Segment> rectangle(const Vector2& low, const Vector2& high) {
  const Vector2 right(high.x(), low.y());
  const Vector2 left(low.x(), high.y());
  return {{low, right}, {right, high}, {high, left}, {left, low}};
}

TEST(Backlash, TurnsABarUntilItsSideOrItsEndMeetsAPost) {
  const std::vector<Segment> bar = rectangle({-3.0, -1.0}, {3.0, 1.0});
  const std::vector<Segment> post = rectangle({1.0, 2.0}, {2.0, 4.0});
  // forward the bar's side, 1 from the middle, meets the corner (2, 2); backward its other half lies flat on the post
  const Backlash play = exact_backlash(bar, post);
  EXPECT_NEAR(play.forward, 0.25 * std::numbers::pi - std::asin(1.0 / std::sqrt(8.0)), 1e-12);
  EXPECT_NEAR(play.backward, 0.5 * std::numbers::pi, 1e-12);
  // the same if the post turns about the bar, with the directions exchanged
  const Backlash other = exact_backlash(post, bar);
  EXPECT_NEAR(other.forward, play.backward, 1e-12);
  EXPECT_NEAR(other.backward, play.forward, 1e-12);
  // a bar that is too short turns freely
  EXPECT_EQ(exact_backlash(rectangle({-1.0, -1.0}, {1.0, 1.0}), post).forward, std::numbers::pi);
}

TEST(Section, CutsABox) {
  const TriangleMesh box = box_mesh({-1.0, -1.0, 0.0}, {2.0, 1.0, 3.0});
  double widest = 0.0;
  for (const Segment& segment : axial_section(box, 1e-5)) widest = std::max(widest, segment[0].x());
  EXPECT_NEAR(widest, 2.0, 1e-9);
  double around = 0.0;
  for (const Segment& segment : level_section(box, 1.0)) around += (segment[1] - segment[0]).norm();
  EXPECT_NEAR(around, 10.0, 1e-9);
}

}  // namespace
}  // namespace godobject::report
