#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace godobject {

/// The number of points that a search may look up exactly. If more points may be near, the search takes those with the
/// smallest bounds of their clearance; among equal bounds it takes some that are spread over the shell.
struct PointBudget {
  std::uint32_t points = std::numeric_limits<std::uint32_t>::max();
  double always = 0.0;  ///< points whose bound is at most this are looked up in any case [m]
};

namespace detail {

/// The selection within a PointBudget: counts the bounds in classes by size, then takes the smallest ones.
class NearestFirst {
 public:
  /// `longest`: largest bound [m].
  NearestFirst(const PointBudget& budget, float longest) noexcept
      : points_(budget.points), always_(static_cast<float>(budget.always)), per_bound_(kSizes / longest) {}

  /// Counts a point with this bound [m].
  void count(float bound) noexcept {
    if (bound > always_) {
      ++count_[size(bound)];
    } else if (points_ > 0) {
      --points_;
    }
  }

  /// Finds the classes to take. Call it after the last `count`.
  void spread() noexcept {
    while (last_ + 1 < kSizes && count_[last_] <= points_) points_ -= count_[last_++];
    if (points_ > 0) stride_ = (count_[last_] + points_ - 1) / points_;
  }

  /// Tells whether to take the point. Call it after `spread`, once for each counted point.
  bool takes(float bound) noexcept {
    if (!(bound > always_)) return true;
    const std::uint32_t size_here = size(bound);
    return size_here < last_ || (size_here == last_ && points_ > 0 && seen_++ % stride_ == 0);
  }

 private:
  static constexpr std::uint32_t kSizes = 256;  // chosen: classes of 0.4 % of the search radius, 1 KiB of counters

  std::uint32_t size(float bound) const noexcept {
    return std::min(kSizes - 1, static_cast<std::uint32_t>(std::max(0.0f, bound * per_bound_)));
  }

  std::array<std::uint32_t, kSizes> count_{};
  std::uint32_t points_;  ///< remaining
  float always_;
  float per_bound_;
  std::uint32_t last_ = 0;  ///< the class of which only some are taken
  std::uint32_t stride_{};  ///< every stride-th of that class is taken, unless no points remain
  std::uint32_t seen_ = 0;
};

}  // namespace detail
}  // namespace godobject
