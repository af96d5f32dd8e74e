#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace godobject {

/// How many points a search may look up exactly. Of more points that may be near it takes those with the smallest bounds
/// of their clearance, and where bounds are equal some that are spread over the shell.
struct PointBudget {
  std::uint32_t points = std::numeric_limits<std::uint32_t>::max();
  double always = 0.0;  ///< a point whose bound is no more than this is looked up in any case [m]
};

namespace detail {

/// Keeps a PointBudget: counts the bounds by size, then takes the smallest ones.
class NearestFirst {
 public:
  NearestFirst(const PointBudget& budget, float longest) noexcept
      : points_(budget.points), always_(static_cast<float>(budget.always)), per_bound_(kSizes / longest) {}

  void count(float bound) noexcept {
    if (bound > always_) {
      ++count_[size(bound)];
    } else if (points_ > 0) {
      --points_;
    }
  }

  /// After the last `count`.
  void spread() noexcept {
    while (last_ + 1 < kSizes && count_[last_] <= points_) points_ -= count_[last_++];
    stride_ = points_ > 0 ? (count_[last_] + points_ - 1) / points_ : std::numeric_limits<std::uint32_t>::max();
  }

  /// After `spread`, once for each point that was counted.
  bool takes(float bound) noexcept {
    if (!(bound > always_)) return true;
    const std::uint32_t size_here = size(bound);
    return size_here < last_ || (size_here == last_ && points_ > 0 && seen_++ % stride_ == 0);
  }

 private:
  static constexpr std::uint32_t kSizes = 256;

  std::uint32_t size(float bound) const noexcept {
    return std::min(kSizes - 1, static_cast<std::uint32_t>(std::max(0.0f, bound * per_bound_)));
  }

  std::array<std::uint32_t, kSizes> count_{};
  std::uint32_t points_;  ///< left
  float always_;
  float per_bound_;
  std::uint32_t last_ = 0;  ///< the size of which only some are taken
  std::uint32_t stride_ = 1;
  std::uint32_t seen_ = 0;
};

}  // namespace detail
}  // namespace godobject
