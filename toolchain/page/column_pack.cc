#include "toolchain/page/column_pack.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace godobject::page {
namespace {

/// Returns the differences of consecutive numbers, the sign in the lowest bit, as four planes of bytes.
std::string planes_of(std::span<const std::uint32_t> numbers) {
  const std::size_t count = numbers.size();
  std::string planes(4 * count, '\0');
  std::uint32_t before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t difference = numbers[i] - before;  // modulo 2^32
    before = numbers[i];
    const std::uint32_t sign = difference >> 31 ? 0xffffffffu : 0u;
    const std::uint32_t folded = (difference << 1) ^ sign;
    for (std::size_t plane = 0; plane < 4; ++plane)
      planes[plane * count + i] = static_cast<char>((folded >> (8 * plane)) & 0xffu);
  }
  return planes;
}

}  // namespace

nlohmann::json ColumnPack::add(std::span<const double> numbers, double step) {
  constexpr double kMost = 1u << 30;
  double largest = 0.0;
  for (const double number : numbers) largest = std::max(largest, std::abs(number));
  const double used = std::max(step, largest / kMost);
  std::vector<std::uint32_t> whole;
  whole.reserve(numbers.size());
  for (const double number : numbers)
    whole.push_back(static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(number / used))));
  return store(planes_of(whole), whole.size(), used);
}

nlohmann::json ColumnPack::add(std::span<const std::uint32_t> numbers) {
  return store(planes_of(numbers), numbers.size(), 1.0);
}

nlohmann::json ColumnPack::store(const std::string& planes, std::size_t count, double step) {
  const auto [found, is_new] = offsets_.try_emplace(planes, bytes_.size());
  if (is_new) bytes_ += planes;
  return {{"offset", found->second}, {"count", count}, {"step", step}};
}

}  // namespace godobject::page
