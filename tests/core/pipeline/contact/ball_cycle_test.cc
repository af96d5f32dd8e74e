// The cycle of a ball that its centre represents: cases that can be computed by hand on a plane, in a groove and in a
// corner, dense samples of its path, and the cycle for any body with the same one point.

#include "core/pipeline/contact/ball_cycle.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/pipeline/contact/contact_cycle.h"
#include "tests/support/analytic_worlds.h"
#include "tests/support/random.h"
#include "tests/support/scene_image_builder.h"

namespace godobject::test::ball_cycle_test {
namespace {

constexpr double kHalf = 0.04;  // of the region with a surface [m]
const double kInfinity = std::numeric_limits<double>::infinity();

using Distance = std::function<double(const Vector3&)>;

/// A solid that the planes bound: where n . p < 0 for one of the normals n.
Distance planes(const std::vector<Vector3>& normals) {
  return [normals](const Vector3& p) {
    double least = kInfinity;
    for (const Vector3& n : normals) least = std::min(least, n.dot(p));
    return least;
  };
}
const Vector3 kX = Vector3::UnitX(), kY = Vector3::UnitY(), kZ = Vector3::UnitZ();
SceneImage image_of(const Distance& distance, double voxel_size) {
  SceneDescription d;
  d.distance = distance;
  d.surface_min = Vector3::Constant(-kHalf);
  d.surface_max = Vector3::Constant(kHalf);
  d.voxel_size = voxel_size;
  d.points = {Vector3::Zero()};
  d.normals = {kZ};
  d.inertia = {1e-4, 1e-4, 1e-4};
  SceneImage image = build_scene_image(d);
  section_item<format::Body>(image, format::SectionId::kBody).radius = 0.01;
  seal(image);
  return image;
}

const SceneImage& plane() {
  static const SceneImage image = image_of(planes({kZ}), 0.004);
  return image;
}
const SceneImage& slope() {
  static const SceneImage image = image_of(planes({Vector3(0.6, 0.0, 0.8)}), 0.004);
  return image;
}
const SceneImage& groove() {
  static const SceneImage image = image_of(planes({(kZ + kX).normalized(), (kZ - kX).normalized()}), 0.004);
  return image;
}
const SceneImage& corner() {
  static const SceneImage image = image_of(planes({kX, kY, kZ}), 0.004);
  return image;
}

/// The top is at z = 12 mm, the edges of the top at 20 mm from the axis.
const SceneImage& flat_block() {
  static const SceneImage image = image_of(
      [](const Vector3& p) {
        return analytic::box_distance(p, {0.02, 0.02, 0.012});
      },
      0.004);
  return image;
}

/// The distance from a solid with thin parts, edges and a slot that the centre cannot pass.
double distance_of_maze(const Vector3& p) {
  const double plate = analytic::box_distance(p, {0.04, 0.04, 0.0031});
  const double wall = analytic::box_distance(p - Vector3(0.01, 0.0, 0.012), {0.0031, 0.03, 0.012});
  const double roof = analytic::box_distance(p - Vector3(-0.01, 0.0, 0.013), {0.012, 0.02, 0.0031});
  return std::min({plate, wall, roof});
}
const SceneImage& maze() {
  static const SceneImage image = image_of(distance_of_maze, 0.003);
  return image;
}
/// The field grows by half of a distance only.
const SceneImage& flat_maze() {
  static const SceneImage image = image_of([](const Vector3& p) { return 0.5 * distance_of_maze(p); }, 0.003);
  return image;
}

/// The centre of a ball over a still body, whose distances are those of the centre.
class BallRun {
 public:
  BallRun(const SceneImage& image, const Vector3& start) : scene_(open_scene(image)) {
    q = Parameters::make(scene_);
    q.damping = 20.0;
    state.H_WS.translation = start;
    state.started = true;
  }

  Status step(const Vector3& goal, const Vector3& velocity = Vector3::Zero()) {
    Motion velocity_W;
    velocity_W.translation = velocity;
    const CycleInput input = input_within({rotation, goal}, velocity_W, q);
    WorkMeter work;
    return ball_cycle(scene_.voxelmap, q, lengths(), input, path, work, state, report, nullptr);
  }
  ContactLengths lengths() const { return ContactLengths::make(q); }
  const Vector3& center() const { return state.H_WS.translation; }
  const Voxelmap& field() const { return scene_.voxelmap; }
  double gap() const { return field().sample(center()).distance; }
  double stiffness() const { return q.stiffness * q.coupling_translation; }

  Parameters q;
  Quaternion rotation = Quaternion::Identity();
  ProxyState state;
  CycleReport report;
  SubstepPath path;

 private:
  SceneView scene_;
};

TEST(BallCycle, FollowsTheDeviceWhereNothingIsNear) {
  BallRun run(plane(), {0.0, 0.0, 0.03});
  run.rotation = exp_rotation({0.1, -0.2, 0.3});
  const Vector3 goal(0.01, -0.005, 0.025);
  ASSERT_EQ(run.step(goal, {1.0, 2.0, 3.0}), Status::kOk);
  EXPECT_EQ(run.center(), goal);
  EXPECT_EQ(run.state.H_WS.rotation.coeffs(), run.rotation.coeffs());
  EXPECT_EQ(run.report.H_WS.translation, goal);
  EXPECT_EQ(run.report.outcome, Outcome::kFree);
  EXPECT_EQ(run.report.force.spring_W.force, Vector3::Zero());
  EXPECT_EQ(run.report.force.total_W.force, Vector3::Zero());
  EXPECT_EQ(run.report.contacts, 0u);
  EXPECT_EQ(run.report.substeps, 1u);
  EXPECT_EQ(run.report.penetration, -run.lengths().shortest_search_radius);
  ASSERT_EQ(run.path.poses().size(), 1u);
  EXPECT_EQ(run.path.poses()[0].translation, goal);
}

/// The god object stays over the device at the margin; the spring pushes along the normal.
TEST(BallCycle, LiesOnAPlaneAtTheMargin) {
  BallRun run(plane(), {0.0, 0.0, 0.002});
  run.q.coupling_translation = 0.8;
  run.report.dropped = 77;  // of an earlier cycle
  run.report.unconverged = true;
  const Vector3 goal(0.003, -0.001, -0.004);
  for (int i = 0; i < 30; ++i) ASSERT_EQ(run.step(goal), Status::kOk);
  const double tolerance = 2.0 * run.lengths().metric.tolerance;
  EXPECT_LT((run.center() - Vector3(0.003, -0.001, run.q.margin)).norm(), tolerance);
  EXPECT_EQ(run.report.outcome, Outcome::kContact);
  EXPECT_EQ(run.report.contacts, 1u);
  EXPECT_EQ(run.report.substeps, 1u);
  EXPECT_EQ(run.report.dropped, 0u);
  EXPECT_FALSE(run.report.unconverged);
  EXPECT_NEAR(run.report.penetration, -run.q.margin, tolerance);
  EXPECT_LT((run.report.force.spring_W.force - run.stiffness() * (run.center() - goal)).norm(), 1e-12);
  EXPECT_EQ(run.report.force.spring_W.torque, Vector3::Zero());
  EXPECT_EQ(run.report.force.total_W.force, run.report.force.spring_W.force);
  ASSERT_EQ(run.path.poses().size(), 1u);
  EXPECT_EQ(run.path.poses()[0].translation, run.center());
  // and it slides along without delay
  ASSERT_EQ(run.step(goal + Vector3(0.004, 0.002, -0.001)), Status::kOk);
  EXPECT_LT((run.center() - Vector3(0.007, 0.001, run.q.margin)).norm(), tolerance);
  // away from the plane it goes with the device at once
  ASSERT_EQ(run.step(goal + Vector3(0.0, 0.0, 0.01)), Status::kOk);
  EXPECT_LT((run.center() - (goal + Vector3(0.0, 0.0, 0.01))).norm(), 1e-15);
  EXPECT_EQ(run.report.outcome, Outcome::kFree);
}

/// A centre that starts exactly on the surface does not penetrate: the plane holds it, and it regains the margin.
TEST(BallCycle, DoesNotStartInsideOnTheSurface) {
  BallRun run(plane(), Vector3::Zero());
  run.state.started = false;
  ASSERT_EQ(run.gap(), 0.0);
  for (int i = 0; i < 3; ++i) {
    const double before = run.gap();
    ASSERT_EQ(run.step({0.0, 0.0, -0.002}), Status::kOk);
    EXPECT_FALSE(run.state.inside) << i;
    EXPECT_EQ(run.report.outcome, Outcome::kContact) << i;
    EXPECT_GT(run.gap(), before) << i;
  }
}

TEST(BallCycle, LiesInAGrooveAndInACornerAtTheMargins) {
  BallRun in_groove(groove(), {0.0, 0.0, 0.01});
  const Vector3 deep(0.001, 0.005, -0.006);
  for (int i = 0; i < 30; ++i) ASSERT_EQ(in_groove.step(deep), Status::kOk);
  const double rounding = 4e-6 * in_groove.q.voxel_size + 4.0 * in_groove.lengths().metric.tolerance;
  EXPECT_EQ(in_groove.report.contacts, 2u);
  EXPECT_EQ(in_groove.report.outcome, Outcome::kContact);
  EXPECT_NEAR(in_groove.center().y(), 0.005, rounding) << "nothing holds it along the groove";
  EXPECT_LT((in_groove.report.force.spring_W.force - in_groove.stiffness() * (in_groove.center() - deep)).norm(),
            1e-12);
}

/// The corner of three planes curves the field. No place near the rest keeps the margin and is nearer to the device.
TEST(BallCycle, RestsAtTheNearestPlaceThatKeepsTheMargin) {
  Random random(3);
  for (const SceneImage* image : {&corner(), &groove(), &maze()}) {
    for (int trial = 0; trial < 6; ++trial) {
      BallRun run(*image, {0.02, 0.02, 0.025});
      const Vector3 goal(random.between(-0.02, 0.02), random.between(-0.02, 0.02), random.between(-0.01, 0.015));
      for (int i = 0; i < 60; ++i) ASSERT_EQ(run.step(goal), Status::kOk);
      const double here = (run.center() - goal).norm();
      EXPECT_LT((run.report.force.spring_W.force - run.stiffness() * (run.center() - goal)).norm(), 1e-9);
      EXPECT_EQ(run.report.outcome, here > 0.0 ? Outcome::kContact : Outcome::kFree);
      for (int i = 0; i < 300; ++i) {
        const Vector3 other = run.center() + std::pow(10.0, random.between(-6.0, -4.0)) * random.direction();
        if (run.field().sample(other).distance < run.q.margin) continue;
        ASSERT_GT((other - goal).norm(), here - 2e-6) << trial;
      }
    }
  }
}

/// In a corner the field is curved: a motion can pass the place of the lowest energy along its way. It stops there, so
/// that the centre stops swinging: after 20 cycles it travels less than a margin in all, while the device rests.
TEST(BallCycle, StopsSwingingInACorner) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    BallRun run(corner(), {0.02, 0.02, 0.025});
    const Vector3 goal(random.between(-0.02, 0.02), random.between(-0.02, 0.02), random.between(-0.01, 0.015));
    for (int i = 0; i < 20; ++i) ASSERT_EQ(run.step(goal), Status::kOk);
    double travelled = 0.0;
    for (int i = 0; i < 40; ++i) {
      const Vector3 before = run.center();
      ASSERT_EQ(run.step(goal), Status::kOk);
      travelled += (run.center() - before).norm();
    }
    EXPECT_LT(travelled, run.q.margin) << trial;
  }
}

/// Damping takes the velocity towards the faces that carry load, never more than their load, and nothing of the motion
/// along them.
TEST(BallCycle, DampsTheVelocityTowardsTheFaces) {
  const auto damping_in = [](const SceneImage& image, const Vector3& start, const Vector3& goal,
                             const Vector3& velocity) {
    BallRun run(image, start);
    for (int i = 0; i < 30; ++i) EXPECT_EQ(run.step(goal), Status::kOk);
    EXPECT_EQ(run.step(goal, velocity), Status::kOk);
    const Vector3 force = run.report.force.total_W.force - run.report.force.spring_W.force;
    return Vector3(force / (run.q.damping * run.q.coupling_translation));
  };
  const Vector3 over(0.0, 0.0, 0.002), below(0.0, 0.0, -0.004);
  EXPECT_LT((damping_in(plane(), over, below, {0.1, 0.2, -0.05}) - Vector3(0.0, 0.0, 0.05)).norm(), 1e-9);
  EXPECT_LT((damping_in(plane(), over, below, {0.1, 0.2, 0.05}) - Vector3(0.0, 0.0, -0.05)).norm(), 1e-9)
      << "the load exceeds the damping";
  const Vector3 n(0.6, 0.0, 0.8);
  EXPECT_LT((damping_in(slope(), {0.0, 0.0, 0.01}, -0.004 * n, {0.1, 0.2, -0.05}) + n.dot(Vector3(0.1, 0.2, -0.05)) * n)
                .norm(),
            1e-6);
  // both faces of the groove carry load: nothing is left but the velocity along it
  EXPECT_LT(
      (damping_in(groove(), {0.0, 0.0, 0.01}, {0.0, 0.0, -0.006}, {0.01, 0.02, -0.03}) - Vector3(-0.01, 0.0, 0.03))
          .norm(),
      1e-3);
  // away from the plane faster than the load: the sum is no pull
  BallRun run(plane(), over);
  const Vector3 just_below(0.0, 0.0, -1e-5);
  for (int i = 0; i < 30; ++i) ASSERT_EQ(run.step(just_below), Status::kOk);
  ASSERT_EQ(run.step(just_below, {0.0, 0.0, 10.0}), Status::kOk);
  EXPECT_GT(run.report.force.spring_W.force.z(), 0.0);
  EXPECT_NEAR(run.report.force.total_W.force.z(), 0.0, 1e-9);
}

TEST(BallCycle, StaysInItsWorkspaceWhoseFacesAreNoContacts) {
  BallRun run(plane(), {0.0, 0.0, 0.002});
  run.q.workspace = {true, {-0.01, -kInfinity, 0.0}, {0.004, kInfinity, 0.02}};
  // the device is within the box, but the push of the plane's slope would lead out of it
  BallRun held(slope(), {0.0, 0.0, 0.01});
  held.q.workspace = {true, {-0.01, -kInfinity, -0.02}, {0.001, kInfinity, 0.02}};
  const Vector3 goal(0.001, 0.002, -0.008);
  for (int i = 0; i < 60; ++i) {
    ASSERT_EQ(held.step(goal), Status::kOk);
    ASSERT_TRUE(held.q.workspace.contains(held.center()));
    ASSERT_GT(held.gap(), 0.0);
  }
  // on the face x = 1 mm, at the margin of the slope: 0.6 x + 0.8 z = margin
  const double z = (held.q.margin - 0.6 * 0.001) / 0.8;
  EXPECT_LT((held.center() - Vector3(0.001, 0.002, z)).norm(), 1e-6);
  EXPECT_EQ(held.report.contacts, 1u);
  // the normal's multiplier gives only its own share of the force; the damping is along it
  ASSERT_EQ(held.step(goal, {0.0, 0.0, -0.05}), Status::kOk);
  const Vector3 damping = held.report.force.total_W.force - held.report.force.spring_W.force;
  EXPECT_LT((damping - held.q.damping * 0.05 * 0.8 * Vector3(0.6, 0.0, 0.8)).norm(), 1e-6);

  ASSERT_EQ(run.step({0.004, 0.001, 0.0}), Status::kOk);
  for (int i = 0; i < 10; ++i) ASSERT_EQ(run.step({0.004, 0.001, 0.0}), Status::kOk);
  EXPECT_LT((run.center() - Vector3(0.004, 0.001, run.q.margin)).norm(), 1e-6);
}

/// The device is outside of the box, wherever. The centre rests at the place within the box and above the slope that is
/// nearest to the device itself: then spring and push are the gradient of one energy. Slope and box in the plane of x
/// and z, so that the nearest place is one of a few points.
TEST(BallCycle, RestsNearestToADeviceOutsideOfTheWorkspace) {
  Random random(51);
  int both = 0, differ = 0;
  for (int i = 0; i < 200; ++i) {
    BallRun run(slope(), {0.0, 0.0, 0.002});
    run.q.workspace = {true, {-0.01, -kInfinity, -0.01}, {random.between(0.001, 0.01), kInfinity, 0.01}};
    const Vector3 device(random.between(-0.02, 0.02), 0.0, random.between(-0.02, 0.01));
    for (int cycle = 0; cycle < 300; ++cycle) ASSERT_EQ(run.step(device), Status::kOk);
    const WorkspaceBox& box = run.q.workspace;
    const Vector3 n(0.6, 0.0, 0.8);
    const double margin = run.q.margin;
    std::vector<Vector3> places = {device - (n.dot(device) - margin) * n, box.nearest(device)};
    for (const double x : {box.low.x(), box.high.x()}) {
      places.emplace_back(x, 0.0, (margin - 0.6 * x) / 0.8);
    }
    for (const double z : {box.low.z(), box.high.z()}) {
      places.emplace_back((margin - 0.8 * z) / 0.6, 0.0, z);
    }
    Vector3 best = Vector3::Constant(kInfinity);
    for (const Vector3& p : places) {
      if (n.dot(p) < margin - 1e-12 || (p - box.nearest(p)).norm() > 1e-12) continue;
      if ((p - device).norm() < (best - device).norm()) best = p;
    }
    EXPECT_LT((run.center() - best).norm(), 2e-6) << i << ", device " << device.transpose();
    const Vector3 force = run.stiffness() * (run.center() - device);
    EXPECT_LT((run.report.force.spring_W.force - force).norm(), 1e-9) << "the whole stretch";
    both += run.report.outside && run.report.contacts > 0 ? 1 : 0;
    const Vector3 followed = box.nearest(device);
    const Vector3 of_followed = followed - std::min(0.0, n.dot(followed) - margin) * n;
    differ += (box.nearest(of_followed) - best).norm() > 1e-4 ? 1 : 0;
  }
  EXPECT_GT(both, 50);
  EXPECT_GT(differ, 20) << "from the place that is nearest to the place in the box nearest to the device";
}

/// The centre is between a face of the workspace and a plane that is hardly tilted against it, with less than its
/// margin of room. It does not leave along the wedge, however far beyond the face the device is.
TEST(BallCycle, StaysInAWedgeWhereverTheDeviceIs) {
  constexpr double kTilt = 2e-4;
  const Vector3 n(std::sin(kTilt), 0.0, -std::cos(kTilt));
  const SceneImage image = image_of(planes({n}), 0.004);
  for (const double beyond : {0.0, 0.001, 0.01, 0.1, 1.0}) {
    BallRun run(image, Vector3::Zero());
    const Vector3 start = 0.9 * run.q.margin * n;
    run.state.H_WS.translation = start;
    run.q.workspace = {true, {-0.03, -0.03, start.z()}, {0.03, 0.03, 0.03}};
    ASSERT_EQ(run.step({0.0, 0.0, start.z() - beyond}), Status::kOk);
    EXPECT_LT((run.center() - start).norm(), 4.0 * run.q.margin) << beyond;
  }
}

/// A slope pushes the centre onto a face of the workspace, and there is a wall in front of it. The second look finds
/// the way along all three in a few sub-steps; without it the motion would be shortened again and again.
TEST(BallCycle, FindsTheWayAlongAWallWhileAFaceOfTheWorkspaceHoldsIt) {
  static const SceneImage image = image_of(planes({Vector3(0.6, 0.0, 0.8), kY}), 0.004);
  for (const double beyond : {0.0, 0.004})
    for (const double far : {0.0045, 0.005, 0.0055, 0.006, 0.007}) {
      const Vector3 goal(0.001 + beyond, -0.004, -0.003);
      BallRun run(image, {-0.001, far, 0.0});
      run.q.workspace = {true, {-0.01, -0.03, -0.02}, {0.001, 0.03, 0.02}};
      run.state.H_WS.translation.z() = (run.q.margin + 0.6 * 0.001) / 0.8;
      ASSERT_GT(run.gap(), 0.0) << far;
      ASSERT_EQ(run.step(goal), Status::kOk);
      EXPECT_NEAR(run.center().x(), 0.001, run.lengths().metric.tolerance) << "on the face";
      EXPECT_LT(run.center().y(), 4e-4) << "at the wall, where the field is curved";
      EXPECT_GT(run.gap(), run.lengths().least_margin) << far;
      EXPECT_EQ(run.report.outcome, Outcome::kContact) << far;
      EXPECT_EQ(run.report.contacts, 2u) << "the face is no contact";
      EXPECT_LE(run.report.substeps, 5u) << far;
      for (int i = 0; i < 20; ++i) {
        const Vector3 before = run.center();
        ASSERT_EQ(run.step(goal), Status::kOk);
        EXPECT_LT((run.center() - before).norm(), run.q.margin) << "it has arrived " << far << ' ' << i;
        EXPECT_EQ(run.report.outcome, Outcome::kContact) << far;
        EXPECT_LE(run.report.substeps, 2u) << far << ' ' << i;
      }
    }
}

/// The centre slides on a plate and past its edge; the device is 1 mm below the top. Beyond the edge nothing holds the
/// centre: in the same cycle it goes to the device, and is released.
TEST(BallCycle, GoesDownToTheDevicePastAnEdgeInTheSameCycle) {
  for (const double begin : {0.0, 0.0002, 0.0005, 0.0008}) {
    BallRun run(flat_block(), {0.014 + begin, 0.001, 0.0125});
    int beyond = 0;
    for (int i = 1; i < 16; ++i) {
      const Vector3 goal(0.014 + begin + 0.001 * i, 0.001, 0.011);
      ASSERT_EQ(run.step(goal), Status::kOk);
      if (goal.x() < 0.015) {
        EXPECT_EQ(run.report.outcome, Outcome::kContact) << goal.x();
      } else if (goal.x() > 0.024) {
        EXPECT_EQ(run.center(), goal);
        EXPECT_EQ(run.report.outcome, Outcome::kFree);
        EXPECT_EQ(run.report.contacts, 0u);
        ++beyond;
      }
      // no motion ends beside the surface while the device is farther down
      const bool follows = run.center() == goal;
      EXPECT_TRUE(follows || run.gap() < run.q.margin + run.lengths().opening) << begin << ' ' << i;
    }
    EXPECT_GT(beyond, 3);
  }
}

/// The device draws the centre over a ridge, by less than the tolerance a cycle. A motion that short ends the cycle,
/// also where the surface turns: the centre slides down the other face in the next one.
TEST(BallCycle, EndsWithAMotionWithinTheTolerance) {
  const Vector3 left = Vector3(-0.1, 0.0, 1.0).normalized(), right = Vector3(0.1, 0.0, 1.0).normalized();
  const SceneImage ridge = image_of([&](const Vector3& p) { return std::max(left.dot(p), right.dot(p)); }, 0.004);
  BallRun run(ridge, {-4e-6, 0.001, 0.0});
  run.state.H_WS.translation.z() = 0.1 * -4e-6 + run.q.margin;
  Vector3 goal = run.center() - 0.001 * left;
  for (int i = 0; i < 100; ++i) ASSERT_EQ(run.step(goal), Status::kOk);
  ASSERT_LT(run.field().sample(run.center()).gradient.x(), 0.0) << "on the left face";
  const double tolerance = run.lengths().metric.tolerance;
  Vector3 before = run.center();
  int cycles = 0;
  for (; cycles < 3000 && (run.center() - before).norm() <= tolerance; ++cycles) {
    before = run.center();
    goal.x() += 0.3 * tolerance;
    ASSERT_EQ(run.step(goal), Status::kOk);
  }
  EXPECT_LT(cycles, 3000);
  EXPECT_GT(run.field().sample(before).gradient.x(), 0.0) << "the short motion over the ridge has ended its cycle";
  EXPECT_GT(run.center().x(), 1e-4) << "towards the device, 1 mm below the left face";
}

/// The same with a device that is far below the top, so that the way down takes several sub-steps. The cycle ends with
/// the one that reaches the device.
TEST(BallCycle, TakesNoSubstepBeyondTheOneThatReachesTheDevice) {
  int several = 0;
  for (const double depth : {0.001, 0.003, 0.006}) {
    for (const double begin : {0.0, 0.0002, 0.0005, 0.0008}) {
      BallRun run(flat_block(), {0.014 + begin, 0.001, 0.0125});
      for (int i = 1; i < 12; ++i) {
        const Vector3 goal(0.014 + begin + 0.001 * i, 0.001, 0.012 - depth);
        ASSERT_EQ(run.step(goal), Status::kOk);
        const auto poses = run.path.poses();
        for (std::size_t k = 0; k + 1 < poses.size(); ++k) {
          EXPECT_NE(poses[k].translation, goal) << depth << ' ' << begin << ' ' << i;
        }
        several += poses.size() > 1 && run.center() == goal ? 1 : 0;
      }
    }
  }
  EXPECT_GT(several, 0);
}

/// A surface beyond the longest search radius does not direct the motion. The top of the block is 15 mm below the
/// centre, the device lower than the top and beside the block, and the straight way passes the edge by 4 mm: the centre
/// goes that way in one sub-step, and not along the plane of the top.
TEST(BallCycle, GoesStraightPastASurfaceBeyondTheSearchRadius) {
  const Vector3 start(0.01, 0.001, 0.027), goal(0.034, 0.001, 0.005);
  BallRun run(flat_block(), start);
  const FieldSample here = run.field().sample(start);
  ASSERT_TRUE(here.known) << "the field has a gradient there";
  ASSERT_GT(here.clearance, run.lengths().longest_search_radius);
  ASSERT_LT(here.clearance, run.field().assured_clearance());
  ASSERT_EQ(run.step(goal), Status::kOk);
  EXPECT_EQ(run.center(), goal);
  EXPECT_EQ(run.report.substeps, 1u);
  EXPECT_EQ(run.path.poses().size(), 1u);
}

/// The surface is near, but holds nothing.
TEST(BallCycle, TakesOneSubstepBesideASurface) {
  BallRun run(plane(), {0.0, 0.0, 0.0003});
  for (int i = 1; i < 20; ++i) {
    const Vector3 goal(1e-4 * i, 0.0, 0.0003);
    ASSERT_LT(run.gap(), run.lengths().shortest_search_radius);
    ASSERT_EQ(run.step(goal), Status::kOk);
    EXPECT_EQ(run.center(), goal);
    EXPECT_EQ(run.report.contacts, 0u);
    EXPECT_EQ(run.report.substeps, 1u);
    EXPECT_EQ(run.path.poses().size(), 1u);
  }
}

/// The path keeps the first poses, as many as there is room for.
TEST(SubstepPath, KeepsNoMorePosesThanItHasRoomFor) {
  struct {
    SubstepPath path;
    std::uint64_t behind = 0x0123456789abcdef;
  } both;
  for (std::uint32_t i = 0; i < SubstepPath::kCapacity + 3; ++i) {
    Pose H;
    H.translation.x() = i;
    both.path.push(H);
  }
  ASSERT_EQ(both.path.poses().size(), SubstepPath::kCapacity);
  for (std::uint32_t i = 0; i < SubstepPath::kCapacity; ++i) EXPECT_EQ(both.path.poses()[i].translation.x(), i);
  EXPECT_EQ(both.behind, 0x0123456789abcdef);
}

TEST(BallCycle, StaysWhereANumberIsNotFinite) {
  BallRun run(plane(), {0.0, 0.0, 0.002});
  for (int i = 0; i < 10; ++i) ASSERT_EQ(run.step({0.0, 0.0, -0.004}), Status::kOk);
  const Vector3 before = run.center();
  const CycleReport report = run.report;
  EXPECT_EQ(run.step({0.0, std::nan(""), 0.0}), Status::kNotFinite);
  EXPECT_EQ(run.center(), before);
  EXPECT_EQ(run.report.contacts, report.contacts);
  EXPECT_EQ(run.report.H_WS.translation, before);
}

// -- starts inside

TEST(BallCycle, ComesOutAlongTheGradientByAShareOfTheDepth) {
  BallRun run(plane(), {0.0, 0.0, -0.003});
  run.state.started = false;
  run.state.inside = true;
  const ContactLengths lengths = run.lengths();
  const Vector3 device = run.center();
  for (int i = 0; i < 40 && run.center().z() <= 0.0; ++i) {
    const double depth = -run.center().z();
    ASSERT_EQ(run.step(device), Status::kOk);
    EXPECT_EQ(run.report.outcome, Outcome::kStartInside);
    const double gain = std::min(0.3 * (depth + lengths.margin), lengths.largest_gain);
    EXPECT_NEAR(run.center().z() + depth, gain, 1e-4 * gain + 2.0 * lengths.metric.tolerance) << i;
  }
  ASSERT_GT(run.center().z(), 0.0);
  ASSERT_EQ(run.step(device), Status::kOk);
  EXPECT_EQ(run.report.outcome, Outcome::kContact) << "it has come out";
  EXPECT_FALSE(run.state.inside);
}

/// A cycle that starts inside takes one sub-step, also where the nearest face changes during the motion. The centre
/// starts 2 mm behind a face; the device is 6 mm behind another one.
TEST(BallCycle, TakesOneSubstepInsideWhereTheNearestFaceChanges) {
  const Vector3 start(-0.002, 0.02, 0.004), goal(-0.002, 0.02, -0.006);
  BallRun run(corner(), start);
  run.state.started = false;
  run.state.inside = true;
  ASSERT_GT(run.field().sample(start).gradient.x(), 0.99);
  ASSERT_GT(run.field().sample(goal).gradient.z(), 0.99);
  const ContactLengths lengths = run.lengths();
  const double gain = std::min(0.3 * (0.002 + lengths.margin), lengths.largest_gain);
  ASSERT_EQ(run.step(goal), Status::kOk);
  EXPECT_EQ(run.report.outcome, Outcome::kStartInside);
  EXPECT_EQ(run.report.substeps, 1u);
  EXPECT_EQ(run.path.poses().size(), 1u);
  EXPECT_LT((run.center() - Vector3(start.x() + gain, goal.y(), goal.z())).norm(), 0.01 * gain);
}

TEST(BallCycle, FollowsTheDeviceWithoutForceWhereTheFieldEnds) {
  BallRun run(plane(), {0.0, 0.0, -0.03});
  run.state.started = false;
  run.state.inside = true;
  ASSERT_FALSE(run.field().sample(run.center()).known) << "deeper than the band";
  for (const double z : {-0.031, -0.029}) {
    ASSERT_EQ(run.step({0.001, 0.0, z}), Status::kOk);
    EXPECT_EQ(run.center(), Vector3(0.001, 0.0, z));
    EXPECT_EQ(run.report.force.total_W.force, Vector3::Zero());
    EXPECT_EQ(run.report.outcome, Outcome::kStartInside);
    EXPECT_EQ(run.report.substeps, 1u);
    ASSERT_EQ(run.path.poses().size(), 1u);
    EXPECT_EQ(run.path.poses()[0].translation, run.center());
  }
  // out with the device: then it is free, for good
  ASSERT_EQ(run.step({0.0, 0.0, 0.02}), Status::kOk);
  ASSERT_EQ(run.step({0.0, 0.0, 0.02}), Status::kOk);
  EXPECT_FALSE(run.state.inside);
  EXPECT_EQ(run.report.outcome, Outcome::kFree);
}

// -- whatever the device does

/// The workspace ends at the surface, and the centre is above both, by less than stored distances are exact. The
/// nearest place of the workspace has the distance 0: the centre may not go there.
TEST(BallCycle, DoesNotEnterTheSurfaceThroughAFaceOfTheWorkspace) {
  const double rounding = BallRun(plane(), kZ).lengths().rounding;
  for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9, 1.0, 1.5, 3.0}) {
    BallRun run(plane(), share * rounding * kZ);
    run.q.workspace = {true, {-0.03, -0.03, -0.03}, {0.03, 0.03, 0.0}};
    for (int i = 0; i < 3; ++i) {
      ASSERT_GT(run.gap(), 0.0) << share << ' ' << i;
      ASSERT_EQ(run.step({0.0, 0.0, -0.002}), Status::kOk);
    }
    EXPECT_GT(run.gap(), 0.0) << share;
  }
}

/// Along the whole path, from pose to pose, no distance is <= 0, and the pose at the end is the last of the path.
TEST(BallCycle, LetsTheCentreThroughNothing) {
  for (const unsigned seed : {1u, 2u}) {
    Random random(seed);
    BallRun run(maze(), {-0.02, 0.0, 0.025});
    Vector3 goal = run.center();
    Vector3 velocity = Vector3::Zero();
    int held = 0, cut = 0, gaps_lost = 0;
    const double least_gap = run.lengths().least_margin - run.lengths().rounding;
    for (int cycle = 0; cycle < 400; ++cycle) {
      if (cycle % 25 == 0) velocity = std::pow(10.0, random.between(-5.0, -2.0)) * random.direction();
      if (cycle % 100 == 0) goal = random.in_cube(0.03);
      goal += velocity;
      if (goal.norm() > 0.04) velocity = -velocity.norm() * goal.normalized();
      Vector3 from = run.center();
      const double gap = run.gap();
      ASSERT_EQ(run.step(goal), Status::kOk);
      ASSERT_LE(run.path.poses().size(), static_cast<std::size_t>(kMaxSubsteps));
      ASSERT_LE(run.report.substeps, kMaxSubsteps);
      for (const Pose& pose : run.path.poses()) {
        for (int i = 0; i <= 40; ++i) {
          const Vector3 p = from + i / 40.0 * (pose.translation - from);
          ASSERT_GT(run.field().sample(p).distance, 0.0) << "seed " << seed << " cycle " << cycle;
        }
        from = pose.translation;
      }
      ASSERT_EQ(from, run.center());
      gaps_lost += run.gap() < std::min(gap, least_gap) ? 1 : 0;
      const Vector3 force = run.report.force.spring_W.force;
      ASSERT_LT((force - run.stiffness() * (run.center() - goal)).norm(), 1e-9);
      held += run.report.outcome == Outcome::kContact ? 1 : 0;
      cut += run.report.outcome == Outcome::kCut ? 1 : 0;
      ASSERT_EQ(run.report.outcome == Outcome::kFree, run.center() == goal) << "it is at the device or held";
    }
    EXPECT_EQ(gaps_lost, 0) << "no gap shrinks below the least margin";
    EXPECT_GT(held, 100);
    EXPECT_LT(cut, 50) << "mostly the second look finds the way on";
    std::printf("[ measured ] held %d cut %d\n", held, cut);
  }
}

/// From far outside of the stored band, where the field has no gradient, the device jumps to the other side of a plate.
TEST(BallCycle, StaysOnItsSideOfAPlateThatTheDeviceTeleportsThrough) {
  const Vector3 start(0.03, 0.002, 0.06), behind(0.03, 0.002, -0.05);
  BallRun run(maze(), start);
  ASSERT_FALSE(run.field().sample(start).known) << "farther than the band";
  for (int i = 0; i < 40; ++i) {
    ASSERT_EQ(run.step(behind), Status::kOk);
    ASSERT_GT(run.center().z(), 0.0031) << i;
    ASSERT_NE(run.report.outcome, Outcome::kFree) << i;
  }
  EXPECT_LT(run.center().z(), 0.0031 + 2.0 * run.q.margin) << "it has arrived at the plate";
  EXPECT_EQ(run.report.outcome, Outcome::kContact);
}

/// In steady contact the motion is the nearest to the device that the field's faces allow: the distance from the device
/// never grows while the device rests.
TEST(BallCycle, ComesNearerToADeviceThatRests) {
  Random random(9);
  int compared = 0;
  for (int trial = 0; trial < 8; ++trial) {
    BallRun run(maze(), {-0.02, 0.0, 0.025});
    const Vector3 goal = random.in_cube(0.03);
    double last = kInfinity;
    for (int cycle = 0; cycle < 40; ++cycle) {
      ASSERT_EQ(run.step(goal), Status::kOk);
      const double here = (run.center() - goal).norm();
      // a gap below the margin is regained by at most the margin
      ASSERT_LE(here, last + run.q.margin) << trial;
      last = here;
    }
    // at rest
    const Vector3 before = run.center();
    for (int cycle = 0; cycle < 10; ++cycle) ASSERT_EQ(run.step(goal), Status::kOk);
    EXPECT_LT((run.center() - before).norm(), 1e-4);
    ++compared;
  }
  EXPECT_EQ(compared, 8);
}

/// The cycle for any body, with one point at the body's centre. It searches as far as the ball's cycle does.
class PointRun {
 public:
  explicit PointRun(const BallRun& run) : q_(run.q), scene_(run.field(), shell_of(body_), {}, parameters()) {}

  Status step(const BallRun& run, const Vector3& goal, const Vector3& velocity) {
    state = run.state;
    memory_->search.start(scene_, {});
    memory_->last_step = {};
    memory_->last_step.motion.translation = kX;  // a long motion: the longest search radius
    Motion velocity_W;
    velocity_W.translation = velocity;
    const CycleInput input = input_within({Quaternion::Identity(), goal}, velocity_W, q_);
    return contact_cycle<false>(scene_, input, *memory_, state, report);
  }

  ProxyState state;
  CycleReport report;

 private:
  const Pointshell& shell_of(const SampledBody& body) { return shell_ = body.pointshell(); }
  const Parameters& parameters() {
    q_.mass = body_.mass;
    return q_;
  }

  Parameters q_;
  SampledBody body_{{{Vector3::Zero()}, {-kZ}}, Vector3::Constant(1e-4)};
  Pointshell shell_;
  ContactScene<Voxelmap, NoBodyField> scene_;
  std::unique_ptr<ContactMemory> memory_ = std::make_unique<ContactMemory>();
};

/// The budget of work is spent by the first look-up. It is missing only where the centre is not at its goal, and the
/// centre still moves as far as this look-up proves.
TEST(BallCycle, TellsThatWorkWasMissingWhereTheCentreLags) {
  BallRun run(plane(), {0.0, 0.0, 0.03});
  run.q.work_budget = 1;
  ASSERT_EQ(run.step({0.0, 0.0, 0.028}), Status::kOk);
  EXPECT_EQ(run.center().z(), 0.028) << "free";
  EXPECT_FALSE(run.report.out_of_work);
  const Vector3 start(0.0, 0.0, 2.0 * run.q.margin);
  run.state.H_WS.translation = start;
  ASSERT_EQ(run.step({0.001, 0.0, -0.001}), Status::kOk);
  EXPECT_GT(run.center().x(), 0.0);
  EXPECT_LT(run.center().x(), 0.001);
  EXPECT_GT(run.center().z(), 0.0);
  EXPECT_TRUE(run.report.out_of_work);
  run.q.work_budget = WorkMeter::kUnlimited;
  ASSERT_EQ(run.step({0.001, 0.0, -0.001}), Status::kOk);
  EXPECT_NEAR(run.center().x(), 0.001, 1e-6);
  EXPECT_FALSE(run.report.out_of_work) << "the plane is in the way, not the work";
}

/// A chord close to a surface takes many look-ups. Whatever part of it the budget covers, a motion that is cut goes on:
/// else the next cycle would spend its budget at the same place on the same motion.
TEST(BallCycle, GoesOnWhateverPartOfAChordTheBudgetCovers) {
  int cut = 0;
  for (const SceneImage* image : {&plane(), &flat_block(), &maze(), &flat_maze()}) {
    for (const std::uint64_t budget : {20'000u, 50'000u, 100'000u, 200'000u, 400'000u}) {
      for (const Vector3& goal :
           {Vector3(0.03, 0.0, -0.002), Vector3(-0.02, 0.015, -0.004), Vector3(0.0, 0.03, 0.001)}) {
        BallRun run(*image, {0.0, 0.0, 0.03});
        ASSERT_EQ(run.step({0.001, 0.002, -0.001}), Status::kOk);  // on the surface
        run.q.work_budget = budget;
        for (int cycle = 0; cycle < 200; ++cycle) {
          const Vector3 before = run.center();
          BallRun unlimited(*image, before);
          ASSERT_EQ(unlimited.step(goal), Status::kOk);
          const double possible = (unlimited.center() - before).norm();
          ASSERT_EQ(run.step(goal), Status::kOk);
          if (!run.report.out_of_work) break;
          if (possible < run.q.margin) continue;  // at rest
          ++cut;
          ASSERT_GT((run.center() - before).norm(), 0.1 * run.q.margin)
              << budget << ", cycle " << cycle << " to " << goal.transpose();
        }
      }
    }
  }
  std::printf("[ measured ] out of work in %d cycles\n", cut);
  EXPECT_GT(cut, 100);
}

/// The ball lags by the share of its look-ups for which work is missing, and not at all where the budget suffices.
/// `out_of_work` tells whether it lags.
TEST(BallCycle, LagsByTheLookUpsThatItsBudgetLacks) {
  constexpr double kStep = 5e-4;  // [m]
  constexpr int kCycles = 60;
  constexpr double kFixed = cost_of(Work::kCycle) + cost_of(Work::kBall) + cost_of(Work::kAttempt);  // of a cycle
  BallRun unlimited(plane(), {0.0, 0.0, 0.0});
  unlimited.state.H_WS.translation.z() = unlimited.q.margin;
  for (int i = 1; i <= 10; ++i) ASSERT_EQ(unlimited.step({kStep * i, 0.0, -0.001}), Status::kOk);
  const auto needed = static_cast<double>(unlimited.report.work);
  for (const double share : {0.7, 0.8, 0.9, 0.95, 0.99, 1.0, 1.01, 1.3}) {
    BallRun run(plane(), {0.0, 0.0, 0.0});
    run.state.H_WS.translation.z() = run.q.margin;
    run.q.work_budget = static_cast<std::uint64_t>(share * needed) + 2;
    double most = 0.0;
    for (int i = 1; i <= kCycles; ++i) {
      const double x = kStep * i;
      ASSERT_EQ(run.step({x, 0.0, -0.001}), Status::kOk);
      const double lag = x - run.center().x();
      most = std::max(most, lag);
      EXPECT_EQ(run.report.out_of_work, lag > 2.0 * run.lengths().metric.tolerance) << share << ", cycle " << i;
      ASSERT_LE(run.report.work, run.q.work_budget + 6 * cost_of(Work::kAttempt));
    }
    std::printf("[ measured ] %.2f of the work: lag %.2f steps\n", share, most / kStep);
    const double missing = std::max(0.0, 1.0 - share) * needed / (needed - kFixed);
    EXPECT_LE(most, (kCycles * missing + 0.01) * kStep) << share;
  }
}

/// Both cycles start from the same pose in each cycle: they give the same motion, force, and report.
TEST(BallCycle, DoesAsTheCycleForAnyBodyDoes) {
  int compared = 0, differ = 0, cut = 0, substeps = 0;
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    Random random(seed);
    BallRun run(seed > 4 ? flat_maze() : seed % 2 == 0 ? maze() : groove(), {-0.02, 0.0, 0.025});
    if (seed == 3 || seed == 4) run.q.workspace = {true, {-0.021, -0.01, -0.03}, {0.004, 0.01, 0.03}};
    PointRun other(run);
    Vector3 goal = run.center(), velocity = Vector3::Zero();
    for (int cycle = 0; cycle < 600; ++cycle) {
      if (cycle % 20 == 0) velocity = std::pow(10.0, random.between(-5.0, -2.5)) * random.direction();
      goal += velocity;
      if (goal.norm() > 0.028) velocity = -velocity.norm() * goal.normalized();
      ASSERT_EQ(other.step(run, goal, 1e3 * velocity), Status::kOk);
      const Vector3 before = run.center();
      ASSERT_EQ(run.step(goal, 1e3 * velocity), Status::kOk);
      // the cycle for any body shortens a motion beyond its search radius
      if ((run.center() - before).norm() > 0.003) continue;
      ++compared;
      const bool same = (other.state.H_WS.translation - run.center()).norm() < 2e-6 &&
                        (other.report.force.total_W.force - run.report.force.total_W.force).norm() < 0.02 &&
                        other.report.contacts == run.report.contacts && other.report.outcome == run.report.outcome &&
                        std::fabs(other.report.penetration - run.report.penetration) < 2e-6 &&
                        other.report.substeps == run.report.substeps;
      differ += same ? 0 : 1;
      cut += run.report.outcome == Outcome::kCut ? 1 : 0;
      substeps += run.report.substeps > 1 ? 1 : 0;
    }
  }
  std::printf("[ measured ] compared %d, differ %d, cut %d, with sub-steps %d\n", compared, differ, cut, substeps);
  EXPECT_GT(compared, 1000);
  EXPECT_LE(differ, compared / 40) << "measured: 53 of 2396, where one takes another sub-step";
}

/// A pipe of 1 mm radius. Its field grows by half of a distance, and by less where it is interpolated. The
/// centre has lost a part of its margin at the wall, and the device draws it along the curve. Both cycles expect the
/// same distance at the end of the motion, so that they shorten it alike.
TEST(BallCycle, ShortensAMotionInACurveAsTheCycleForAnyBodyDoes) {
  constexpr double kRadius = 0.001;
  const SceneImage pipe = image_of([](const Vector3& p) { return 0.5 * (kRadius - std::hypot(p.x(), p.z())); }, 0.001);
  const auto across = [](double angle) { return Vector3(std::cos(angle), 0.0, std::sin(angle)); };
  Random random(7);
  int compared = 0, differ = 0;
  for (const double share : {0.1, 0.25, 0.5, 0.75}) {  // of the margin
    for (int trial = 0; trial < 300; ++trial) {
      BallRun run(pipe, Vector3::Zero());
      const double angle = random.between(-M_PI, M_PI);
      double nearer = 0.0, farther = 2.0 * kRadius;
      while (farther - nearer > 1e-12) {
        const double middle = 0.5 * (nearer + farther);
        (run.field().sample(middle * across(angle)).distance > share * run.q.margin ? nearer : farther) = middle;
      }
      run.state.H_WS.translation = nearer * across(angle);
      const Vector3 goal = kRadius * random.between(1.5, 5.0) * across(angle + random.between(-1.0, 1.0));
      PointRun other(run);
      ASSERT_EQ(other.step(run, goal, Vector3::Zero()), Status::kOk);
      ASSERT_EQ(run.step(goal), Status::kOk);
      ++compared;
      differ += (other.state.H_WS.translation - run.center()).norm() > 1e-6 ? 1 : 0;
    }
  }
  std::printf("[ measured ] compared %d, differ %d\n", compared, differ);
  EXPECT_LE(differ, compared / 20) << "measured: 39 of 1200, where one takes another sub-step";
}

/// However slowly the device slides and however hard it presses, the centre slides along in the same cycle.
TEST(BallCycle, SlidesWithoutDelayAtAnySpeed) {
  for (const double lost : {0.0, 0.5e-8, 1.9e-8, 1e-7, 1e-6}) {
    for (const double step : {1e-7, 1e-6, 1e-5, 1e-4}) {
      BallRun run(plane(), Vector3(0.0, 0.0, 0.0));
      run.state.H_WS.translation.z() = run.q.margin - lost;
      for (int i = 1; i <= 20; ++i) {
        const double x = step * i;
        ASSERT_EQ(run.step({x, 0.0, -0.01}), Status::kOk);
        ASSERT_NEAR(run.center().x(), x, 2.0 * run.lengths().metric.tolerance) << lost << ' ' << step << ' ' << i;
      }
    }
  }
}

/// In a slot without room for both margins the gaps stay, and the centre slides along the slot without delay.
TEST(BallCycle, SlidesAlongASlotWithoutRoomForTheMargins) {
  static const SceneImage slot = image_of([](const Vector3& p) { return 0.006 - std::fabs(p.x()); }, 0.004);
  BallRun run(slot, {0.0, 0.0, 0.0});
  run.q.margin = 0.008;
  for (int i = 1; i <= 100; ++i) {
    const double y = 5e-5 * i;
    ASSERT_EQ(run.step({0.02, y, 0.0}), Status::kOk);
    ASSERT_NEAR(run.center().y(), y, 2.0 * run.lengths().metric.tolerance) << "cycle " << i;
  }
}

/// A slot becomes narrower than the wanted margins, but not than the least ones. In its middle the field has no
/// direction, so no second look leads on. The centre follows the device all the same: at first by half of the way.
TEST(BallCycle, GoesIntoANarrowSlotInWhoseMiddleTheFieldHasNoDirection) {
  constexpr double kMiddle = 0.002;  // between two nodes of the field
  const SceneImage slot = image_of(
      [](const Vector3& p) {
        const Vector3 q(std::fabs(p.x() - kMiddle), p.y(), p.z());
        return std::min(0.008 - q.x(), analytic::box_distance(q - Vector3(0.055, 0.05, 0.0), {0.05, 0.05, 0.2}));
      },
      0.004);
  const Vector3 start(kMiddle, -0.01, 0.0), goal(kMiddle, 0.03, 0.0);
  BallRun run(slot, start);
  run.q.margin = 0.005;
  const FieldSample wide = run.field().sample(start), narrow = run.field().sample(goal);
  ASSERT_LT(std::max(wide.gradient.norm(), narrow.gradient.norm()), kFlat);
  ASSERT_GT(wide.distance, run.lengths().wanted_margin);
  ASSERT_LT(narrow.distance, run.lengths().wanted_margin);
  ASSERT_GT(narrow.distance, run.lengths().least_margin);
  ASSERT_EQ(run.step(goal), Status::kOk);
  EXPECT_EQ(run.center(), goal);
  EXPECT_EQ(run.report.substeps, 2u);
  EXPECT_EQ(run.report.outcome, Outcome::kFree);
}

/// Between walls that are nearer to each other than two margins no motion regains both gaps: none may shrink, and the
/// cycle says so.
TEST(BallCycle, StaysBetweenWallsWithoutRoomForTheMargins) {
  static const SceneImage slot = image_of([](const Vector3& p) { return 0.006 - std::fabs(p.x()); }, 0.004);
  BallRun run(slot, {0.0005, 0.0, 0.0});
  run.q.margin = 0.008;
  bool infeasible = false;
  for (int i = 0; i < 60; ++i) {
    const double before = run.gap();
    ASSERT_EQ(run.step({i % 2 == 0 ? 0.01 : -0.01, 1e-4 * i, 0.0}), Status::kOk);
    infeasible |= run.report.outcome == Outcome::kInfeasible;
    ASSERT_GE(run.gap(), std::min(before, run.lengths().least_margin) - 1e-6);
    ASSERT_LT(std::fabs(run.center().x()), 0.005);
  }
  EXPECT_TRUE(infeasible);
}

}  // namespace
}  // namespace godobject::test::ball_cycle_test
