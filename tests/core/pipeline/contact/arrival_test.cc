// The energy of the arcs on which points move, against the exact motion, and the holding points at the end of a motion.
#include "core/pipeline/contact/arrival.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "core/pipeline/contact/second_look.h"
#include "godobject/pose.h"
#include "tests/support/analytic_worlds.h"
#include "tests/support/edge_set.h"

namespace godobject::detail::arrival_test {
namespace {

/// One force at a random place, and a motion of a random direction and of size 1.
struct ArrivalCase {
  explicit ArrivalCase(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };
    force.normal = vector().normalized();
    force.point = vector();
    force.multiplier = 0.5 + std::fabs(normal(random));
    motion = {vector(), vector()};
  }
  ConstrainedStep step(double size) const {
    ConstrainedStep step;
    step.forces[0] = force;
    step.force_count = 1;
    step.motion = {size * motion.translation, size * motion.rotation};
    return step;
  }
  ContactForce force;
  Motion motion;
};

/// Returns the growth of the gap that the row promises: n . (x + r x P).
double promised(const ConstrainedStep& step) {
  const ContactForce& force = step.forces[0];
  return force.normal.dot(step.motion.translation + step.motion.rotation.cross(force.point));
}

/// Expects that the energy is -2 lambda times what the exact growth of the gap misses, but for the third order.
template <class Growth>
void expect_second_order(std::uint32_t id, const Growth& exact) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    ArrivalCase one(random);
    one.force.id = id;
    for (const double size : {1e-2, 1e-3}) {
      const ConstrainedStep step = one.step(size);
      const double missed = exact(step) - promised(step);
      EXPECT_NEAR(arc_energy(step), -2.0 * one.force.multiplier * missed, 100.0 * size * size * size);
    }
  }
}

/// A sample point P of the body moves to x + R P; the surface rests.
TEST(ArcEnergy, OfASamplePointIsThatOfItsArc) {
  expect_second_order(7, [](const ConstrainedStep& step) {
    const ContactForce& force = step.forces[0];
    const Vector3 end = set_matrix(step.motion) * force.point;
    return force.normal.dot(end - force.point);
  });
}

/// A feature point P rests, and the body with its surface moves: in S the point goes to R^T (P - x).
TEST(ArcEnergy, OfAFeaturePointIsThatOfItsArcInTheBody) {
  expect_second_order(kFeature | 7, [](const ConstrainedStep& step) {
    const ContactForce& force = step.forces[0];
    const Vector3 end = set_matrix(step.motion).inverse() * force.point;
    return force.normal.dot(force.point - end);
  });
}

/// A translation has no arc for a sample point. By hand: a point at (1, 0, 0) that turns about z by 0.1 rad falls short
/// of its tangent by 0.005 m in -x; a force of multiplier 3 along x takes 2 x 3 x 0.005.
TEST(ArcEnergy, ByHand) {
  ConstrainedStep step;
  step.force_count = 1;
  step.forces[0].id = 0;
  step.forces[0].point = Vector3::UnitX();
  step.forces[0].normal = Vector3::UnitX();
  step.forces[0].multiplier = 3.0;
  step.motion = {Vector3(0.1, 0.2, 0.3), Vector3::Zero()};
  EXPECT_EQ(arc_energy(step), 0.0);
  step.motion.rotation = Vector3(0.0, 0.0, 0.1);
  EXPECT_NEAR(arc_energy(step), 0.03, 1e-15);
}

/// The floor z = 0 in a field whose distance grows `steepness` times as fast as the height, as a stored field's may.
struct SteepFloor {
  double steepness;
  double distance(const Vector3& p) const noexcept { return steepness * p.z(); }
  Vector3 gradient(const Vector3&) const noexcept { return steepness * Vector3::UnitZ(); }
};

/// One holding point of each kind: a sample point over the floor z = 0, a feature point over the plane z = 0 of the
/// body, and the crossing of two edges.
struct ArrivalWorld {
  ArrivalWorld() = default;
  explicit ArrivalWorld(double steepness) : floor(SteepFloor{steepness}, 0.002) {}
  test::AnalyticField floor{test::HalfSpace{}, 0.002};
  test::SampledBody body{{{{0.01, 0.0, 0.0}}, {-Vector3::UnitZ()}}, Vector3::Constant(1e-4)};
  test::SampledBody tip{{{{0.0, 0.004, 0.0}}, {-Vector3::UnitZ()}}, Vector3::Constant(1e-4)};
  test::EdgeSet moving{{{Vector3(0.0, 0.0, -0.01), Vector3(0.0, 0.0, 0.01)}}};  // in W along y if turned about x
  test::EdgeSet still{{{Vector3(-0.01, 0.0, 0.0), Vector3(0.01, 0.0, 0.0)}}};
  Vector3 origin_W{0.1, -0.2, 0.3};
  Pointshell shell = body.pointshell();
  Parameters parameters;
  ContactScene<test::AnalyticField, test::AnalyticField> scene{
      floor, shell, {&floor, tip.pointshell(), origin_W, 0.05}, parameters, {moving.view(), still.view()}};

  /// A step with a force on the sample point, along the floor's normal.
  static ConstrainedStep step_of_point(const Motion& motion) {
    ConstrainedStep step;
    step.force_count = 1;
    step.forces[0].id = 0;
    step.forces[0].point = {0.01, 0.0, 0.0};
    step.forces[0].normal = Vector3::UnitZ();
    step.forces[0].multiplier = 2.0;
    step.motion = motion;
    return step;
  }
  /// A pose that is turned by a right angle about an axis.
  static Pose turned(const Vector3& axis, const Vector3& position) {
    Pose pose;
    pose.translation = position;
    pose.rotation = exp_rotation(0.5 * M_PI * axis);
    return pose;
  }
  /// A force on the crossing of the edges, of which the upper one is along the body's z axis.
  static ContactForce force_on_edges() {
    ContactForce force;
    force.id = id_of({0, 0});
    force.normal = Vector3::UnitY();  // in W upwards
    force.multiplier = 2.0;
    return force;
  }
};

/// Expects the distances at both ends, and that the gradient times the displacement is their difference.
void expect_end(const EndOfForce& end, double start, double stop, const Vector3& gradient_W) {
  EXPECT_NEAR(end.at_start.distance, start, 1e-9);
  EXPECT_NEAR(end.at_end.distance, stop, 1e-9);
  EXPECT_LT((end.gradient_W - gradient_W).norm(), 1e-9);
  EXPECT_NEAR(end.gradient_W.dot(end.displacement_W), stop - start, 1e-9);
}

TEST(EndOfForce, OfASamplePointIsTheFieldThere) {
  const ArrivalWorld world;
  ContactForce force;
  const Pose H0 = ArrivalWorld::turned(Vector3::UnitZ(), {0.0, 0.0, 0.002});
  const Pose H1 = ArrivalWorld::turned(Vector3::UnitZ(), {0.001, 0.0, 0.005});
  expect_end(end_of(world.scene, H0, H1, force, true), 0.002, 0.005, Vector3::UnitZ());
}

/// The body's plane z = 0 is upright in W and faces -y, so the gap grows as the body moves along y.
TEST(EndOfForce, OfAFeaturePointIsTheFieldOfTheBodyThere) {
  const ArrivalWorld world;
  const Vector3 tip_W = world.origin_W + Vector3(0.0, 0.004, 0.0);
  ContactForce force;
  force.id = kFeature;
  const Pose H0 = ArrivalWorld::turned(Vector3::UnitX(), tip_W + Vector3(0.0, 0.003, 0.0));
  const Pose H1 = ArrivalWorld::turned(Vector3::UnitX(), tip_W + Vector3(0.001, 0.005, 0.0));
  expect_end(end_of(world.scene, H0, H1, force, true), 0.003, 0.005, Vector3::UnitY());
}

/// An edge passes over another one, or through it: then the gap is negative, and the normal is that of the start.
TEST(EndOfForce, OfAnEdgePairIsItsGapThere) {
  const ArrivalWorld world;
  const Pose H0 = ArrivalWorld::turned(Vector3::UnitX(), {0.0, 0.0, 0.001});
  for (const double stop : {0.003, 3e-5, -0.002}) {
    const Pose H1 = ArrivalWorld::turned(Vector3::UnitX(), {0.001, 0.002, stop});
    expect_end(end_of(world.scene, H0, H1, ArrivalWorld::force_on_edges(), true), 0.001, stop, Vector3::UnitZ());
  }
}

/// The plane in W does not turn, that of the body turns with it. Of two forces of one point the nearer one counts.
TEST(Arrival, TellsByHowMuchTheNormalsHaveTurned) {
  const ArrivalWorld world;
  const Vector3 tip_W = world.origin_W + Vector3(0.0, 0.004, 0.0);
  const Pose H0 = ArrivalWorld::turned(Vector3::UnitX(), tip_W + Vector3(0.0, 0.003, 0.0));
  for (const double angle : {0.0, 0.01, 0.1}) {
    Pose H1 = H0;
    H1.rotation = exp_rotation({0.0, angle, 0.0}) * exp_rotation({0.0, 0.0, angle}) * H0.rotation;
    ConstrainedStep step;
    step.force_count = 2;
    step.forces[0].multiplier = 3.0;
    step.forces[0].normal = H0.rotation.conjugate() * Vector3::UnitZ();
    step.forces[1].id = kFeature;
    step.forces[1].multiplier = 1.0;
    step.forces[1].normal = H0.rotation.conjugate() * Vector3::UnitY();
    const double turned = (H1.rotation * H0.rotation.conjugate() * Vector3::UnitY() - Vector3::UnitY()).norm();
    EXPECT_NEAR(arrive(world.scene, H0, H1, step, 1.0).turn, turned, 1e-9) << angle;
    step.force_count = 3;
    step.forces[2] = step.forces[1];
    step.forces[2].normal = H0.rotation.conjugate() * Vector3::UnitX();
    EXPECT_NEAR(arrive(world.scene, H0, H1, step, 1.0).turn, turned, 1e-9) << angle;
    std::swap(step.forces[1], step.forces[2]);
    EXPECT_NEAR(arrive(world.scene, H0, H1, step, 1.0).turn, turned, 1e-9) << angle;
    EXPECT_GE(turned, angle * (1.0 - angle));
  }
  EXPECT_EQ(arrive(world.scene, H0, H0, ConstrainedStep{}, 1.0).turn, 0.0) << "without a force";
}

/// A pair of edges that has left is no contact any more. One that comes too near lacks what is missing to the margin.
TEST(Arrival, TellsWhetherAnEdgePairHasLeftOrLacksAPartOfItsMargin) {
  const ArrivalWorld world;
  const double margin = world.scene.lengths.margin;
  const Pose H0 = ArrivalWorld::turned(Vector3::UnitX(), {0.0, 0.0, 0.001});
  for (const double stop : {0.003, 3e-5, 1e-5, -0.002}) {
    const Pose H1 = ArrivalWorld::turned(Vector3::UnitX(), {0.001, 0.002, stop});
    ConstrainedStep step;
    step.force_count = 1;
    step.forces[0] = ArrivalWorld::force_on_edges();
    step.motion = get_motion(H0.inverse() * H1);
    const Arrival arrival = arrive(world.scene, H0, H1, step, 1.0);
    EXPECT_EQ(arrival.opened, stop > margin + world.scene.lengths.opening) << stop;
    EXPECT_NEAR(arrival.rise, 0.0, 1e-12) << "its normal does not turn";
    const EndGaps gaps = end_gaps(world.scene, H0, H1, step, 1.0);
    EXPECT_NEAR(gaps.most, std::max(0.0, margin - stop), 1e-9);
    if (stop > margin) continue;
    EXPECT_EQ(gaps.id, id_of({0, 0}));
    EXPECT_NEAR(gaps.sample.distance, stop, 1e-9);
  }
}

/// By hand: the body turns by an angle about the horizontal axis y while it moves upwards. Its sample point, at 0.01 m
/// along x, is above its margin, so its row leads to the margin; its linear motion rises by the body's rise less 0.01 m
/// times the angle, its true one by the body's rise less 0.01 m times the sine.
void expect_energy_of_a_turned_point(double steepness, double angle, double rise) {
  const ArrivalWorld world(steepness);
  const double margin = world.scene.lengths.margin;
  Pose H0;
  H0.translation = {0.0, 0.0, 2.0 * margin + 0.01};
  Pose H1 = H0;
  H1.translation.z() += rise;
  H1.rotation = exp_rotation({0.0, angle, 0.0});
  const ConstrainedStep step = ArrivalWorld::step_of_point({{0.0, 0.0, rise}, {0.0, angle, 0.0}});
  const double height = H0.translation.z() + rise - 0.01 * std::sin(angle);
  const double increase = rise - 0.01 * angle;
  EXPECT_NEAR(end_gaps(world.scene, H0, H1, step, 1.0).energy, 2.0 * 2.0 * (margin / steepness - height - increase),
              1e-9)
      << steepness << ' ' << angle << ' ' << rise;
}

TEST(EndGaps, HaveTheEnergyOfAPointThatTurnsWithTheBody) {
  for (const double steepness : {1.0, 0.5, 2.0}) {
    for (const double angle : {0.0, 0.1, -0.2}) {
      for (const double rise : {0.0, 1e-4}) expect_energy_of_a_turned_point(steepness, angle, rise);
    }
  }
}

/// A point below its margin rises by less than its row may regain. The distance in the field grows by steepness times
/// the rise, as the row promises. Nothing is lacking at the end, so that the energy is that of the rise alone.
TEST(EndGaps, ExpectAsMuchDistanceAsTheFieldGrowsByTheRise) {
  for (const double steepness : {1.0, 0.5, 2.0}) {
    const ArrivalWorld world(steepness);
    const double margin = world.scene.lengths.margin;
    const double rise = 0.02 * margin;
    Pose H0;
    H0.translation.z() = 0.5 * margin / steepness;
    Pose H1 = H0;
    H1.translation.z() += rise;
    const ConstrainedStep step = ArrivalWorld::step_of_point({{0.0, 0.0, rise}, Vector3::Zero()});
    const EndGaps gaps = end_gaps(world.scene, H0, H1, step, 1.0);
    EXPECT_NEAR(gaps.energy, -2.0 * 2.0 * rise, 1e-6 * rise) << steepness;
    EXPECT_NEAR(gaps.most, 0.0, 1e-6 * rise) << steepness;
  }
}

/// The upper edge turns by an angle t about a line along the lower one, c above it. The holding place slides along the
/// upper edge, whose distance to the line stays L - c: the gap grows by c (cos t - 1). The row knows the displacement
/// of the body's origin, which lies on the edge: (L - c) (cos t - 1).
TEST(Arrival, TellsTheRiseOfAnEdgeThatRocksOverAnother) {
  const ArrivalWorld world;
  constexpr double kGap = 0.001;
  const Pose H0 = ArrivalWorld::turned(Vector3::UnitX(), {0.0, 0.0, kGap});
  for (const double height : {0.0, 0.5 * kGap, -0.01, 0.0006}) {
    for (const double angle : {0.0, 0.01, -0.1}) {
      const Vector3 line(0.0, 0.0, height);
      Pose H1;
      H1.rotation = exp_rotation({angle, 0.0, 0.0}) * H0.rotation;
      H1.translation = line + exp_rotation({angle, 0.0, 0.0}) * Vector3(H0.translation - line);
      ConstrainedStep step;
      step.force_count = 1;
      step.forces[0] = ArrivalWorld::force_on_edges();
      step.motion = get_motion(H0.inverse() * H1);
      const double lost = (2.0 * height - kGap) * (1.0 - std::cos(angle));
      const Arrival arrival = arrive(world.scene, H0, H1, step, 1.0);
      EXPECT_NEAR(arrival.rise + arc_energy(step), 2.0 * step.forces[0].multiplier * lost, 1e-12)
          << height << ' ' << angle;
      EXPECT_NEAR(arrival.turn, std::fabs(2.0 * std::sin(0.5 * angle)), 1e-9);
    }
  }
}

/// Both directions: the distance of a linear field grows by n . (x + r x P) as the body moves, to first order. The pose
/// is that of the carrying frame in the field's frame: of S in W, or of W in S.
template <class Direction, class FieldPose>
void expect_growth_of_the_distance(const FieldPose& field_pose) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };
  constexpr double kSmall = 1e-6;
  for (int i = 0; i < 100; ++i) {
    const Vector3 gradient = vector();
    const Vector3 p = vector();
    const Pose H_WS = set_matrix({vector(), vector()});
    const Motion motion{kSmall * vector(), kSmall * vector()};
    const Pose H0 = field_pose(H_WS);
    const Pose H1 = field_pose(H_WS * set_matrix(motion));
    const Matrix3 R = H0.rotation.toRotationMatrix();
    const ContactPoint contact = Direction::contact(p, H0 * p, gradient, R);
    const double growth = gradient.dot(H1 * p - H0 * p);
    const Vector3 displacement = motion.translation + motion.rotation.cross(contact.point_S);
    EXPECT_NEAR(contact.gradient_S.dot(displacement), growth, 1e-10);
    EXPECT_NEAR(gradient.dot(Direction::from_S(R) * displacement), growth, 1e-10);
  }
}

TEST(ContactDirections, GiveTheGrowthOfASamplePointsDistance) {
  expect_growth_of_the_distance<SampleDirection>([](const Pose& H_WS) { return H_WS; });
}

TEST(ContactDirections, GiveTheGrowthOfAFeaturePointsDistance) {
  expect_growth_of_the_distance<FeatureDirection>([](const Pose& H_WS) { return H_WS.inverse(); });
}

/// The row of an obstacle on an arc asks for what the arc loses; a straight motion loses nothing.
TEST(PushObstacle, AsksForTheLossOfTheArc) {
  ContactLengths lengths{};
  lengths.margin = 0.01;
  std::mt19937 random(5);
  for (int i = 0; i < 100; ++i) {
    const ArrivalCase one(random);
    const Motion step = one.step(0.1).motion;
    const Motion straight{step.translation, Vector3::Zero()};
    const auto near = std::make_unique<NearPoints>();
    near->count = 1;
    near->index[0] = 4;
    near->x[0] = static_cast<float>(one.force.point.x());
    near->y[0] = static_cast<float>(one.force.point.y());
    near->z[0] = static_cast<float>(one.force.point.z());
    near->distance[0] = 0.02;
    Obstacle obstacle;
    obstacle.near = 0;
    obstacle.share = 1.0;
    obstacle.sample.known = true;
    obstacle.sample.distance = 0.005;
    obstacle.sample.gradient = one.force.normal;
    const auto gain = [&](const Motion& motion, bool is_arc) {
      const auto rows = std::make_unique<ContactRows>();
      const Pose H0;
      const Pose H1 = set_matrix(motion);
      EXPECT_TRUE(push_obstacle<SampleDirection>({H0, H1, motion, 1.0, is_arc}, lengths, *near, obstacle, *rows));
      EXPECT_EQ(rows->count, 1u);
      return static_cast<double>(rows->required_gain[0]);
    };
    EXPECT_NEAR(gain(straight, true), gain(straight, false), 1e-12);
    const Vector3 p = near->point(0);
    const double loss = one.force.normal.dot(step.translation + step.rotation.cross(p) - (set_matrix(step) * p - p));
    EXPECT_NEAR(gain(step, true) - gain(step, false), std::max(0.0, loss), 1e-6);
  }
}

}  // namespace
}  // namespace godobject::detail::arrival_test
