#include "toolchain/bench/distribution.h"

#include <algorithm>

#include "toolchain/statistics/samples.h"

namespace godobject::bench {

Distribution distribution(const std::vector<double>& values) {
  if (values.empty()) return {};
  return {.count = values.size(),
          .p50 = percentile(values, 0.50),
          .p99 = percentile(values, 0.99),
          .p999 = percentile(values, 0.999),
          .max = percentile(values, 1.0)};
}

Distribution PassSamples::all(std::span<const std::size_t> cycles) const {
  std::vector<double> values;
  for (std::size_t pass = 0; pass < passes(); ++pass) {
    for (const std::size_t cycle : cycles) values.push_back(values_[pass * cycles_ + cycle]);
  }
  return distribution(std::move(values));
}

Distribution PassSamples::least(std::span<const std::size_t> cycles) const {
  std::vector<double> values;
  if (passes() == 0) return {};
  for (const std::size_t cycle : cycles) {
    double least = values_[cycle];
    for (std::size_t pass = 1; pass < passes(); ++pass) least = std::min(least, values_[pass * cycles_ + cycle]);
    values.push_back(least);
  }
  return distribution(std::move(values));
}

}  // namespace godobject::bench
