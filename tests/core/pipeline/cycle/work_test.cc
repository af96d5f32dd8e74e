#include "core/pipeline/cycle/work.h"

#include <cstdint>

#include <gtest/gtest.h>

#include "core/pipeline/contact/work_share.h"

namespace godobject::test::work_test {
namespace {

TEST(WorkMeter, SumsTheCostsOfItsPieces) {
  WorkMeter work;
  work.start(1000000);
  EXPECT_EQ(work.spent(), 0u);
  work.add(Work::kPoint, 7);
  work.add(Work::kBall);
  work.add(Work::kPoint, 2);
  EXPECT_EQ(work.spent(), 9 * cost_of(Work::kPoint) + cost_of(Work::kBall));
  EXPECT_EQ(work.on_trees(), 0u);
  work.add(Work::kItem, 5);
  work.add(Work::kBranches, 3);
  work.add(Work::kBlock, 7);
  EXPECT_EQ(work.on_trees(), 5 * cost_of(Work::kItem) + 3 * cost_of(Work::kBranches) + 7 * cost_of(Work::kBlock));
  EXPECT_EQ(work.spent(), 9 * cost_of(Work::kPoint) + cost_of(Work::kBall) + work.on_trees());
  work.start(1000000);
  EXPECT_EQ(work.spent(), 0u) << "a cycle starts from nothing";
  EXPECT_EQ(work.on_trees(), 0u);
}

TEST(WorkMeter, IsSpentFromItsBudgetOn) {
  const std::uint64_t ball = cost_of(Work::kBall);
  WorkMeter work;
  work.start(3 * ball);
  work.add(Work::kBall, 2);
  EXPECT_FALSE(work.is_spent());
  EXPECT_TRUE(work.has(ball));
  EXPECT_FALSE(work.has(ball + 1));
  work.add(Work::kBall);
  EXPECT_TRUE(work.is_spent());
  EXPECT_FALSE(work.has(0));
  work.add(Work::kBall);
  EXPECT_TRUE(work.is_spent()) << "beyond its budget, too";
  EXPECT_FALSE(work.has(0));
}

TEST(WorkMeter, KeepsWhatIsSetAside) {
  const std::uint64_t ball = cost_of(Work::kBall);
  WorkMeter work;
  work.start(4 * ball);
  work.set_aside(2 * ball);
  work.add(Work::kBall);
  EXPECT_TRUE(work.has(ball));
  EXPECT_FALSE(work.has(ball + 1));
  work.add(Work::kBall);
  EXPECT_TRUE(work.is_spent());
  work.set_aside(0);
  EXPECT_FALSE(work.is_spent());
  work.set_aside(ball);
  work.start(4 * ball);
  EXPECT_EQ(work.aside(), 0u) << "a new cycle sets nothing aside";
}

TEST(WorkMeter, HasNoLimitAtFirst) {
  WorkMeter work;
  work.add(Work::kSmoothed, 1u << 31);
  EXPECT_FALSE(work.is_spent());
  EXPECT_TRUE(work.has(1u << 31));
}

WorkMeter spent_on(Work kind, std::uint32_t pieces) {
  WorkMeter work;
  work.start(1000000);
  work.add(kind, pieces);
  return work;
}

TEST(WorkShare, ShortensTheRadiusFirstAndThenTheMotion) {
  WorkShare share;
  EXPECT_EQ(share.radius(), 1.0);
  EXPECT_EQ(share.motion(), 1.0);
  const WorkMeter of_balls = spent_on(Work::kBall, 1000);
  for (int halving = 1; halving <= 6; ++halving) {
    EXPECT_FALSE(share.is_least());
    share.learn(of_balls, 0);
    EXPECT_EQ(share.radius(), 1.0 / (1 << halving));
    EXPECT_EQ(share.motion(), 1.0);
  }
  EXPECT_TRUE(share.is_least());
  share.learn(of_balls, 0);
  EXPECT_EQ(share.radius(), 1.0 / 64.0);
  EXPECT_EQ(share.motion(), 0.5);
  for (int k = 0; k < 40; ++k) share.learn(of_balls, 0);
  EXPECT_EQ(share.radius(), 1.0 / 64.0);
  EXPECT_EQ(share.motion(), 1e-9);
}

/// A cycle that spends most of its work on the trees is no reason for a smaller share.
TEST(WorkShare, KeepsAllIfTheTreesTakeMostOfTheWork) {
  for (const Work kind : {Work::kBlock, Work::kItem, Work::kBranches}) {
    WorkShare share;
    for (int k = 0; k < 10; ++k) share.learn(spent_on(kind, 1000), 0);
    EXPECT_EQ(share.radius(), 1.0);
    EXPECT_EQ(share.motion(), 1.0);
  }
}

TEST(WorkShare, ShortensASearchThatTakesMoreThanACycleDownToAnEighth) {
  WorkShare share;
  for (const double radius : {0.5, 0.25, 0.125, 0.125}) {
    share.shorten_search();
    EXPECT_EQ(share.radius(), radius);
    EXPECT_EQ(share.motion(), 1.0);
    EXPECT_FALSE(share.is_least());
  }
  for (int k = 0; k < 3; ++k) share.learn(spent_on(Work::kBall, 1000), 0);
  ASSERT_EQ(share.radius(), 1.0 / 64.0);
  share.shorten_search();
  EXPECT_EQ(share.radius(), 1.0 / 64.0) << "it lengthens nothing";
}

/// Where the search goes on, only a shorter motion helps. Once the share of the motion is a sixty-fourth or less, the
/// solver leaves friction out.
TEST(WorkShare, ShortensTheMotionAloneIfThePointsAreKnown) {
  WorkShare share;
  for (int halving = 1; halving <= 40; ++halving) {
    share.shorten_motion();
    EXPECT_EQ(share.radius(), 1.0);
    EXPECT_EQ(share.motion(), std::max(1e-9, std::pow(0.5, halving)));
    EXPECT_EQ(share.is_least(), halving >= 6) << halving;
  }
  int cycles = 0;
  while (share.motion() < 1.0) {
    EXPECT_EQ(share.is_least(), share.motion() < 1.0 / 32.0);
    cycles % 2 == 0 ? share.learn(spent_on(Work::kPoint, 12000), 900000) : share.lengthen_motion();
    ASSERT_LT(++cycles, 80);
  }
  EXPECT_FALSE(share.is_least());
}

/// Any motion that was certified may be longer the next time; the radius grows while it takes less than half.
TEST(WorkShare, GrowsWhileTheFirstSubstepEnds) {
  const WorkMeter of_points = spent_on(Work::kPoint, 8000);
  WorkShare share;
  for (int k = 0; k < 40; ++k) share.learn(of_points, 0);
  share.learn(of_points, 500000);
  EXPECT_EQ(share.radius(), 1.0 / 64.0) << "it takes half";
  EXPECT_DOUBLE_EQ(share.motion(), 1.5e-9);
  share.learn(of_points, 499999);
  EXPECT_EQ(share.radius(), 1.125 / 64.0);
  EXPECT_DOUBLE_EQ(share.motion(), 1.5 * 1.5e-9);
  int cycles = 0;
  while (share.radius() < 1.0 || share.motion() < 1.0) {
    EXPECT_EQ(share.is_least(), std::min(share.radius(), share.motion()) < 1.0 / 32.0);
    share.learn(of_points, 1);
    ASSERT_LT(++cycles, 80);
  }
  EXPECT_FALSE(share.is_least());
}

TEST(WorkShare, IsWholeAsSoonAsThereIsNoBudget) {
  WorkShare share;
  for (int k = 0; k < 10; ++k) share.learn(spent_on(Work::kBall, 1000), 0);
  share.learn(WorkMeter{}, 1);
  EXPECT_EQ(share.radius(), 1.0);
  EXPECT_EQ(share.motion(), 1.0);
  EXPECT_FALSE(share.is_least());
}

}  // namespace
}  // namespace godobject::test::work_test
