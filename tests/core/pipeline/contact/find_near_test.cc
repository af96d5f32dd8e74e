// The near points of both directions and their rows, compared with each point alone.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/pipeline/contact/surroundings.h"
#include "tests/support/analytic_worlds.h"
#include "tests/support/random.h"

namespace godobject::test::find_near_test {
namespace {

using detail::FeatureDirection;
using detail::SampleDirection;
using detail::Surroundings;

constexpr double kVoxel = 0.002;

/// A ball whose field has no gradient in its core, and none that is stored beyond a band.
struct HollowField {
  Ball shape{Vector3(0.01, 0.02, -0.03), 0.02};
  double flat_within = 0.005;     ///< of the centre: a gradient of zero
  double unknown_below = -0.012;  ///< distance from which on nothing is stored

  FieldSample sample(const Vector3& p) const noexcept {
    FieldSample s{shape.distance(p), 1.25 * shape.gradient(p), true, std::max(0.0, shape.distance(p))};
    if (std::fabs(s.distance - 1e-3) < 1e-4) s.gradient *= 1e-4;  // flat in a thin layer outside
    if (s.distance < unknown_below) s = {-1.0, Vector3::Zero(), false, 0.0};
    return s;
  }
  void clearances(const Pose& H, PointBatch& batch) const noexcept { sample_clearances(*this, H, batch); }
  void samples(const Pose& H, SampleBatch& batch) const noexcept { sample_each(*this, H, batch); }
  std::uint64_t free_chords(const Pose&, const Pose&, SampleBatch&) const noexcept { return 0; }
  LayerSample layer(const Vector3&) const noexcept { return {}; }
  double lower_bound(const Vector3&, double) const noexcept { return -std::numeric_limits<double>::infinity(); }
  double lipschitz() const noexcept { return 1.0; }
  double assured_clearance() const noexcept { return 1e3; }
  double voxel_size() const noexcept { return kVoxel; }
  double band() const noexcept { return 1.0; }
};

ContactLengths lengths_with(std::uint32_t budget) {
  Parameters q;
  q.voxel_size = kVoxel;
  q.margin = 1e-4;
  q.point_budget = budget;
  return ContactLengths::make(q);
}

PointBudget budget_of(const ContactLengths& lengths) { return {lengths.point_budget, lengths.margin}; }

/// The point of the body at contact, and the gradient of its distance for a motion of the body, both in S.
template <class Direction>
struct Expected;
template <>
struct Expected<SampleDirection> {
  static Vector3 point(const Pose&, const Vector3& p) { return p; }
  static Vector3 gradient(const Pose& H, const Vector3& g) { return H.rotation.conjugate() * g; }
};
template <>
struct Expected<FeatureDirection> {
  static Vector3 point(const Pose& H, const Vector3& p) { return H * p; }
  static Vector3 gradient(const Pose&, const Vector3& g) { return -g; }
};

template <class Direction>
void expect_surroundings(const Direction& direction, std::uint32_t first_id, int count, unsigned seed) {
  Random random(seed);
  const HollowField field;
  const ContactLengths lengths = lengths_with(std::numeric_limits<std::uint32_t>::max());
  int found = 0, swallowed = 0, flat = 0;
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<Vector3> points, normals;
    for (int i = 0; i < count; ++i) {
      points.push_back(random.in_cube(0.03));
      normals.push_back(Vector3::UnitX());
    }
    if (trial % 2 == 0) {  // all outside of the body
      for (Vector3& p : points) p = p.normalized() * random.between(0.0201, 0.025);
    }
    const SampledBody body({points, normals}, Vector3::Ones());
    const Pointshell shell = body.pointshell();
    Pose H;
    H.rotation = exp_rotation(random.in_cube(2.0));
    H.translation = field.shape.center + 1e-3 * random.in_cube(trial % 2 == 0 ? 0.1 : 1.0);
    NearSearch search;
    search.start({}, shell, 1.0, 0.01);
    const auto near = std::make_unique<NearPoints>();
    const auto rows = std::make_unique<ContactRows>();
    Surroundings around{.free_displacement = 0.003};
    constexpr double kRadius = 0.002;
    WorkMeter work;
    detail::find_near(search, direction, field, shell, H, 0.0, kRadius, kRadius, lengths, budget_of(lengths), work,
                      *near, *rows, around);
    std::uint32_t k = 0, row = 0;
    double smallest = std::numeric_limits<double>::infinity();
    bool is_swallowed = false;
    for (std::uint32_t i = 0; i < shell.size; ++i) {
      const FieldSample s = field.sample(H.rotation.toRotationMatrix() * shell.point(i) + H.translation);
      if (s.clearance >= kRadius) continue;
      ASSERT_LT(k, near->count);
      ASSERT_EQ(near->index[k], i);
      ASSERT_EQ(near->point(k), shell.point(i));
      ASSERT_EQ(near->distance[k], s.distance);
      ASSERT_EQ(near->clearance[k], s.clearance);
      ++k;
      smallest = std::min(smallest, s.distance);
      is_swallowed |= !s.known && s.distance < 0.0;
      if (!s.known || s.gradient.norm() <= kFlat) {
        ++flat;
        continue;
      }
      ASSERT_LT(row, rows->count);
      ASSERT_EQ(rows->id[row], first_id | i);
      ASSERT_LT((rows->point(row) - Expected<Direction>::point(H, shell.point(i))).norm(), 1e-8);
      const Vector3 gradient = Expected<Direction>::gradient(H, s.gradient);
      ASSERT_LT((rows->normal(row) - gradient.normalized()).norm(), 1e-6);
      const double gain = lengths.gap_law().required_gain((lengths.margin - s.distance) / gradient.norm());
      ASSERT_NEAR(static_cast<double>(rows->required_gain[row]), gain, 1e-6 * std::fabs(gain) + 1e-12);
      ++row;
    }
    EXPECT_EQ(near->count, k);
    EXPECT_EQ(rows->count, row);
    EXPECT_EQ(around.smallest, smallest);
    EXPECT_EQ(around.swallowed, is_swallowed);
    EXPECT_FALSE(around.lacks_rows);
    EXPECT_EQ(around.unseen, 0u);
    EXPECT_EQ(around.free_displacement, 0.003);
    found += static_cast<int>(k);
    swallowed += is_swallowed ? 1 : 0;
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(swallowed, 5);
  EXPECT_LT(swallowed, 35);
  EXPECT_GT(flat, 50);
}

TEST(FindNear, FindsTheSamplePointsAndTheirRows) { expect_surroundings(SampleDirection{}, 0, 150, 1); }

TEST(FindNear, FindsTheFeaturePointsAndTheirRows) {
  FeatureDirection direction;
  direction.sphere = {Vector3::Zero(), 0.05};
  direction.near_radius = 0.1;
  expect_surroundings(direction, detail::kFeature, 150, 2);
}

/// Points that find no place limit the motion to their clearance, and are counted; so are rows.
TEST(FindNear, CountsThePointsThatFindNoPlace) {
  const AnalyticField field(HalfSpace{}, kVoxel);
  constexpr int kPoints = static_cast<int>(NearPoints::kCapacity) + 100;
  std::vector<Vector3> points, normals;
  for (int i = 0; i < kPoints; ++i) {
    points.push_back({1e-5 * i, 0.0, i < kPoints - 1 ? 1e-3 : 5e-4});
    normals.push_back(-Vector3::UnitZ());
  }
  const SampledBody body({points, normals}, Vector3::Ones());
  const Pointshell shell = body.pointshell();
  NearSearch search;
  search.start({}, shell, 1.0, 0.01);
  for (const double depth : {0.0, 6e-4}) {
    const auto near = std::make_unique<NearPoints>();
    const auto rows = std::make_unique<ContactRows>();
    Surroundings around{.free_displacement = 0.003};
    Pose H;
    H.translation.z() = -depth;
    WorkMeter work;
    detail::find_near(search, SampleDirection{}, field, shell, H, 0.0, 0.002, 0.002, lengths_with(~0u), {}, work, *near,
                      *rows, around);
    EXPECT_EQ(near->count, NearPoints::kCapacity);
    EXPECT_EQ(rows->count, ContactRows::kCapacity);
    EXPECT_TRUE(around.lacks_rows);
    EXPECT_EQ(around.unlisted, 100u);
    EXPECT_NEAR(around.free_displacement, std::max(0.0, 5e-4 - depth), 1e-9)
        << "of the last point, which found no place";
    EXPECT_NEAR(around.smallest, 5e-4 - depth, 1e-9);
    EXPECT_EQ(around.swallowed, depth > 0.0) << "no row moves it out";
  }
}

/// Points at the heights `height(i)` above a plane, in a list that has bounds beyond the exact radius of 0.5 mm.
struct BoundedList {
  SampledBody body;
  Pointshell shell;
  std::vector<std::uint32_t> memory;
  NearSearch search;
  std::unique_ptr<NearPoints> near = std::make_unique<NearPoints>();
  std::unique_ptr<ContactRows> rows = std::make_unique<ContactRows>();
  Surroundings around{.free_displacement = 0.003};
  WorkMeter work;

  template <class Height>
  BoundedList(int count, const Height& height)
      : body(points(count, height), Vector3::Ones()), shell(body.pointshell()) {
    memory.resize(NearSearch::memory(shell));
    search.start(memory, shell, 1.0, 0.01);
    detail::find_near(search, SampleDirection{}, AnalyticField(HalfSpace{}, kVoxel), shell, Pose{}, 0.0, 0.002, 5e-4,
                      lengths_with(~0u), {}, work, *near, *rows, around);
  }

  template <class Height>
  static SurfaceSamples points(int count, const Height& height) {
    std::vector<Vector3> at;
    for (int i = 0; i < count; ++i) at.push_back({1e-4 * (i % 150), 1e-4 * (i / 150), height(i)});
    return {at, std::vector<Vector3>(at.size(), -Vector3::UnitZ())};
  }
};

TEST(FindNear, LimitsTheMotionByBoundedPointsWithoutAPlace) {
  const BoundedList at(16000, [](int i) { return i % 100 == 0 ? 3e-4 : 1e-3; });
  EXPECT_EQ(at.near->bounded, NearPoints::kMostBounded);
  EXPECT_EQ(at.near->count, NearPoints::kMostBounded + 160) << "nearer ones have a place";
  EXPECT_EQ(at.rows->count, 160u) << "bounded ones have no row";
  EXPECT_EQ(at.around.unlisted, 16000u - 160u - NearPoints::kMostBounded);
  EXPECT_FALSE(at.around.lacks_rows);
  EXPECT_LE(at.around.free_displacement, 1e-3);
  EXPECT_NEAR(at.around.free_displacement, 1e-3, 1e-5);
  EXPECT_NEAR(at.around.smallest, 3e-4, 1e-9);
}

/// Once a motion goes down by 1 mm, the bounded points that it would bring within the margin become rows, as if they
/// had been looked up exactly, and no others.
TEST(FindNear, MakesRowsOfTheBoundedPointsInTheWay) {
  const AnalyticField field(HalfSpace{}, kVoxel);
  BoundedList at(1000, [](int i) { return 6e-4 + 1e-6 * i; });
  ASSERT_EQ(at.near->bounded, 1000u);
  ASSERT_EQ(at.rows->count, 0u);
  const ContactLengths lengths = lengths_with(~0u);
  const auto look_up = [&](const Pose& H1) {
    return detail::look_up_bounded<SampleDirection>(field, Pose{}, H1, lengths, *at.near, *at.rows,
                                                    at.around.lacks_rows, at.work);
  };
  Pose down;
  down.translation.z() = -1e-3;
  ASSERT_FALSE(look_up(Pose{}));
  ASSERT_TRUE(look_up(down));
  std::uint32_t row = 0;
  for (std::uint32_t k = 0; k < at.near->count; ++k) {
    const double height = at.near->point(k).z();
    const bool in_the_way = height < 1e-3 + lengths.margin;
    if (std::fabs(height - 1e-3 - lengths.margin) < 1e-5) {  // within the rounding of bounds
      row += at.near->is_bound_only(k) ? 0u : 1u;
      continue;
    }
    ASSERT_EQ(at.near->is_bound_only(k), !in_the_way) << height;
    if (!in_the_way) continue;
    ASSERT_EQ(at.near->distance[k], field.sample(at.near->point(k)).distance);
    ASSERT_EQ(at.rows->id[row], at.near->index[k]);
    ++row;
  }
  EXPECT_EQ(at.rows->count, row);
  EXPECT_GT(row, 300u);
  EXPECT_FALSE(look_up(down)) << "only once";
}

/// Points without a look-up limit the motion to the bound of their clearance, over the stretch of the direction.
TEST(FindNear, CountsThePointsBeyondTheBudget) {
  const AnalyticField field(HalfSpace{}, kVoxel);
  std::vector<Vector3> points, normals;
  for (int i = 0; i < 30; ++i) {
    points.push_back({1e-3 * i, 0.0, 1e-3 + 1e-5 * i});
    normals.push_back(-Vector3::UnitZ());
  }
  const SampledBody body({points, normals}, Vector3::Ones());
  const Pointshell shell = body.pointshell();
  std::vector<std::uint32_t> memory(NearSearch::memory(shell));
  FeatureDirection features;
  features.sphere = {Vector3::Zero(), 0.05};
  features.near_radius = 0.1;
  const auto expect_limit = [&](const auto& direction, double stretch) {
    NearSearch search;
    search.start(memory, shell, 1.0, 0.01);
    const auto near = std::make_unique<NearPoints>();
    const auto rows = std::make_unique<ContactRows>();
    Surroundings around{.free_displacement = 0.003};
    WorkMeter work;
    detail::find_near(search, direction, field, shell, Pose{}, 0.0, 0.002, 0.002, lengths_with(10),
                      budget_of(lengths_with(10)), work, *near, *rows, around);
    EXPECT_EQ(near->count, 10u);
    EXPECT_EQ(rows->count, 10u);
    EXPECT_EQ(around.unseen, 20u);
    EXPECT_FALSE(around.lacks_rows);
    EXPECT_NEAR(around.free_displacement, 1.1e-3 / stretch, 1e-5);
    EXPECT_LE(around.free_displacement, 1.1e-3 / stretch);
    EXPECT_NEAR(around.smallest, 1e-3, 1e-9);
  };
  expect_limit(SampleDirection{}, 1.0);
  expect_limit(features, 2.0);
}

/// The rows of both directions stand in one list, and those of a second call come behind.
TEST(PushRows, AppendsBehindTheRowsThatThereAre) {
  const auto rows = std::make_unique<ContactRows>();
  SampleBatch batch;
  const std::uint32_t index[] = {7, 8, 9};
  for (std::uint32_t k = 0; k < 3; ++k) {
    batch.x[k] = batch.y[k] = batch.z[k] = static_cast<float>(k);
    store_sample(Vector3(k, k, k), {1e-5, Vector3::UnitY(), k != 1, 1e-5}, batch, k);
  }
  batch.count = 3;
  const ContactLengths lengths = lengths_with(~0u);
  EXPECT_EQ(detail::push_rows<SampleDirection>(batch, index, 0b111, Matrix3::Identity(), lengths, *rows), 0u);
  EXPECT_EQ(detail::push_rows<FeatureDirection>(batch, index, 0b100, Matrix3::Identity(), lengths, *rows), 0u);
  EXPECT_EQ(detail::push_rows<SampleDirection>(batch, index, 0b010, Matrix3::Identity(), lengths, *rows), 0u);
  ASSERT_EQ(rows->count, 3u) << "number 8 is not known";
  EXPECT_EQ(rows->id[0], 7u);
  EXPECT_EQ(rows->id[1], 9u);
  EXPECT_EQ(rows->id[2], 9u | detail::kFeature);
  EXPECT_EQ(rows->normal(1), Vector3::UnitY());
  EXPECT_EQ(rows->normal(2), -Vector3::UnitY());
  while (rows->count + 1 < ContactRows::kCapacity) rows->push(0, Vector3::UnitZ(), Vector3::Zero(), 0.0);
  EXPECT_EQ(detail::push_rows<SampleDirection>(batch, index, 0b101, Matrix3::Identity(), lengths, *rows), 1u);
  EXPECT_TRUE(rows->full());
}

}  // namespace
}  // namespace godobject::test::find_near_test
