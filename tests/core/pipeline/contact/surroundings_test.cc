// The selection of rows when there are more near points than rows.

#include "core/pipeline/contact/surroundings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <set>

#include "tests/support/analytic_worlds.h"

namespace godobject::test {
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
  }
}

class SelectedRows : public ::testing::Test {
 protected:
  /// The rows that the near points of the first direction get on the plane z = 0.
  const ContactRows& select() {
    workspace_->rows.count = 0;
    const detail::Selection selection = detail::select_rows(*workspace_);
    detail::push_selected<detail::SampleDirection>(AnalyticField<HalfSpace>({}, 0.002), Pose{}, selection,
                                                   ContactLengths::make({}), workspace_->samples, workspace_->rows);
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
  EXPECT_GT(chosen.size(), kRows * 3 / 4);
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
  EXPECT_GT(others, kRows / 3);
  EXPECT_LT(longest, 20u) << "a seventh of the others: there is one in any twenty points";
}

/// On a flat face all distances are equal. The rows must not all lie at its begin.
TEST_F(SelectedRows, AreSpreadOverAFlatFace) {
  constexpr std::uint32_t kCount = 5000;
  fill(workspace_->samples, kCount, [](std::uint32_t) { return 1e-5; });
  const std::set<std::uint32_t> chosen = points(select());
  EXPECT_GT(chosen.size(), kRows / 4);
  EXPECT_LT(*chosen.begin(), 10u);
  EXPECT_GT(*chosen.rbegin(), kCount - 10);
  std::uint32_t last = 0;
  for (const std::uint32_t k : chosen) {
    EXPECT_LE(k - last, 5u);
    last = k;
  }
}

TEST_F(SelectedRows, CountThePointsOfBothDirections) {
  fill(workspace_->samples, 2000, [](std::uint32_t) { return 3e-4; });
  fill(workspace_->features, 2000, [](std::uint32_t) { return 1e-5; });
  const detail::Selection selection = detail::select_rows(*workspace_);
  EXPECT_LT(selection.deepest, 1e-5) << "equal distances are taken by stride";
  EXPECT_EQ(selection.stride, 4u) << "1024 rows for 4000 points";
  workspace_->features.count = 48;
  const detail::Selection all = detail::select_rows(*workspace_);
  EXPECT_EQ(all.stride, 1u);
  EXPECT_GT(all.deepest, 1.0);
  workspace_->features.count = 49;
  EXPECT_EQ(detail::select_rows(*workspace_).stride, 3u);
}

/// The field's frame is rotated against the shell's: the rows' normals are in S.
TEST_F(SelectedRows, HaveNormalsInTheFrameOfTheBody) {
  fill(workspace_->samples, 8, [](std::uint32_t) { return 1e-5; });
  Pose H_WS;
  H_WS.rotation = Quaternion(Eigen::AngleAxisd(0.5 * M_PI, Vector3::UnitX()));  // z of W is y of S
  const detail::Selection selection = detail::select_rows(*workspace_);
  workspace_->rows.count = 0;
  detail::push_selected<detail::SampleDirection>(AnalyticField<HalfSpace>({}, 0.002), H_WS, selection,
                                                 ContactLengths::make({}), workspace_->samples, workspace_->rows);
  ASSERT_EQ(workspace_->rows.count, 8u);
  EXPECT_LT((workspace_->rows.normal(3) - Vector3::UnitY()).norm(), 1e-6);
  EXPECT_EQ(workspace_->rows.point_x[3], workspace_->samples.x[3]);
}

}  // namespace
}  // namespace godobject::test
