#include "core/pipeline/contact/search/near_points.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/scene/field.h"
#include "core/scene/sample_bits.h"
#include "godobject/pose.h"
#include "tests/support/random.h"

namespace godobject::near_points_test {
namespace {

/// The clearances of the points are about as long as their displacements: some longer, some shorter.
TEST(NearPoints, LeaveTheirBallAsEachOneDoes) {
  test::Random random(3);
  int leaving = 0, held = 0;
  for (std::uint32_t count = 0; count < 200; ++count) {
    const Matrix3 turn = exp_rotation(0.05 * random.in_cube(1.0)).toRotationMatrix() - Matrix3::Identity();
    const Vector3 shift = 1e-3 * random.in_cube(1.0);
    const double kept = 1e-5;
    const auto near = std::make_unique<NearPoints>();
    for (std::uint32_t i = 0; i < count; ++i) {
      SampleBatch batch;
      const Vector3 p = random.in_cube(0.1);
      batch.x[0] = static_cast<float>(p.x());
      batch.y[0] = static_cast<float>(p.y());
      batch.z[0] = static_cast<float>(p.z());
      batch.distance[0] = random.between(-1e-4, 1e-3);
      batch.clearance[0] = random.between(0.0, 2.0) * (turn * p + shift).norm();
      batch.known = 0;
      const std::uint32_t number = 7 * i;
      ASSERT_EQ(near->push(&number, batch, 1), 1u);
    }
    ASSERT_EQ(near->least_distance(), count == 0 ? std::numeric_limits<double>::infinity()
                                                 : *std::min_element(near->distance, near->distance + count));
    near->pad();
    ASSERT_EQ(near->count, count);
    for (std::uint32_t first = 0; first < count; first += 64) {
      const std::uint64_t found = near->leave_their_ball(first, turn, shift, kept);
      for (std::uint32_t i = first; i < first + 64; ++i) {
        const bool leaves =
            i < count && near->distance[i] > 0.0 && (turn * near->point(i) + shift).norm() + kept > near->clearance[i];
        ASSERT_EQ((found >> (i - first) & 1) != 0, leaves) << i << " of " << count;
        (leaves ? leaving : held) += 1;
      }
    }
  }
  EXPECT_GT(leaving, 1000);
  EXPECT_GT(held, 1000);
}

/// The distances are about as large as the points' approach: some end below the gap, some above. A point whose gradient
/// is not known keeps its distance.
TEST(NearPoints, EndBelowAGapAsEachOneDoes) {
  test::Random random(6);
  int below = 0, above = 0;
  for (std::uint32_t count = 0; count < 200; ++count) {
    const Matrix3 turn = exp_rotation(0.05 * random.in_cube(1.0)).toRotationMatrix() - Matrix3::Identity();
    const Vector3 shift = 1e-3 * random.in_cube(1.0);
    const double gap = 1e-5;
    const auto near = std::make_unique<NearPoints>();
    std::vector<double> ends;
    for (std::uint32_t i = 0; i < count; ++i) {
      SampleBatch batch;
      const Vector3 p = random.in_cube(0.1);
      const Vector3 gradient = random.in_cube(1.5);
      batch.x[0] = static_cast<float>(p.x());
      batch.y[0] = static_cast<float>(p.y());
      batch.z[0] = static_cast<float>(p.z());
      batch.gradient_x[0] = gradient.x();
      batch.gradient_y[0] = gradient.y();
      batch.gradient_z[0] = gradient.z();
      batch.distance[0] = random.between(-2e-3, 4e-3);
      batch.clearance[0] = 0.0;
      batch.known = i % 5 == 0 ? 0 : 1;
      ASSERT_EQ(near->push(&i, batch, 1), 1u);
      const Vector3 seen = i % 5 == 0 ? Vector3::Zero() : Vector3(gradient.cast<float>().cast<double>());
      ASSERT_EQ(near->gradient(i), seen);
      ends.push_back(batch.distance[0] + seen.dot(turn * near->point(i) + shift));
    }
    near->pad();
    for (std::uint32_t first = 0; first < count; first += 64) {
      const std::uint64_t found = near->end_below(first, turn, shift, gap);
      for (std::uint32_t i = first; i < first + 64; ++i) {
        const bool ends_below = i < count && ends[i] < gap;
        ASSERT_EQ((found >> (i - first) & 1) != 0, ends_below) << i << " of " << count;
        (ends_below ? below : above) += 1;
      }
    }
  }
  EXPECT_GT(below, 1000);
  EXPECT_GT(above, 1000);
}

/// Elements behind the last point hold anything. They say nothing, and `pad` clears those of the last vector.
TEST(NearPoints, SayNothingOfElementsBehindTheLastPoint) {
  const Vector3 shift(1e-3, 0.0, 0.0);
  for (const std::uint32_t count : {0u, 1u, 3u, 4u, 5u, 62u, 63u, 64u, 65u, 66u, 100u, 127u, 128u, 130u, 191u}) {
    const auto near = std::make_unique<NearPoints>();
    for (std::uint32_t i = 0; i < 400; ++i) {
      near->x[i] = near->y[i] = near->z[i] = 0.5f;
      near->distance[i] = 7.0;
      near->clearance[i] = 5e-4;  // each point would leave its ball
    }
    near->count = count;
    for (std::uint32_t first = 0; first < count; first += 64) {
      const std::uint64_t expected = first_bits(std::min(count - first, 64u));
      EXPECT_EQ(near->leave_their_ball(first, Matrix3::Zero(), shift, 0.0), expected) << first << " of " << count;
    }
    for (std::uint32_t i = 0; i < count; ++i) near->distance[i] = 8.0;
    EXPECT_EQ(near->least_distance(), count == 0 ? std::numeric_limits<double>::infinity() : 8.0);
    near->pad();
    const std::uint32_t end = (count + 3) / 4 * 4;
    for (std::uint32_t i = 0; i < 400; ++i) {
      const bool padded = i >= count && i < end;
      EXPECT_EQ(near->x[i], padded ? 0.0f : 0.5f) << i << " of " << count;
      EXPECT_EQ(near->y[i], padded ? 0.0f : 0.5f) << i << " of " << count;
      EXPECT_EQ(near->z[i], padded ? 0.0f : 0.5f) << i << " of " << count;
      EXPECT_EQ(near->distance[i], padded ? 0.0 : (i < count ? 8.0 : 7.0)) << i << " of " << count;
      EXPECT_EQ(near->clearance[i], padded ? 0.0 : 5e-4) << i << " of " << count;
    }
  }
}

/// At the limits, in numbers that are exact: a ball that touches the end of chord and gap contains it, and a distance
/// of 0 is inside.
TEST(NearPoints, CountAtTheLimitAsContained) {
  struct Case {
    double shift, gap, clearance, distance;
    bool leaves;
  };
  for (const Case& c : {Case{0.25, 0.125, 0.375, 1.0, false}, Case{0.25, 0.125, 0.375 - 1e-15, 1.0, true},
                        Case{0.0, 0.125, 0.125, 1.0, false}, Case{0.0, 0.125, 0.125 - 1e-15, 1.0, true},
                        Case{0.25, 0.0, 0.125, 0.0, false}, Case{0.25, 0.0, 0.125, -1.0, false},
                        Case{0.25, 0.0, 0.125, 1e-300, true}, Case{0.25, 0.5, 0.25, 1.0, true}}) {
    const auto near = std::make_unique<NearPoints>();
    near->count = 1;
    near->distance[0] = c.distance;
    near->clearance[0] = c.clearance;
    EXPECT_EQ(near->leave_their_ball(0, Matrix3::Zero(), Vector3(0.0, c.shift, 0.0), c.gap), c.leaves ? 1u : 0u)
        << c.shift << ' ' << c.gap << ' ' << c.clearance << ' ' << c.distance;
  }
}

TEST(NearPoints, TakeTheChosenOnesAsLongAsThereIsRoom) {
  test::Random random(4);
  const auto near = std::make_unique<NearPoints>();
  std::vector<std::uint32_t> pushed;
  std::uint32_t number = 0;
  int refused = 0;
  while (refused < 3) {
    SampleBatch batch;
    std::array<std::uint32_t, SampleBatch::kCapacity> numbers;
    std::uint64_t chosen = 0;
    batch.known = 0;
    for (std::uint32_t k = 0; k < SampleBatch::kCapacity; ++k, ++number) {
      numbers[k] = number;
      batch.x[k] = static_cast<float>(number);
      batch.y[k] = static_cast<float>(number + 1);
      batch.z[k] = static_cast<float>(number + 2);
      batch.distance[k] = number + 3;
      batch.clearance[k] = number + 4;
      batch.gradient_x[k] = batch.gradient_y[k] = batch.gradient_z[k] = 0.5;
      if (random.between(0.0, 1.0) < 0.6) chosen |= std::uint64_t{1} << k;
    }
    const std::uint64_t held = near->push(numbers.data(), batch, chosen);
    ASSERT_EQ(held & ~chosen, 0u);
    std::uint64_t expected = 0;
    for_each_bit(chosen, [&](std::uint32_t k) {
      if (pushed.size() == NearPoints::kCapacity) return;
      expected |= std::uint64_t{1} << k;
      pushed.push_back(numbers[k]);
    });
    ASSERT_EQ(held, expected) << "the first points until the list is full";
    refused += held != chosen;
  }
  ASSERT_EQ(near->count, NearPoints::kCapacity);
  for (std::uint32_t i = 0; i < near->count; ++i) {
    ASSERT_EQ(near->index[i], pushed[i]);
    ASSERT_EQ(near->point(i), Vector3(pushed[i], pushed[i] + 1, pushed[i] + 2));
    ASSERT_EQ(near->distance[i], pushed[i] + 3);
    ASSERT_EQ(near->clearance[i], pushed[i] + 4);
  }
}

/// Points of which only a bound is known have it for distance and clearance, and no gradient, whatever the list held.
TEST(NearPoints, TakeBoundsAsLongAsThereIsRoom) {
  test::Random random(5);
  const auto near = std::make_unique<NearPoints>();
  for (std::uint32_t i = 0; i < NearPoints::kLength; ++i) {
    near->gradient_x[i] = near->gradient_y[i] = near->gradient_z[i] = 0.5f;
  }
  std::vector<std::uint32_t> pushed;
  std::uint32_t number = 0;
  int refused = 0;
  while (refused < 3) {
    PointBatch batch;
    std::array<std::uint32_t, PointBatch::kCapacity> numbers;
    std::uint64_t chosen = 0;
    for (std::uint32_t k = 0; k < PointBatch::kCapacity; ++k, ++number) {
      numbers[k] = number;
      batch.x[k] = static_cast<float>(number);
      batch.y[k] = static_cast<float>(number + 1);
      batch.z[k] = static_cast<float>(number + 2);
      batch.clearance[k] = static_cast<float>(number + 3);
      if (random.between(0.0, 1.0) < 0.6) chosen |= std::uint64_t{1} << k;
    }
    std::uint64_t expected = 0;
    for_each_bit(chosen, [&](std::uint32_t k) {
      if (pushed.size() == NearPoints::kMostBounded) return;
      expected |= std::uint64_t{1} << k;
      pushed.push_back(numbers[k]);
    });
    const std::uint64_t held = near->push_bounds(numbers.data(), batch, chosen);
    ASSERT_EQ(held, expected) << "the first points until the list is full";
    refused += held != chosen;
  }
  ASSERT_EQ(near->count, NearPoints::kMostBounded);
  ASSERT_EQ(near->bounded, near->count);
  for (std::uint32_t i = 0; i < near->count; ++i) {
    ASSERT_EQ(near->index[i], pushed[i]);
    ASSERT_EQ(near->point(i), Vector3(pushed[i], pushed[i] + 1, pushed[i] + 2));
    ASSERT_EQ(near->distance[i], pushed[i] + 3);
    ASSERT_EQ(near->clearance[i], pushed[i] + 3);
    ASSERT_EQ(near->gradient(i), Vector3::Zero());
    ASSERT_TRUE(near->is_bound_only(i));
  }
  EXPECT_EQ(near->gradient_x[near->count], 0.5f) << "nothing behind the last point";
}

TEST(SampleBits, SayWhatHoldsOfEachPoint) {
  test::Random random(5);
  for (std::uint32_t count = 0; count <= SampleBatch::kCapacity; ++count) {
    SampleBatch batch;
    for (std::uint32_t i = 0; i < SampleBatch::kCapacity; ++i) {
      FieldSample sample;
      sample.distance = random.between(-1e-3, 1e-3);
      sample.clearance = i % 9 == 0 ? 5e-4 : random.between(0.0, 1e-3);
      sample.gradient = random.in_cube(2e-3);
      store_sample(Vector3::Zero(), sample, batch, i);
      batch.from_distance[i] = i % 7 == 0 ? sample.distance + 1e-9 : random.between(-1e-3, 1e-3);
    }
    batch.count = count;
    const std::uint64_t below = clearance_below(batch, 5e-4);
    const std::uint64_t keeps = keeps_distance(batch, 3e-4, 1e-9);
    const std::uint64_t steep = steeper(batch, 1e-3);
    for (std::uint32_t i = 0; i < count; ++i) {
      const FieldSample sample = stored_sample(batch, i);
      EXPECT_EQ((below >> i & 1) != 0, sample.clearance < 5e-4);
      EXPECT_EQ((keeps >> i & 1) != 0,
                sample.distance > 0.0 && sample.distance + 1e-9 >= std::min(batch.from_distance[i], 3e-4));
      EXPECT_EQ((steep >> i & 1) != 0, sample.gradient.squaredNorm() > 1e-6);
    }
  }
  EXPECT_EQ(first_bits(0), 0u);
  EXPECT_EQ(first_bits(3), 7u);
  EXPECT_EQ(first_bits(64), ~std::uint64_t{0});
}

}  // namespace
}  // namespace godobject::near_points_test
