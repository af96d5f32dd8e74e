#include "toolchain/statistics/samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace godobject {

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  // 1e-9: the product of a share such as 0.07 and n must not be rounded up to the next rank
  const double rank = std::ceil(share * static_cast<double>(values.size()) - 1e-9);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

std::size_t count_above(std::span<const double> values, double limit) {
  return static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [limit](double value) { return value > limit; }));
}

std::size_t longest_above(std::span<const double> values, double limit) {
  std::size_t longest = 0;
  std::size_t run = 0;
  for (const double value : values) {
    run = value > limit ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest;
}

}  // namespace godobject
