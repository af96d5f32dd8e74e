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

/// Zeros where there is nothing. Sorts its copy: O(n log n).
Distribution distribution(std::vector<double> values);

/// Measurements of the same cycles, pass after pass [ns].
class PassSamples {
 public:
  explicit PassSamples(std::size_t cycles) : cycles_(cycles) {}

  void reserve_passes(std::size_t passes) { values_.reserve(passes * cycles_); }
  /// In the order of the cycles, `cycles` of them a pass.
  void push(double value) { values_.push_back(value); }

  std::size_t passes() const { return cycles_ == 0 ? 0 : values_.size() / cycles_; }

  /// Of the cycles whose numbers are given, all passes together.
  Distribution all(std::span<const std::size_t> cycles) const;

  /// Of each cycle the least of all passes: what it takes when nobody interrupts it.
  Distribution least(std::span<const std::size_t> cycles) const;

 private:
  std::size_t cycles_;
  std::vector<double> values_;
};

}  // namespace godobject::bench
