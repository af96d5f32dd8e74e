#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace godobject::bench {

/// Quantiles of single measurements, by nearest rank.
struct Distribution {
  std::size_t count = 0;
  double p50 = 0.0;
  double p99 = 0.0;
  double p999 = 0.0;
  double max = 0.0;
};

/// Returns the quantiles of the values, zeros for no value. Cost: linear in their number.
Distribution distribution(const std::vector<double>& values);

/// Measurements of the same cycles, pass after pass [ns].
class PassSamples {
 public:
  explicit PassSamples(std::size_t cycles) : cycles_(cycles) {}

  void reserve_passes(std::size_t passes) { values_.reserve(passes * cycles_); }
  /// Appends a measurement, in the order of the cycles; a pass has `cycles` of them.
  void push(double value) { values_.push_back(value); }

  std::size_t passes() const { return cycles_ == 0 ? 0 : values_.size() / cycles_; }

  /// Returns the quantiles over the cycles with these numbers, all passes together.
  Distribution all(std::span<const std::size_t> cycles) const;

  /// Returns the quantiles of the own times: the least value of each cycle over all passes, without interruptions.
  Distribution least(std::span<const std::size_t> cycles) const;

 private:
  std::size_t cycles_;
  std::vector<double> values_;
};

}  // namespace godobject::bench
