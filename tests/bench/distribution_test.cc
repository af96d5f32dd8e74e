#include "toolchain/bench/distribution.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "toolchain/bench/cycle_times.h"

namespace godobject::bench {
namespace {

TEST(Distribution, OfNothingIsZero) {
  const Distribution none = distribution({});
  EXPECT_EQ(none.count, 0u);
  EXPECT_EQ(none.max, 0.0);
}

TEST(Distribution, TakesNearestRanksWhateverTheOrder) {
  std::vector<double> values(2000);  // 1 .. 2000, shuffled by a stride that is prime to 2000
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i * 777 % 2000 + 1);
  const Distribution found = distribution(values);
  EXPECT_EQ(found.count, 2000u);
  EXPECT_EQ(found.p50, 1000.0);
  EXPECT_EQ(found.p99, 1980.0);
  EXPECT_EQ(found.p999, 1998.0);
  EXPECT_EQ(found.max, 2000.0);
}

TEST(Distribution, OfOneValueIsThatValue) {
  const Distribution found = distribution({7.0});
  EXPECT_EQ(found.p50, 7.0);
  EXPECT_EQ(found.p999, 7.0);
}

TEST(PassSamples, PoolsAllPassesAndTakesTheLeastOfEachCycle) {
  PassSamples samples(3);
  for (const double value : {1.0, 20.0, 3.0, 10.0, 2.0, 30.0}) samples.push(value);
  ASSERT_EQ(samples.passes(), 2u);
  const std::vector<std::size_t> cycles = {1, 2};
  const Distribution all = samples.all(cycles);
  EXPECT_EQ(all.count, 4u);
  EXPECT_EQ(all.p50, 3.0);  // of 2, 3, 20, 30
  EXPECT_EQ(all.max, 30.0);
  const Distribution least = samples.least(cycles);
  EXPECT_EQ(least.count, 2u);
  EXPECT_EQ(least.p50, 2.0);
  EXPECT_EQ(least.max, 3.0);
}

TEST(PassSamples, LeavesOutAPassThatWasNotFinished) {
  PassSamples samples(2);
  for (const double value : {5.0, 6.0, 1.0}) samples.push(value);
  EXPECT_EQ(samples.passes(), 1u);
  const std::vector<std::size_t> cycles = {0, 1};
  EXPECT_EQ(samples.least(cycles).p50, 5.0);
}

TEST(Thinned, KeepsTheOrderAndAboutTheNumber) {
  std::vector<std::size_t> cycles(700);
  std::iota(cycles.begin(), cycles.end(), 800u);
  const std::vector<std::size_t> kept = thinned(cycles, 40);
  EXPECT_GE(kept.size(), 40u);
  EXPECT_LE(kept.size(), 45u);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_EQ(kept.front(), 800u);
  EXPECT_EQ(thinned(cycles, 10000).size(), 700u);
  EXPECT_TRUE(thinned({}, 10).empty());
}

}  // namespace
}  // namespace godobject::bench
