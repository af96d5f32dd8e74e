#include "toolchain/page/thinning.h"

#include <algorithm>

namespace godobject::page {

std::vector<double> Thinning::select(std::span<const double> numbers) const {
  std::vector<double> selected;
  selected.reserve(samples());
  for (std::size_t i = 0; i < samples(); ++i) selected.push_back(numbers[cycle(i)]);
  return selected;
}

std::vector<double> Thinning::extremes(std::span<const double> numbers) const {
  std::vector<double> pairs;
  pairs.reserve(2 * samples());
  for (std::size_t i = 0; i < samples(); ++i) {
    const auto bucket = numbers.subspan(cycle(i), std::min(bucket_, cycles_ - cycle(i)));
    const auto [low, high] = std::minmax_element(bucket.begin(), bucket.end());
    pairs.push_back(low < high ? *low : *high);
    pairs.push_back(low < high ? *high : *low);
  }
  return pairs;
}

}  // namespace godobject::page
