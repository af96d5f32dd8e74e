#include "toolchain/page/thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace godobject::page {
namespace {

TEST(Thinning, KeepsAllCyclesOfAShortReplay) {
  const Thinning thinning(Thinning::kMostSamples);
  EXPECT_EQ(thinning.bucket(), 1u);
  EXPECT_EQ(thinning.samples(), Thinning::kMostSamples);
  EXPECT_EQ(thinning.cycle(17), 17u);
}

TEST(Thinning, KeepsEveryNthCycleOfALongReplay) {
  const Thinning thinning(60001);
  EXPECT_EQ(thinning.bucket(), 4u);
  EXPECT_EQ(thinning.samples(), 15001u);
  EXPECT_EQ(thinning.cycle(15000), 60000u);
}

TEST(Thinning, KeepsTheExtremesOfEachBucketInTheirOrder) {
  std::vector<double> numbers(40002, 1.0);  // buckets of three
  numbers[4] = 9.0;
  numbers[5] = -9.0;
  numbers[40001] = 7.0;  // in the last bucket
  const Thinning thinning(numbers.size());
  ASSERT_EQ(thinning.bucket(), 3u);
  const std::vector<double> pairs = thinning.extremes(numbers);
  ASSERT_EQ(pairs.size(), 2 * thinning.samples());
  EXPECT_EQ(pairs[2], 9.0);
  EXPECT_EQ(pairs[3], -9.0);
  EXPECT_EQ(pairs.back(), 7.0);
  EXPECT_EQ(std::count(pairs.begin(), pairs.end(), 1.0), static_cast<std::ptrdiff_t>(pairs.size() - 3));
  EXPECT_EQ(thinning.select(numbers)[1], 1.0);
}

TEST(Thinning, TakesAnIncompleteLastBucket) {
  std::vector<double> numbers(20001, 0.0);  // the last bucket of two has one cycle
  numbers.back() = 5.0;
  const std::vector<double> pairs = Thinning(numbers.size()).extremes(numbers);
  EXPECT_EQ(pairs.back(), 5.0);
  EXPECT_EQ(pairs[pairs.size() - 2], 5.0);
}

}  // namespace
}  // namespace godobject::page
