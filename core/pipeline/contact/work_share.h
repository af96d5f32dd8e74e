#pragma once

#include <algorithm>
#include <cstdint>

#include "core/pipeline/cycle/work.h"

namespace godobject {

/// The share of the search radius and of the motion with which the first sub-step of a cycle fits into the budget of
/// work. A search that goes on in the next cycle halves the radius, down to an eighth: a short motion in each cycle
/// keeps the god object nearer to the device than a long one in some. After a cycle that had all points from the
/// beginning and did not certify a motion, the share of the motion halves. Where a search cannot go on, the search
/// radius halves further, and once it is as short as it may be, the share of the motion. The share of the motion grows
/// again with each motion that is certified, the radius while the first sub-step takes less than half of the budget.
/// The factors are chosen: from a sixty-fourth of the radius back to the whole takes 36 cycles. Measured with the
/// eighth (godobject-replay --work-budget 308000, the demo's peg): the median of the lag is 0.08 mm in place of 0.35
/// mm.
class WorkShare {
 public:
  /// Returns the share of the longest search radius that a sub-step may use [1].
  double radius() const noexcept { return radius_; }
  /// Returns the share of a sub-step's motion that is tried [1].
  double motion() const noexcept { return motion_; }
  /// Tells whether friction and second looks are too expensive: since radius or motion fell to a sixty-fourth, until
  /// both exceed a thirty-second.
  bool is_least() const noexcept { return is_least_; }

  /// Learns from a cycle whose search goes on in the next one, and which certified no motion.
  void shorten_search() noexcept { radius_ = std::min(radius_, std::max(kLeastOfGoneOn, 0.5 * radius_)); }

  /// Learns from a cycle that began with all near points listed, and certified no motion.
  void shorten_motion() noexcept {
    motion_ = std::max(kLeastMotion, 0.5 * motion_);
    is_least_ = is_least_ || motion_ <= kLeastRadius;
  }

  /// Learns from a cycle that certified a motion, and whose search goes on in the next one.
  void lengthen_motion() noexcept {
    motion_ = std::min(1.0, kGrowthOfMotion * motion_);
    is_least_ = is_least_ && std::min(radius_, motion_) < 2.0 * kLeastRadius;
  }

  /// Learns from another cycle. `first`: work of its first sub-step; 0: the budget was spent before its end [units].
  void learn(const WorkMeter& work, std::uint64_t first) noexcept {
    if (work.budget() == WorkMeter::kUnlimited) {
      *this = WorkShare{};
    } else if (first == 0) {
      if (2 * work.on_trees() >= work.spent()) return;
      if (radius_ <= kLeastRadius) motion_ = std::max(kLeastMotion, 0.5 * motion_);
      radius_ = std::max(kLeastRadius, 0.5 * radius_);
      is_least_ = is_least_ || radius_ <= kLeastRadius;
    } else {
      if (first < work.budget() / 2) radius_ = std::min(1.0, kGrowth * radius_);
      lengthen_motion();
    }
  }

 private:
  static constexpr double kLeastRadius = 1.0 / 64.0;
  static constexpr double kLeastOfGoneOn = 1.0 / 8.0;
  static constexpr double kLeastMotion = 1e-9;
  static constexpr double kGrowth = 1.125;
  static constexpr double kGrowthOfMotion = 1.5;

  double radius_ = 1.0;
  double motion_ = 1.0;
  bool is_least_ = false;
};

}  // namespace godobject
