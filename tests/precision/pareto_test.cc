// Fronts and choices calculated by hand, and against the definition on random trades.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "toolchain/precision/pareto.h"

namespace godobject::precision {
namespace {

using Front = std::vector<std::size_t>;

TEST(ParetoFront, IsThatOfHand) {
  //                                 0         1         2         3         4 beaten  5 as 1
  const std::vector<Trade> trades = {{5.0, 1.0}, {1.0, 9.0}, {3.0, 2.0}, {2.0, 4.0}, {4.0, 2.5}, {1.0, 9.0}};
  EXPECT_EQ(pareto_front(trades), (Front{1, 3, 2, 0}));
}

TEST(ParetoFront, HoldsNoneThatIsNoNumberOrEquallyGoodForMore) {
  EXPECT_EQ(pareto_front({}), Front{});
  const std::vector<Trade> trades = {{NAN, 0.0}, {1.0, NAN}, {2.0, 3.0}, {4.0, 3.0}, {2.0, 5.0}};
  EXPECT_EQ(pareto_front(trades), Front{2});
}

TEST(ParetoFront, HoldsWhatNoOtherOneBeats) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> whole(0, 12);  // many are equal
  for (int round = 0; round < 200; ++round) {
    std::vector<Trade> trades(20);
    for (Trade& trade : trades) trade = {1.0 * whole(random), 1.0 * whole(random)};
    const Front front = pareto_front(trades);
    for (std::size_t i = 0; i < trades.size(); ++i) {
      const bool beaten = std::any_of(trades.begin(), trades.end(), [&](const Trade& other) {
        return other.cost <= trades[i].cost && other.error <= trades[i].error &&
               (other.cost < trades[i].cost || other.error < trades[i].error);
      });
      const bool in_front = std::any_of(front.begin(), front.end(), [&](std::size_t f) {
        return trades[f].cost == trades[i].cost && trades[f].error == trades[i].error;
      });
      ASSERT_EQ(in_front, !beaten) << "round " << round << ", trade " << i;
    }
  }
}

TEST(BestWithin, TakesTheSmallestErrorUpToTheBudget) {
  const std::vector<Trade> trades = {{30.0, 0.1}, {20.0, 0.5}, {10.0, 0.5}, {5.0, 2.0}};
  EXPECT_EQ(best_within(trades, 30.0), 0u);
  EXPECT_EQ(best_within(trades, 29.9), 2u) << "of equal errors the cheapest";
  EXPECT_EQ(best_within(trades, 9.0), 3u);
  EXPECT_EQ(best_within(trades, 4.9), std::nullopt);
  EXPECT_EQ(best_within({}, 4.9), std::nullopt);
}

TEST(BestWithin, TakesNoErrorThatIsNoNumberWhereThereIsAnother) {
  const std::vector<Trade> trades = {{1.0, NAN}, {2.0, 7.0}, {NAN, 0.0}};
  EXPECT_EQ(best_within(trades, 10.0), 1u);
}

}  // namespace
}  // namespace godobject::precision
