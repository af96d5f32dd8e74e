// The energy of the arcs on which points move, against the exact motion.
#include "core/pipeline/contact/arrival.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "core/pipeline/contact/second_look.h"
#include "godobject/pose.h"

namespace godobject::detail {
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
}  // namespace godobject::detail
