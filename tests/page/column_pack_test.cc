#include "toolchain/page/column_pack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/page/page_reader.h"

namespace godobject::page {
namespace {

/// Returns a column as a reader of the page sees it.
std::vector<double> read(const ColumnPack& pack, const nlohmann::json& entry) {
  const std::string header = "{}";
  std::string bytes{static_cast<char>(header.size()), '\0', '\0', '\0'};
  return PageReader(bytes + header + pack.bytes()).column(entry);
}

TEST(ColumnPack, GivesNumbersBackToHalfAStep) {
  constexpr double kStep = 1e-4;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-50.0, 50.0);
  std::vector<double> numbers{0.0, -0.0, 1e-9, -50.0, 50.0};
  while (numbers.size() < 1000) numbers.push_back(uniform(random));
  ColumnPack pack;
  const auto entry = pack.add(numbers, kStep);
  EXPECT_EQ(entry.at("step").get<double>(), kStep);
  const std::vector<double> found = read(pack, entry);
  ASSERT_EQ(found.size(), numbers.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], numbers[i], 0.5 * kStep * (1.0 + 1e-9));
}

TEST(ColumnPack, RaisesTheStepForNumbersThatNeedMoreBits) {
  const std::vector<double> numbers{1e12, -1e12, 1e12, 0.0};
  ColumnPack pack;
  const auto entry = pack.add(numbers, 1e-8);
  const double step = entry.at("step");
  EXPECT_GT(step, 1e-8);
  const std::vector<double> found = read(pack, entry);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], numbers[i], 0.51 * step);
  EXPECT_LT(step, 1e-9 * 1e12);
}

TEST(ColumnPack, GivesWholeNumbersBackExactly) {
  const std::vector<std::uint32_t> numbers{0, 4000000, 1, 2147483647, 0, 7};
  ColumnPack pack;
  const std::vector<double> found = read(pack, pack.add(numbers));
  EXPECT_EQ(found, std::vector<double>(numbers.begin(), numbers.end()));
}

TEST(ColumnPack, StoresEqualColumnsOnce) {
  ColumnPack pack;
  const std::vector<double> numbers{1.0, 2.0, 3.0};
  const auto first = pack.add(numbers, 1e-3);
  const std::size_t size = pack.bytes().size();
  EXPECT_EQ(pack.add(numbers, 1e-3), first);
  EXPECT_EQ(pack.bytes().size(), size);
  EXPECT_NE(pack.add(std::vector<double>{3.0, 2.0, 1.0}, 1e-3), first);
}

TEST(ColumnPack, StoresAColumnOfConstantNumbersAsZeros) {
  ColumnPack pack;
  const std::vector<double> numbers(100, 5.0);
  const auto entry = pack.add(numbers, 1.0);
  EXPECT_EQ(read(pack, entry), numbers);
  EXPECT_EQ(pack.bytes().find_last_not_of('\0'), 0u);  // only the first difference is not zero
}

}  // namespace
}  // namespace godobject::page
