#include "toolchain/statistics/samples.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace godobject::test::samples_test {
namespace {

TEST(Percentile, IsTheNearestRank) {
  const std::vector<double> values = {50, 15, 40, 20, 35};
  EXPECT_EQ(percentile(values, 0.0), 15);
  EXPECT_EQ(percentile(values, 0.05), 15);
  EXPECT_EQ(percentile(values, 0.30), 20);  // ceil(1.5) = 2nd
  EXPECT_EQ(percentile(values, 0.40), 20);  // exactly the 2nd
  EXPECT_EQ(percentile(values, 0.50), 35);
  EXPECT_EQ(percentile(values, 0.99), 50);
  EXPECT_EQ(percentile(values, 1.00), 50);
}

TEST(Percentile, OfAHundredIsThatRankInSpiteOfRounding) {
  std::vector<double> values(100);
  std::iota(values.begin(), values.end(), 1.0);
  for (int share = 1; share <= 100; ++share) EXPECT_EQ(percentile(values, share / 100.0), share);
}

TEST(Percentile, OfOneIsItselfAndOfNoneIsNaN) {
  for (const double share : {0.0, 0.01, 0.99}) EXPECT_EQ(percentile({7.0}, share), 7.0);
  EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
}

TEST(AboveALimit, AreCountedAndTheirLongestRunToo) {
  const std::vector<double> values = {1.0, 3.0, 3.0, 2.0, 3.0, 3.0, 3.0, 1.0, 3.0};
  EXPECT_EQ(longest_above(values, 2.0), 3u);
  EXPECT_EQ(longest_above(values, 0.5), 9u);
  EXPECT_EQ(longest_above(values, 3.0), 0u);
  EXPECT_EQ(count_above(values, 2.0), 6u);
  EXPECT_EQ(count_above(values, 0.5), 9u);
  EXPECT_EQ(count_above(values, 3.0), 0u);
}

}  // namespace
}  // namespace godobject::test::samples_test
