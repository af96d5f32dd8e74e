// The row of an obstacle: on planes it is known exactly, whatever the place where the obstacle was seen.

#include "core/pipeline/contact/second_look.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace godobject::detail::second_look_test {
namespace {

using test::Random;

constexpr double kMargin = 2e-5;

ContactLengths lengths_of() {
  ContactLengths lengths{};
  lengths.margin = kMargin;
  return lengths;
}

/// A field whose distance grows by `steepness` along the unit vector `normal`.
struct LinearField {
  Vector3 normal;
  double steepness, offset;
  FieldSample sample(const Vector3& p) const {
    FieldSample sample;
    sample.distance = steepness * normal.dot(p) + offset;
    sample.gradient = steepness * normal;
    sample.known = true;
    return sample;
  }
};

/// A near point of a motion, and the obstacle that it meets in a linear field.
struct Meeting {
  std::unique_ptr<NearPoints> near = std::make_unique<NearPoints>();
  std::unique_ptr<ContactRows> rows = std::make_unique<ContactRows>();
  Obstacle obstacle;
  LinearField field;
  Pose H0, H1;  // of the shell in the field's frame
  Motion step;
  double share = 1.0;
  Vector3 p;  // the point in the shell's frame, in single precision

  Meeting(Random& random, double start_distance, double at_share) {
    p = random.in_cube(0.05).cast<float>().cast<double>();
    H0 = set_matrix({random.in_cube(0.1), random.in_cube(1.0)});
    H1 = set_matrix({random.in_cube(0.001), random.in_cube(0.01)}) * H0;
    field.normal = random.direction();
    field.steepness = random.between(0.5, 1.5);
    field.offset = 0.0;
    field.offset = start_distance - field.sample(H0 * p).distance;
    near->count = 3;
    obstacle.near = 2;
    near->index[2] = 71;
    near->x[2] = static_cast<float>(p.x());
    near->y[2] = static_cast<float>(p.y());
    near->z[2] = static_cast<float>(p.z());
    near->distance[2] = start_distance;
    obstacle.share = at_share;
    obstacle.sample = field.sample(H0 * p + at_share * (H1 * p - H0 * p));
  }

  template <class Direction>
  bool push(bool is_arc) {
    return push_obstacle<Direction>({H0, H1, step, share, is_arc}, lengths_of(), *near, obstacle, *rows);
  }
  double gain() const { return static_cast<double>(rows->required_gain[rows->count - 1]); }
};

/// On a plane the obstacle tells nothing new. The row is that of the start: a gap beyond the margin may shrink to it;
/// of a lost gap the motion regains the share kRecovery, as in any row.
TEST(PushObstacle, GivesTheRowOfTheStartOnAPlane) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    for (const double start : {-1e-3, -1e-5, 0.5 * kMargin, kMargin, 1.5 * kMargin, 1e-3}) {
      Meeting one(random, start, random.between(0.0, 1.0));
      ASSERT_TRUE(one.push<SampleDirection>(false));
      ASSERT_EQ(one.rows->count, 1u);
      EXPECT_EQ(one.rows->id[0], 71u);
      const Vector3 normal_S = one.H0.rotation.conjugate()._transformVector(one.field.normal);
      EXPECT_LT((one.rows->normal(0) - normal_S).norm(), 1e-6);
      EXPECT_LT((one.rows->point(0) - one.p).norm(), 1e-7);
      const double lost = kMargin - start;
      const double along = lost / one.field.steepness;
      const double expected = lost > 0.0 ? std::min(0.3 * lost, along) : along;
      EXPECT_NEAR(one.gain(), expected, 1e-9) << trial << ' ' << start;
    }
  }
}

/// The second direction: the shell rests in W, and the field moves with S. The row is at the point's place in S.
TEST(PushObstacle, GivesTheRowOfAFeaturePoint) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    Meeting one(random, 3.0 * kMargin, random.between(0.0, 1.0));
    ASSERT_TRUE(one.push<FeatureDirection>(false));
    ASSERT_EQ(one.rows->count, 1u);
    EXPECT_EQ(one.rows->id[0], kFeature | 71u);
    EXPECT_LT((one.rows->normal(0) + one.field.normal).norm(), 1e-6);
    EXPECT_LT((one.rows->point(0) - one.H0 * one.p).norm(), 1e-7);
    EXPECT_NEAR(one.gain(), -2.0 * kMargin / one.field.steepness, 1e-9);
  }
}

/// A second plane behind the first one: the row keeps the margin from the plane that the obstacle saw.
TEST(PushObstacle, KeepsTheMarginFromThePlaneThatItSees) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    // the nearest surface at the start is another one, at 2 margins
    Meeting one(random, 50.0 * kMargin, random.between(0.0, 1.0));
    one.near->distance[2] = 2.0 * kMargin;
    ASSERT_TRUE(one.push<SampleDirection>(false));
    EXPECT_NEAR(one.gain(), -49.0 * kMargin / one.field.steepness, 1e-9);
    // the plane may ask for no more than the recovery of the gap at the start
    Meeting lost(random, -50.0 * kMargin, 0.5);
    lost.near->distance[2] = 0.5 * kMargin;
    ASSERT_TRUE(lost.push<SampleDirection>(false));
    EXPECT_NEAR(lost.gain(), 0.15 * kMargin, 1e-9);
    lost.near->distance[2] = 2.0 * kMargin;
    ASSERT_TRUE(lost.push<SampleDirection>(false));
    EXPECT_EQ(lost.gain(), 0.0) << "rest stays feasible";
    EXPECT_EQ(lost.rows->count, 2u);
  }
}

/// A point at (L, 0, 0) turns about z by the share s of the angle a. Along the normal (cos b, sin b, 0) its tangent
/// promises s a L sin b; its arc gives L (cos b (cos(s a) - 1) + sin b sin(s a)). The obstacle lies at the share o of
/// the chord. The loss is for the whole step, so it is the difference times o / s.
TEST(PushObstacle, AsksForTheLossOfTheArcAtTheSharesOfStepAndChord) {
  constexpr double kLever = 0.125, kAngle = 0.2;
  Random random(4);
  for (const double share : {1.0, 0.5, 0.125}) {
    for (const double of_chord : {1.0, 0.75, 0.25}) {
      for (const double b : {0.0, 0.3, -0.4, 2.8}) {
        Meeting one(random, 1e-3, of_chord);
        one.p = Vector3(kLever, 0.0, 0.0);
        one.near->x[2] = static_cast<float>(kLever);
        one.near->y[2] = one.near->z[2] = 0.0f;
        one.step.rotation = Vector3(0.0, 0.0, kAngle);
        one.share = share;
        one.H0 = Pose{};
        one.H1 = set_matrix({Vector3::Zero(), share * one.step.rotation});
        one.field = {Vector3(std::cos(b), std::sin(b), 0.0), 0.8, 0.0};
        one.field.offset = 1e-3 - one.field.sample(one.p).distance;
        one.obstacle.sample = one.field.sample(one.p + of_chord * (one.H1 * one.p - one.p));
        ASSERT_TRUE(one.push<SampleDirection>(false));
        const double without = one.gain();
        ASSERT_TRUE(one.push<SampleDirection>(true));
        const double turn = share * kAngle;
        const double promised = turn * std::sin(b);
        const double arc = std::cos(b) * (std::cos(turn) - 1.0) + std::sin(b) * std::sin(turn);
        const double loss = kLever * of_chord / share * (promised - arc);
        EXPECT_NEAR(one.gain() - without, std::max(0.0, loss), 1e-8) << share << ' ' << of_chord << ' ' << b;
      }
    }
  }
}

/// A point at (L, 0, 0) turns about z, before a wall across x: its arc takes it back, its tangent does not.
TEST(PushObstacle, TakesAnAttemptForTheWholeMotionAlongItsChord) {
  Random random(7);
  Meeting one(random, 1e-3, 1.0);
  one.near->x[2] = 0.125f;
  one.near->y[2] = one.near->z[2] = 0.0f;
  one.p = Vector3(0.125, 0.0, 0.0);
  one.step.rotation = Vector3(0.0, 0.0, 0.2);
  one.H0 = Pose{};
  one.H1 = set_matrix(one.step);
  one.field = {Vector3::UnitX(), 1.0, -0.124};
  one.obstacle.sample = one.field.sample(one.H1 * one.p);
  const auto push = [&one](const Attempt& attempt) {
    EXPECT_TRUE(push_obstacle<SampleDirection>(attempt, lengths_of(), *one.near, one.obstacle, *one.rows));
    return one.gain();
  };
  const double of_chord = push({one.H0, one.H1, one.step, 1.0, false});
  const double of_arc = push({one.H0, one.H1, one.step, 1.0, true});
  EXPECT_NEAR(of_arc - of_chord, 0.125 * (1.0 - std::cos(0.2)), 1e-8);
  EXPECT_EQ(push({.H0 = one.H0, .H1 = one.H1, .step = one.step}), of_chord);
  EXPECT_EQ(push({.H0 = one.H0, .H1 = one.H1, .step = one.step, .is_arc = true}), of_arc);
}

/// An obstacle of which only point and field are told lies at the end of the point's chord. On a plane the row tells
/// the gap at the start of the chord, whatever its length.
TEST(PushObstacle, TakesAnObstacleForTheEndOfItsChord) {
  Random random(8);
  Meeting one(random, 3e-3, 1.0);
  const Vector3 displacement = one.H1 * one.p - one.H0 * one.p;
  ASSERT_GT(std::fabs(one.field.normal.dot(displacement)), 1e-5);
  Obstacle at_end;
  at_end.near = one.obstacle.near;
  at_end.sample = one.field.sample(one.H1 * one.p);
  one.obstacle = at_end;
  ASSERT_TRUE(one.push<SampleDirection>(false));
  EXPECT_NEAR(one.gain(), (kMargin - 3e-3) / one.field.steepness, 1e-8);
}

/// No row: there is no room, the obstacle lies where the field is not known, or its gradient has no direction.
TEST(PushObstacle, RefusesWhatCannotBecomeARow) {
  const double nan = std::nan("");
  struct Case {
    const char* what;
    std::function<void(Meeting&)> change;
    bool pushes;
  };
  const Case cases[] = {
      {"nothing is wrong", [](Meeting&) {}, true},
      {"room for one row", [](Meeting& m) { m.rows->count = ContactRows::kCapacity - 1; }, true},
      {"no room", [](Meeting& m) { m.rows->count = ContactRows::kCapacity; }, false},
      {"not known", [](Meeting& m) { m.obstacle.sample.known = false; }, false},
      {"steep enough", [](Meeting& m) { m.obstacle.sample.gradient = 1.01 * kFlat * Vector3::UnitX(); }, true},
      {"flat", [](Meeting& m) { m.obstacle.sample.gradient = 0.99 * kFlat * Vector3::UnitX(); }, false},
      {"no gradient", [](Meeting& m) { m.obstacle.sample.gradient = Vector3::Zero(); }, false},
      {"not a number", [nan](Meeting& m) { m.obstacle.sample.gradient.x() = nan; }, false},
  };
  Random random(5);
  for (const Case& c : cases) {
    for (const bool is_arc : {false, true}) {
      Meeting sample(random, 1e-4, 0.5), feature(random, 1e-4, 0.5);
      c.change(sample);
      c.change(feature);
      const std::uint32_t before = sample.rows->count;
      EXPECT_EQ(sample.push<SampleDirection>(is_arc), c.pushes) << c.what;
      EXPECT_EQ(feature.push<FeatureDirection>(is_arc), c.pushes) << c.what;
      EXPECT_EQ(sample.rows->count, before + (c.pushes ? 1 : 0)) << c.what;
      EXPECT_EQ(feature.rows->count, before + (c.pushes ? 1 : 0)) << c.what;
    }
  }
}

/// The bound is a quarter of what the tried share of the motion changes: |s v - a|^2 - |a|^2 for a motion v and an aim
/// a. A motion that does not lead nearer has no bound.
TEST(MostArcGain, IsAQuarterOfTheGainOfTheShare) {
  Random random(6);
  int bounded = 0, free = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Vector3 v = random.in_cube(1.0), aim = random.in_cube(1.0);
    const double share = trial % 5 == 0 ? 1.0 : random.between(0.01, 1.0);
    const double whole = (v - aim).squaredNorm() - aim.squaredNorm();
    const double gain = (share * v - aim).squaredNorm() - aim.squaredNorm();
    const double most = most_arc_gain(whole, v.squaredNorm(), share);
    if (std::fabs(gain) < 1e-12) continue;
    if (gain < 0.0) {
      EXPECT_NEAR(most, 0.25 * gain, 1e-12);
    } else {
      EXPECT_EQ(most, std::numeric_limits<double>::infinity());
    }
    ++(gain < 0.0 ? bounded : free);
  }
  EXPECT_GT(bounded, 200);
  EXPECT_GT(free, 200);
  EXPECT_EQ(most_arc_gain(0.0, 1.0, 1.0), std::numeric_limits<double>::infinity());
}

/// By hand, with a margin of 20 um: from a gap of 10 um the gap law regains 3 um, so the most is 13 um.
TEST(ExpectedDistance, LeadsToTheMarginOrByTheGapLawTowardsIt) {
  const ContactLengths lengths = lengths_of();
  struct Case {
    double start, increase, expected;  // [um]
  };
  for (const Case& c : {
           Case{100.0, 50.0, 20.0},    // another face: to the margin
           Case{100.0, -50.0, 20.0},   //
           Case{100.0, -80.0, 20.0},   // to the margin
           Case{100.0, -95.0, 20.0},   // never below it
           Case{20.0, 0.0, 20.0},      //
           Case{20.0, -5.0, 20.0},     //
           Case{20.0, 5.0, 20.0},      //
           Case{10.0, 0.0, 10.0},      //
           Case{10.0, 2.0, 12.0},      // the row's own motion
           Case{10.0, 3.0, 13.0},      //
           Case{10.0, 4.0, 13.0},      // no more than the gap law demands
           Case{10.0, -1.0, 10.0},     // no gap below the margin shrinks
           Case{-30.0, 100.0, -15.0},  // from the inside: 0.3 of 50 um
       }) {
    EXPECT_NEAR(expected_distance(lengths, 1e-6 * c.start, 1e-6 * c.increase), 1e-6 * c.expected, 1e-15)
        << c.start << ' ' << c.increase;
  }
}

}  // namespace
}  // namespace godobject::detail::second_look_test
