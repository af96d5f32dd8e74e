// The certificate against dense samples of the chords: thin plates, needles, slots and balls, in both directions of the
// answer.

#include "core/pipeline/contact/certificate.h"

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include <gtest/gtest.h>

#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/scene/sample_bits.h"
#include "tests/support/analytic_worlds.h"
#include "tests/support/random.h"

namespace godobject::test::certificate_test {
namespace {

using detail::Budget;
using detail::Certificate;
using detail::chord_is_free;
using detail::Obstacle;

constexpr double kCertificateVoxel = 0.002;
constexpr double kRounding = 1e-9;

/// A straight wire about the z axis.
struct Wire {
  double radius = 5e-5;
  double distance(const Vector3& p) const noexcept { return std::hypot(p.x(), p.y()) - radius; }
  Vector3 gradient(const Vector3& p) const noexcept { return Vector3(p.x(), p.y(), 0.0).normalized(); }
};

/// A field that counts its look-ups. `proves`: the bits that the kernel for whole chords returns. The kernel expects
/// the field's values at the start of each chord.
struct CheckedField {
  AnalyticField field;
  std::uint64_t proves = 0;
  mutable int looks = 0;
  mutable int batches = 0;

  FieldSample sample(const Vector3& p) const noexcept {
    ++looks;
    return field.sample(p);
  }
  void clearances(const Pose& H, PointBatch& batch) const noexcept { field.clearances(H, batch); }
  void samples(const Pose& H, SampleBatch& batch) const noexcept {
    ++batches;
    field.samples(H, batch);
  }
  std::uint64_t free_chords(const Pose& H0, const Pose&, SampleBatch& batch) const noexcept {
    for (std::uint32_t i = 0; i < batch.count; ++i) {
      const Vector3 p(static_cast<double>(batch.x[i]), static_cast<double>(batch.y[i]),
                      static_cast<double>(batch.z[i]));
      const FieldSample start = field.sample(H0 * p);
      EXPECT_NEAR(batch.from_clearance[i], start.clearance, 1e-12);
      EXPECT_NEAR(batch.from_distance[i], start.distance, 1e-12);
    }
    return proves;
  }
  LayerSample layer(const Vector3& p) const noexcept { return field.layer(p); }
  double lower_bound(const Vector3& c, double r) const noexcept { return field.lower_bound(c, r); }
  double lipschitz() const noexcept { return field.lipschitz(); }
  double assured_clearance() const noexcept { return field.assured_clearance(); }
  double voxel_size() const noexcept { return field.voxel_size(); }
  double band() const noexcept { return field.band(); }
};

/// Returns the least distance on the chord from p0 to share p1, of 300 samples.
template <class Shape>
double least_on_chord(const Shape& shape, const Vector3& p0, const Vector3& p1, double share = 1.0) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 300; ++i) least = std::min(least, shape.distance(p0 + share * i / 300.0 * (p1 - p0)));
  return least;
}

// -- one chord

template <class Shape>
void expect_chords_as_sampled(const Shape& shape, unsigned seed) {
  Random random(seed);
  const CheckedField field{AnalyticField(shape, kCertificateVoxel)};
  int free = 0, blocked = 0, exhausted = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const double size = std::pow(10.0, random.between(-4.0, -1.5));
    const Vector3 p0 = random.in_cube(size),
                  p1 = trial % 3 == 0 ? Vector3(p0 + random.in_cube(0.1 * size)) : random.in_cube(size);
    if (shape.distance(p0) <= 0.0) continue;
    const double length = (p1 - p0).norm();
    const int balls = trial % 4 == 0 ? random.integer(0, 5) : 1000;
    WorkMeter work;
    Budget budget{work, balls};
    Obstacle obstacle;
    field.looks = 0;
    const bool is_free =
        chord_is_free(field, p0, shape.distance(p0), p1, std::max(0.0, shape.distance(p1)), budget, obstacle);
    const int looks = balls - budget.balls;
    ASSERT_EQ(looks, field.looks) << "the budget counts look-ups";
    ASSERT_LE(looks, kMostBallsOfChord);
    if (is_free) {
      ++free;
      ASSERT_GT(least_on_chord(shape, p0, p1), -1e-12) << trial;
      continue;
    }
    ASSERT_LT(least_on_chord(shape, p0, p1), length / 40.0 + (looks == balls ? 1.0 : 0.0))
        << "a chord with room is proved free";
    ASSERT_GT(least_on_chord(shape, p0, p1, obstacle.share), -1e-12) << "free up to the obstacle";
    ASSERT_GE(obstacle.share, 0.0);
    ASSERT_LT(obstacle.share, 1.0);
    if (obstacle.exhausted) {
      ++exhausted;
      ASSERT_TRUE(looks == kMostBallsOfChord || looks == balls) << trial;
      // every ball leads on: without it the share would be that of the first ball
      ASSERT_GE(obstacle.share * length, std::min(length, shape.distance(p0)) * (1.0 - 1e-12));
    } else {
      ++blocked;
      const FieldSample there = field.field.sample(p0 + obstacle.share * (p1 - p0));
      ASSERT_EQ(obstacle.sample.distance, there.distance) << "the sample is that at the obstacle";
      ASSERT_LE(obstacle.sample.distance, 0.0);
    }
  }
  EXPECT_GT(free, 100);
  EXPECT_GT(blocked + exhausted, 50);
}

TEST(ChordIsFree, IsAsDenseSamplesTellOfAPlate) { expect_chords_as_sampled(Plate{1e-4}, 1); }
TEST(ChordIsFree, IsAsDenseSamplesTellOfAWire) { expect_chords_as_sampled(Wire{}, 2); }
TEST(ChordIsFree, IsAsDenseSamplesTellOfASlot) { expect_chords_as_sampled(Slot{1e-3}, 3); }
TEST(ChordIsFree, IsAsDenseSamplesTellOfABall) { expect_chords_as_sampled(Ball{{1e-3, 0.0, 0.0}, 8e-4}, 4); }

/// Beside a plane at the height h, each ball has the radius h: a chord of length l needs l / h - 2 of them.
TEST(ChordIsFree, TakesAsManyBallsAsTheGapAsksFor) {
  const AnalyticField field(HalfSpace{}, kCertificateVoxel);
  for (const double h : {0.001, 0.002, 0.005}) {
    for (int balls = 0; balls < 8; ++balls) {
      const double length = (balls + 1.999) * h;
      WorkMeter work;
      Budget budget{work, 10};
      Obstacle obstacle;
      EXPECT_TRUE(chord_is_free(field, {0.0, 0.0, h}, h, {length, 0.0, h}, h, budget, obstacle));
      EXPECT_EQ(budget.balls, 10 - balls);
      budget.balls = balls;
      EXPECT_TRUE(chord_is_free(field, {0.0, 0.0, h}, h, {length, 0.0, h}, h, budget, obstacle)) << "just enough";
      if (balls == 0) continue;
      budget.balls = balls - 1;
      obstacle = {};
      EXPECT_FALSE(chord_is_free(field, {0.0, 0.0, h}, h, {length, 0.0, h}, h, budget, obstacle));
      EXPECT_TRUE(obstacle.exhausted);
      EXPECT_NEAR(obstacle.share, balls * h / length, 1e-12);
      EXPECT_EQ(budget.balls, 0);
    }
  }
}

TEST(ChordIsFree, TakesAtMostTheBallsOfAChord) {
  const AnalyticField field(HalfSpace{}, kCertificateVoxel);
  constexpr double kHeight = 0.001;
  for (const int more : {0, 1}) {
    const double length = (kMostBallsOfChord - 1 + 1.999 + more) * kHeight;
    WorkMeter work;
    Budget budget{work, 1000};
    Obstacle obstacle;
    EXPECT_EQ(chord_is_free(field, {0.0, 0.0, kHeight}, kHeight, {length, 0.0, kHeight}, kHeight, budget, obstacle),
              more == 0);
    EXPECT_EQ(budget.balls, 1000 - kMostBallsOfChord + 1 - more);
    EXPECT_EQ(obstacle.exhausted, more == 1);
  }
}

// -- all near points

/// The near points of random points at a pose.
std::unique_ptr<NearPoints> near_points(const AnalyticField& field, const std::vector<Vector3>& points, const Pose& H) {
  auto near = std::make_unique<NearPoints>();
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    SampleBatch batch;
    batch.count = 1;
    batch.x[0] = static_cast<float>(points[i].x());
    batch.y[0] = static_cast<float>(points[i].y());
    batch.z[0] = static_cast<float>(points[i].z());
    field.samples(H, batch);
    near->push(&i, batch, 1);
  }
  near->pad();
  return near;
}

/// The motion of one near point between two poses.
struct Chord {
  Vector3 p0, p1;
};
Chord chord_of(const NearPoints& near, std::uint32_t k, const Pose& H0, const Pose& H1) {
  return {H0 * near.point(k), H1 * near.point(k)};
}

template <class Shape>
void expect_motions_as_sampled(const Shape& shape, unsigned seed) {
  Random random(seed);
  const CheckedField field{AnalyticField(shape, kCertificateVoxel)};
  int held = 0, failed = 0, by_gap = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Vector3> points(static_cast<std::size_t>(random.integer(0, trial % 5 == 0 ? 200 : 8)));
    for (Vector3& p : points) p = random.in_cube(0.01);
    Pose H0, H1;
    H0.translation = random.in_cube(0.01);
    H0.rotation = exp_rotation(random.in_cube(2.0));
    const double step = std::pow(10.0, random.between(-4.5, -1.8));
    H1.translation = H0.translation + step * random.in_cube(1.0);
    H1.rotation = (exp_rotation(50.0 * step * random.in_cube(1.0)) * H0.rotation).normalized();
    const double least_gap = random.integer(0, 2) == 0 ? 0.0 : std::pow(10.0, random.between(-5.0, -2.0));
    const auto near = near_points(field.field, points, H0);
    WorkMeter work;
    Budget budget{work};
    Obstacle obstacle;
    const bool holds = Certificate(field, H0, H1, least_gap, kRounding, *near, budget, obstacle).holds();
    bool all_have_room = true;
    for (std::uint32_t k = 0; k < near->count; ++k) {
      if (near->distance[k] <= 0.0) continue;  // a point inside moves freely
      const auto [p0, p1] = chord_of(*near, k, H0, H1);
      const double least = least_on_chord(shape, p0, p1);
      const double end = shape.distance(p1);
      if (holds) {
        ASSERT_GT(least, -1e-12) << trial << ' ' << k;
        ASSERT_GT(end, 0.0);
        ASSERT_GE(end + kRounding + 1e-12, std::min(near->distance[k], least_gap)) << trial << ' ' << k;
      }
      all_have_room &= least > (p1 - p0).norm() / 40.0 && end > std::min(near->distance[k], least_gap);
    }
    ASSERT_TRUE(holds || !all_have_room) << "a motion with room is accepted, trial " << trial;
    (holds ? held : failed) += 1;
    if (holds) continue;
    ASSERT_LT(obstacle.near, near->count);
    ASSERT_GT(near->distance[obstacle.near], 0.0);
    const auto [p0, p1] = chord_of(*near, obstacle.near, H0, H1);
    ASSERT_GT(least_on_chord(shape, p0, p1, 0.999 * obstacle.share), -1e-12);
    if (obstacle.share == 1.0) {
      ++by_gap;
      ASSERT_LT(shape.distance(p1) + kRounding, std::min(near->distance[obstacle.near], least_gap) + 1e-12);
      ASSERT_NEAR(obstacle.sample.distance, shape.distance(p1), 1e-9);
    } else {
      ASSERT_LT(least_on_chord(shape, p0, p1), (p1 - p0).norm() / 40.0);
      if (!obstacle.exhausted) {
        ASSERT_NEAR(obstacle.sample.distance, shape.distance(p0 + obstacle.share * (p1 - p0)), 1e-9);
      }
    }
    // the same motion fails again at once, with the one point that failed
    const Obstacle first = obstacle;
    field.batches = 0;
    ASSERT_FALSE(Certificate(field, H0, H1, least_gap, kRounding, *near, budget, obstacle).holds());
    ASSERT_EQ(obstacle.near, first.near);
    ASSERT_EQ(obstacle.share, first.share);
    ASSERT_EQ(field.batches, 1);
  }
  EXPECT_GT(held, 40);
  EXPECT_GT(failed, 40);
  EXPECT_GT(by_gap, 3);
}

TEST(Certificate, HoldsAsDenseSamplesTellOfAPlate) { expect_motions_as_sampled(Plate{1e-4}, 11); }
TEST(Certificate, HoldsAsDenseSamplesTellOfAWire) { expect_motions_as_sampled(Wire{2e-3}, 12); }
TEST(Certificate, HoldsAsDenseSamplesTellOfASlot) { expect_motions_as_sampled(Slot{6e-3}, 13); }
TEST(Certificate, HoldsAsDenseSamplesTellOfABall) { expect_motions_as_sampled(Ball{{0.004, 0.0, 0.0}, 0.005}, 14); }

/// Any point may be the suspect: the answer is the same, since the others are tested, too.
TEST(Certificate, HoldsWhateverPointIsTheSuspect) {
  Random random(15);
  const CheckedField field{AnalyticField(Plate{1e-4}, kCertificateVoxel)};
  int held = 0, failed = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Vector3> points(static_cast<std::size_t>(random.integer(1, 150)));
    for (Vector3& p : points) p = random.in_cube(0.01);
    Pose H0, H1;
    H0.translation.z() = 0.011;
    // some points may pass the plate, or only one
    H1.translation.z() = H0.translation.z() - random.between(0.0005, 0.0012);
    const auto near = near_points(field.field, points, H0);
    WorkMeter work;
    Budget budget{work};
    Obstacle plain;
    const bool holds = Certificate(field, H0, H1, 0.0, kRounding, *near, budget, plain).holds();
    (holds ? held : failed) += 1;
    for (const std::uint32_t suspect : {0u, near->count / 2, near->count - 1, near->count, near->count + 63}) {
      Obstacle obstacle;
      obstacle.near = suspect;
      EXPECT_EQ(Certificate(field, H0, H1, 0.0, kRounding, *near, budget, obstacle).holds(), holds) << suspect;
      if (holds) continue;
      const auto [p0, p1] = chord_of(*near, obstacle.near, H0, H1);
      EXPECT_LT(least_on_chord(Plate{1e-4}, p0, p1), 1e-12);
      if (suspect >= near->count) continue;
      const Chord of_suspect = chord_of(*near, suspect, H0, H1);
      if (least_on_chord(Plate{1e-4}, of_suspect.p0, of_suspect.p1) < -1e-7) {
        EXPECT_EQ(obstacle.near, suspect) << "tested first";
      }
    }
  }
  EXPECT_GT(held, 20);
  EXPECT_GT(failed, 20);
}

/// One point of many crosses the surface, while all others keep their balls. It is found whichever point is the
/// suspect. `places`: of that point and of the suspect.
void expect_the_one_that_crosses(std::uint32_t count, const std::vector<std::uint32_t>& places) {
  const AnalyticField field(HalfSpace{}, kCertificateVoxel);
  const auto near = near_points(field, std::vector<Vector3>(count, Vector3(0.0, 0.0, 0.01)), Pose{});
  Pose H1;
  H1.translation.z() = -0.002;
  WorkMeter work;
  Budget budget{work};
  Obstacle none;
  EXPECT_TRUE(Certificate(field, Pose{}, H1, 1e-5, kRounding, *near, budget, none).holds());
  for (const std::uint32_t low : places) {
    near->z[low] = 1e-3f;
    near->distance[low] = near->clearance[low] = 1e-3;
    for (const std::uint32_t suspect : places) {
      Obstacle obstacle;
      obstacle.near = suspect;
      EXPECT_FALSE(Certificate(field, Pose{}, H1, 1e-5, kRounding, *near, budget, obstacle).holds())
          << low << " suspect " << suspect;
      EXPECT_EQ(obstacle.near, low) << "suspect " << suspect;
    }
    near->z[low] = 0.01f;
    near->distance[low] = near->clearance[low] = 0.01;
  }
}

TEST(Certificate, FindsTheOneThatCrossesWhateverPointIsTheSuspect) {
  expect_the_one_that_crosses(200, {0, 1, 62, 63, 64, 65, 126, 127, 128, 190, 191, 192, 199});
  expect_the_one_that_crosses(4200, {0, 63, 4031, 4032, 4095, 4096, 4097, 4159, 4160, 4199});
}

/// A budget of work never makes a motion free: where it ends the proof, nothing is known from the start on.
TEST(Certificate, ProvesNothingOnceTheBudgetIsSpent) {
  Random random(18);
  const AnalyticField field(HalfSpace{}, kCertificateVoxel);
  int free = 0, ended = 0, crossing = 0;
  for (int trial = 0; trial < 500; ++trial) {
    // all points leave their balls; in half of the trials one crosses, mostly after others
    std::vector<Vector3> points(200);
    for (Vector3& p : points) p = random.in_cube(0.0002) + Vector3(0.0, 0.0, 0.0014);
    if (trial % 2 == 0) points[static_cast<std::size_t>(random.integer(0, 199))].z() = 0.0003;
    const auto near = near_points(field, points, Pose{});
    Pose H1;
    H1.translation = Vector3(0.003, 0.0, -0.0005);
    WorkMeter unlimited;
    Budget all{unlimited};
    Obstacle obstacle;
    const bool is_free = Certificate(field, Pose{}, H1, 1e-5, kRounding, *near, all, obstacle).holds();
    WorkMeter work;
    work.start(static_cast<std::uint64_t>(random.between(1.0, 1.2 * static_cast<double>(unlimited.spent()))));
    Budget budget{work};
    Obstacle here;
    const bool is_proved = Certificate(field, Pose{}, H1, 1e-5, kRounding, *near, budget, here).holds();
    EXPECT_TRUE(is_free || !is_proved);
    crossing += is_free ? 0 : 1;
    if (is_free && !is_proved) {
      EXPECT_TRUE(work.is_spent());
      EXPECT_TRUE(here.exhausted);
      EXPECT_GE(here.share, 0.0);
      EXPECT_LT(here.share, 1.0) << "nothing is known of the end";
      ++ended;
    }
    free += is_proved ? 1 : 0;
  }
  EXPECT_EQ(crossing, 250);
  EXPECT_GT(free, 20);
  EXPECT_GT(ended, 100);
}

TEST(Certificate, LooksUpOnlyPointsThatLeaveTheirBall) {
  Random random(16);
  const CheckedField field{AnalyticField(HalfSpace{}, kCertificateVoxel)};
  std::vector<Vector3> points(200);
  for (Vector3& p : points) p = random.in_cube(0.001) + Vector3(0.0, 0.0, 0.003);
  const auto near = near_points(field.field, points, Pose{});
  Pose H1;
  H1.translation.x() = 0.0019;
  WorkMeter work;
  Budget budget{work};
  Obstacle obstacle;
  EXPECT_TRUE(Certificate(field, Pose{}, H1, 1e-5, kRounding, *near, budget, obstacle).holds());
  EXPECT_EQ(field.batches, 0);
  EXPECT_EQ(field.looks, 0);
  H1.translation.x() = 0.0039;  // beyond each ball, but within the balls of both ends of some chords
  EXPECT_TRUE(Certificate(field, Pose{}, H1, 1e-5, kRounding, *near, budget, obstacle).holds());
  EXPECT_GE(field.batches, 2);
  EXPECT_LE(field.batches, 4) << "64 points a batch";
}

/// Beside a plane at the height h each chord of length 4.999 h takes three free balls beside those of its ends. Each
/// is proved once, also that of the suspect.
TEST(Certificate, ProvesEachChordOnceWhateverPointIsTheSuspect) {
  constexpr std::uint32_t kPoints = 150;
  constexpr double kHeight = 0.001;
  const AnalyticField field(HalfSpace{}, kCertificateVoxel);
  const auto near = near_points(field, std::vector<Vector3>(kPoints, Vector3(0.0, 0.0, kHeight)), Pose{});
  Pose H1;
  H1.translation.x() = 4.999 * kHeight;
  for (const std::uint32_t suspect : {0u, 1u, 63u, 64u, 65u, 127u, 128u, kPoints - 1, kPoints, Obstacle::kNone}) {
    WorkMeter work;
    Budget budget{work, 1000};
    Obstacle obstacle;
    obstacle.near = suspect;
    EXPECT_TRUE(Certificate(field, Pose{}, H1, 1e-5, kRounding, *near, budget, obstacle).holds()) << suspect;
    EXPECT_EQ(1000 - budget.balls, 3 * static_cast<int>(kPoints)) << suspect;
  }
}

/// Vectors compare what stands behind the last chord, too. Whatever the memory contained before, these are numbers: a
/// comparison with NaN would raise the exception that tells errors of a cycle.
TEST(Certificate, ComparesNumbersAlsoBehindTheLastChord) {
  using OfPlane = Certificate<AnalyticField>;
  const AnalyticField field(HalfSpace{}, kCertificateVoxel);
  const Pose H0;
  Pose H1;
  H1.translation.x() = 0.003;  // three times the clearance
  alignas(OfPlane) std::byte memory[sizeof(OfPlane)];
  for (std::uint32_t count = 1; count <= 2 * SampleBatch::kAtOnce + 1; ++count) {
    const auto near = near_points(field, std::vector<Vector3>(count, Vector3(0.0, 0.0, 0.001)), H0);
    WorkMeter work;
    Budget budget{work};
    Obstacle obstacle;
    for (std::size_t i = 0; i < sizeof memory; ++i) *static_cast<volatile std::byte*>(memory + i) = std::byte{0xFF};
    auto* const certificate = new (memory) OfPlane(field, H0, H1, 1e-5, kRounding, *near, budget, obstacle);
    std::feclearexcept(FE_ALL_EXCEPT);
    EXPECT_TRUE(certificate->holds()) << count;
    EXPECT_EQ(std::fetestexcept(FE_INVALID), 0) << count;
    std::destroy_at(certificate);
  }
}

/// A chord that the field's kernel proves free needs no ball; but the gap at its end counts all the same.
TEST(Certificate, TakesTheKernelsWordForChordsAndLooksAtTheGapItself) {
  CheckedField field{AnalyticField(HalfSpace{}, kCertificateVoxel)};
  const std::vector<Vector3> points = {{0.0, 0.0, 1e-4}};
  const auto near = near_points(field.field, points, Pose{});
  Pose along, down;
  along.translation.x() = 0.004;  // some forty balls
  down.translation = Vector3(0.004, 0.0, -5e-5);
  WorkMeter work;
  Budget budget{work};
  Obstacle obstacle;
  EXPECT_TRUE(Certificate(field, Pose{}, along, 1e-5, kRounding, *near, budget, obstacle).holds());
  EXPECT_GT(field.looks, 30);
  field.looks = 0;
  field.proves = ~std::uint64_t{0};
  EXPECT_TRUE(Certificate(field, Pose{}, along, 1e-5, kRounding, *near, budget, obstacle).holds());
  EXPECT_EQ(field.looks, 0);
  EXPECT_TRUE(Certificate(field, Pose{}, down, 4.9e-5, kRounding, *near, budget, obstacle).holds());
  EXPECT_EQ(field.looks, 0);
  EXPECT_FALSE(Certificate(field, Pose{}, down, 5.1e-5, kRounding, *near, budget, obstacle).holds());
  EXPECT_EQ(obstacle.near, 0u);
  EXPECT_EQ(obstacle.share, 1.0);
  EXPECT_NEAR(obstacle.sample.distance, 5e-5, 1e-9);
}

TEST(MotionIsFree, IsTrueWithoutNearPointsAndForgetsThatLookUpsWereUsedUp) {
  const AnalyticField field(HalfSpace{}, kCertificateVoxel);
  const ContactLengths lengths = ContactLengths::make({});
  const auto near = std::make_unique<NearPoints>();
  Pose H1;
  H1.translation.z() = -1.0;
  WorkMeter work;
  Budget budget{work};
  Obstacle obstacle;
  obstacle.exhausted = true;
  EXPECT_TRUE(detail::motion_is_free(field, Pose{}, H1, 1e-5, lengths, *near, budget, obstacle));
  EXPECT_FALSE(obstacle.exhausted);
  const auto one = near_points(field, {{0.0, 0.0, 0.5}}, Pose{});
  obstacle.exhausted = true;
  EXPECT_FALSE(detail::motion_is_free(field, Pose{}, H1, 1e-5, lengths, *one, budget, obstacle));
  EXPECT_FALSE(obstacle.exhausted);
  EXPECT_EQ(obstacle.near, 0u);
  // a gap that shrinks by no more than the rounding of stored distances is kept
  H1.translation.z() = -0.5 + 1e-5 - 0.5 * lengths.rounding;
  EXPECT_TRUE(detail::motion_is_free(field, Pose{}, H1, 1e-5, lengths, *one, budget, obstacle));
  H1.translation.z() = -0.5 + 1e-5 - 2.0 * lengths.rounding;
  EXPECT_FALSE(detail::motion_is_free(field, Pose{}, H1, 1e-5, lengths, *one, budget, obstacle));
}

}  // namespace
}  // namespace godobject::test::certificate_test
