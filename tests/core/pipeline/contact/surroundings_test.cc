// The selection of rows when there are more near points than rows.

#include "core/pipeline/contact/surroundings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <set>

#include "tests/support/random.h"

namespace godobject::test::surroundings_test {
namespace {

constexpr std::uint32_t kRows = ContactRows::kCapacity;

/// Fills the list with points on the plane z = distance(k), 1 mm apart along x.
template <class Distance>
void fill(NearPoints& near, std::uint32_t count, const Distance& distance) {
  near.count = count;
  for (std::uint32_t k = 0; k < count; ++k) {
    near.index[k] = 10000 + k;
    near.x[k] = 1e-3f * static_cast<float>(k);
    near.y[k] = 0.5f;
    near.z[k] = static_cast<float>(distance(k));
    near.distance[k] = static_cast<double>(near.z[k]);
    near.clearance[k] = near.distance[k];
    near.gradient_x[k] = near.gradient_y[k] = 0.0f;
    near.gradient_z[k] = 1.0f;
  }
}

class SelectedRows : public ::testing::Test {
 protected:
  /// The rows that the near points of the first direction get on the plane z = 0.
  const ContactRows& select() {
    workspace_->rows.count = 0;
    const detail::Selection selection = detail::select_rows(*workspace_);
    detail::push_selected<detail::SampleDirection>(Pose{}, selection, ContactLengths::make({}), workspace_->samples,
                                                   workspace_->rows);
    return workspace_->rows;
  }
  static std::set<std::uint32_t> points(const ContactRows& rows) {
    std::set<std::uint32_t> found;
    for (std::uint32_t i = 0; i < rows.count; ++i) found.insert(rows.id[i] - 10000);
    return found;
  }

  std::unique_ptr<ContactWorkspace> workspace_ = std::make_unique<ContactWorkspace>();
};

TEST_F(SelectedRows, AreAllAsLongAsThereIsRoom) {
  fill(workspace_->samples, kRows, [](std::uint32_t k) { return 1e-5 * (k % 7); });
  const ContactRows& rows = select();
  ASSERT_EQ(rows.count, kRows);
  EXPECT_EQ(points(rows).size(), kRows);
  for (const std::uint32_t i : {0u, 63u, 64u, 1000u, kRows - 1}) {
    EXPECT_EQ(rows.id[i], 10000 + i);
    EXPECT_EQ(rows.normal(i), Vector3::UnitZ());
    EXPECT_EQ(rows.point_x[i], workspace_->samples.x[i]);
    EXPECT_EQ(rows.point_y[i], 0.5f);
    EXPECT_EQ(rows.point_z[i], workspace_->samples.z[i]);
  }
}

TEST_F(SelectedRows, AreTheDeepestAndOthersSpreadOverTheWholeList) {
  constexpr std::uint32_t kCount = 7001;
  std::vector<std::uint32_t> order(kCount);
  for (std::uint32_t k = 0; k < kCount; ++k) order[k] = k;
  std::shuffle(order.begin(), order.end(), std::mt19937(4));
  fill(workspace_->samples, kCount, [&](std::uint32_t k) { return 1e-6 * (order[k] + 1); });
  const std::set<std::uint32_t> chosen = points(select());
  ASSERT_LE(chosen.size(), kRows);
  ASSERT_LE(chosen.size(), kRows * 3 / 4) << "a quarter is left for rows that the motion needs";
  EXPECT_GT(chosen.size(), kRows * 5 / 8);
  std::uint32_t last = 0, longest = 0, others = 0;
  for (std::uint32_t k = 0; k < kCount; ++k) {
    const bool deep = order[k] < kRows / 2;
    ASSERT_TRUE(!deep || chosen.count(k)) << "the deepest points become rows, also number " << k;
    if (deep || !chosen.count(k)) continue;
    ++others;
    longest = std::max(longest, k - last);
    last = k;
  }
  longest = std::max(longest, kCount - last);
  EXPECT_GT(others, kRows / 6);
  EXPECT_LT(longest, 40u) << "a fourteenth of the others: there is one in any forty points";
}

/// On a flat face all distances are equal. The rows must not all lie at its begin.
TEST_F(SelectedRows, AreSpreadOverAFlatFace) {
  constexpr std::uint32_t kCount = 5000;
  fill(workspace_->samples, kCount, [](std::uint32_t) { return 1e-5; });
  const std::set<std::uint32_t> chosen = points(select());
  EXPECT_GT(chosen.size(), kRows / 5);
  EXPECT_LT(*chosen.begin(), 10u);
  EXPECT_GT(*chosen.rbegin(), kCount - 11);
  std::uint32_t last = 0;
  for (const std::uint32_t k : chosen) {
    EXPECT_LE(k - last, 10u);
    last = k;
  }
}

TEST_F(SelectedRows, CountThePointsOfBothDirections) {
  fill(workspace_->samples, 2000, [](std::uint32_t) { return 3e-4; });
  fill(workspace_->features, 2000, [](std::uint32_t) { return 1e-5; });
  const detail::Selection selection = detail::select_rows(*workspace_);
  EXPECT_LT(selection.deepest, 1e-5) << "equal distances are taken by stride";
  EXPECT_EQ(selection.stride, 8u) << "512 rows for 4000 points";
  workspace_->features.count = 48;
  const detail::Selection all = detail::select_rows(*workspace_);
  EXPECT_EQ(all.stride, 1u);
  EXPECT_GT(all.deepest, 1.0);
  workspace_->features.count = 49;
  EXPECT_EQ(detail::select_rows(*workspace_).stride, 5u);
}

/// A quarter of the rows are taken by stride: no more points than that, and not fewer than necessary.
TEST_F(SelectedRows, AreTakenByTheLeastStrideThatFits) {
  constexpr std::uint32_t kRoom = kRows / 4;
  for (std::uint32_t times = 5; times <= 9; ++times) {
    for (const std::uint32_t count : {times * kRoom - 1, times * kRoom, times * kRoom + 1}) {
      fill(workspace_->samples, count, [](std::uint32_t) { return 1e-5; });
      const std::uint32_t stride = detail::select_rows(*workspace_).stride;
      EXPECT_LE(count, stride * kRoom) << count;
      EXPECT_GT(count, (stride - 1) * kRoom) << count;
    }
  }
}

/// A row regains 30 % of the gap that its point has lost; a gap above the margin may shrink to it.
TEST_F(SelectedRows, RegainTheLostGapsOfTheirPoints) {
  const double margin = ContactLengths::make({}).margin;
  const double gap[] = {0.25 * margin, 0.5 * margin, margin, 3.0 * margin};
  fill(workspace_->samples, 4, [&](std::uint32_t k) { return gap[k]; });
  const ContactRows& rows = select();
  ASSERT_EQ(rows.count, 4u);
  const double gain[] = {0.225 * margin, 0.15 * margin, 0.0, -2.0 * margin};
  for (std::uint32_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(static_cast<double>(rows.required_gain[i]), gain[i], 1e-5 * margin) << i;
  }
}

/// As in the search, a gradient that is shorter than kFlat has no direction, and a longer one has.
TEST_F(SelectedRows, AreThoseOfPointsWhoseGradientHasADirection) {
  fill(workspace_->samples, 4, [](std::uint32_t) { return 1e-5; });
  const double length[] = {0.0, 0.99 * kFlat, 1.01 * kFlat, 1.9 * kFlat};
  for (std::uint32_t k = 0; k < 4; ++k) workspace_->samples.gradient_z[k] = static_cast<float>(length[k]);
  const ContactRows& rows = select();
  EXPECT_EQ(points(rows), (std::set<std::uint32_t>{2, 3}));
  for (std::uint32_t i = 0; i < rows.count; ++i) {
    EXPECT_LT((rows.normal(i) - Vector3::UnitZ()).norm(), 1e-6) << i;
  }
}

/// The field's frame is rotated against the shell's: the rows' normals are in S.
TEST_F(SelectedRows, HaveNormalsInTheFrameOfTheBody) {
  fill(workspace_->samples, 8, [](std::uint32_t) { return 1e-5; });
  Pose H_WS;
  H_WS.rotation = Quaternion(Eigen::AngleAxisd(0.5 * M_PI, Vector3::UnitX()));  // z of W is y of S
  const detail::Selection selection = detail::select_rows(*workspace_);
  workspace_->rows.count = 0;
  detail::push_selected<detail::SampleDirection>(H_WS, selection, ContactLengths::make({}), workspace_->samples,
                                                 workspace_->rows);
  ASSERT_EQ(workspace_->rows.count, 8u);
  EXPECT_LT((workspace_->rows.normal(3) - Vector3::UnitY()).norm(), 1e-6);
  EXPECT_EQ(workspace_->rows.point_x[3], workspace_->samples.x[3]);
}

/// The violation of a near point's row, computed in the field's frame from two poses instead of in S from rows.
/// `H1`: the pose of the shell after a small share of the motion. Returns the violation of the whole motion [m].
double violation_of(const NearPoints& near, std::uint32_t k, const Pose& H0, const Pose& H1, double share,
                    const GapLaw& law) {
  const Vector3 moved = (H1 * near.point(k) - H0 * near.point(k)) / share;
  const double steepness = near.gradient(k).norm();
  return law.required_gain((law.margin - near.distance[k]) / steepness) - near.gradient(k).dot(moved) / steepness;
}

/// Near points with any gradients on both sides of the margin.
void fill_at_random(NearPoints& near, std::uint32_t count, double margin, Random& random) {
  near.count = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    SampleBatch batch;
    const Vector3 p = random.in_cube(0.05);
    const Vector3 gradient = random.direction() * random.between(0.3, 1.7);
    batch.x[0] = static_cast<float>(p.x());
    batch.y[0] = static_cast<float>(p.y());
    batch.z[0] = static_cast<float>(p.z());
    batch.gradient_x[0] = gradient.x();
    batch.gradient_y[0] = gradient.y();
    batch.gradient_z[0] = gradient.z();
    batch.distance[0] = margin + random.between(k % 100 == 0 ? -0.2 : 0.0, 1.0) * 1e-3;
    batch.clearance[0] = 0.0;
    batch.known = 1;
    const std::uint32_t number = 100 + k;
    near.push(&number, batch, 1);
  }
  near.pad();
}

/// Of each 64 neighbours the one that the motion violates most becomes a row, and no other. In the second direction the
/// shell rests and the field moves.
template <class Direction>
void expect_worst_of_each_group(std::uint32_t seed) {
  Random random(seed);
  const ContactLengths lengths = ContactLengths::make({});
  const auto workspace = std::make_unique<ContactWorkspace>();
  int pushed = 0, quiet = 0;
  for (int round = 0; round < 60; ++round) {
    const auto count = static_cast<std::uint32_t>(random.integer(1, 400));
    NearPoints& near = workspace->samples;
    fill_at_random(near, count, lengths.margin, random);
    Pose H0;
    H0.rotation = exp_rotation(random.in_cube(2.0));
    H0.translation = random.in_cube(0.1);
    ConstrainedStep step;
    const double size = random.between(0.0, 1.0);
    step.motion = {random.in_cube(2e-4 * size), random.in_cube(4e-3 * size)};
    step.infeasible = round % 4 == 3;
    // to first order, whatever the rotation: a millionth of the motion
    constexpr double kShare = 1e-6;
    Pose H_moved;
    H_moved.rotation = exp_rotation(kShare * step.motion.rotation);
    H_moved.translation = kShare * step.motion.translation;
    const Pose H1 = Direction::kId == 0 ? H0 * H_moved : H_moved.inverse() * H0;
    ContactRows& rows = workspace->rows;
    rows.count = static_cast<std::uint32_t>(random.integer(0, 3));
    const std::uint32_t begin = rows.count;
    const std::uint32_t groups = detail::push_violated<Direction>(H0, step, lengths, 1.0, near, rows);
    ASSERT_EQ(rows.count - begin, groups);
    std::uint32_t row = begin;
    for (std::uint32_t first = 0; first < count; first += 64) {
      double most = -1.0;
      for (std::uint32_t k = first; k < std::min(count, first + 64); ++k) {
        GapLaw law = lengths.gap_law();
        if (step.infeasible) law.recovery = 0.0;
        most = std::max(most, violation_of(near, k, H0, H1, kShare, law));
      }
      if (most > 2.1 * lengths.metric.tolerance) {
        ASSERT_LT(row, rows.count) << "group " << first / 64;
        const std::uint32_t k = (rows.id[row] & ~detail::kFeature) - 100;
        EXPECT_EQ(rows.id[row] & detail::kFeature, Direction::kId);
        ASSERT_TRUE(k >= first && k < first + 64);
        const double here = static_cast<double>(rows.required_gain[row]) -
                            rows.normal(row).dot(step.motion.translation + step.motion.rotation.cross(rows.point(row)));
        EXPECT_NEAR(here, most, 1e-8) << "the row is that of the worst point";
        ++row;
        ++pushed;
      } else {
        ++quiet;
      }
    }
    EXPECT_EQ(row, rows.count);
  }
  EXPECT_GT(pushed, 50);
  EXPECT_GT(quiet, 5);
}

TEST(LeftOutRows, AreTheWorstOfEachGroupOfSamplePoints) { expect_worst_of_each_group<detail::SampleDirection>(7); }

TEST(LeftOutRows, AreTheWorstOfEachGroupOfFeaturePoints) { expect_worst_of_each_group<detail::FeatureDirection>(8); }

TEST(LeftOutRows, AreCountedAlsoWhenThereIsNoRoom) {
  Random random(9);
  const ContactLengths lengths = ContactLengths::make({});
  const auto workspace = std::make_unique<ContactWorkspace>();
  fill_at_random(workspace->samples, 640, lengths.margin, random);
  ConstrainedStep step;
  step.motion.translation = Vector3(1e-3, 0.0, 0.0);
  ContactRows& rows = workspace->rows;
  rows.count = ContactRows::kCapacity - 4;
  EXPECT_EQ(detail::push_violated<detail::SampleDirection>(Pose{}, step, lengths, 1.0, workspace->samples, rows), 10u);
  EXPECT_EQ(rows.count, ContactRows::kCapacity);
}

}  // namespace
}  // namespace godobject::test::surroundings_test
