#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace godobject::page {

/// Selects cycles of a long replay: one of each bucket of consecutive cycles.
class Thinning {
 public:
  static constexpr std::size_t kMostSamples = 20000;

  explicit Thinning(std::size_t cycles) : cycles_(cycles), bucket_((cycles + kMostSamples - 1) / kMostSamples) {}

  std::size_t bucket() const { return bucket_; }  ///< cycles in a bucket; 1: nothing is left out
  std::size_t samples() const { return (cycles_ + bucket_ - 1) / bucket_; }
  std::size_t cycle(std::size_t sample) const { return sample * bucket_; }  ///< the selected cycle of a bucket

  /// Returns the numbers of the selected cycles. `numbers`: one for each cycle.
  std::vector<double> select(std::span<const double> numbers) const;

  /// Returns the smallest and the largest number of each bucket, in the order of their cycles: two a bucket.
  std::vector<double> extremes(std::span<const double> numbers) const;

 private:
  std::size_t cycles_;
  std::size_t bucket_;
};

}  // namespace godobject::page
