#pragma once

#include <algorithm>

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/contact_limits.h"

namespace godobject::detail {

/// The share of a sub-step's motion that is tried, attempt after attempt, until one is certified free.
class MotionShare {
 public:
  explicit MotionShare(double first) noexcept : value_(first) {}

  double value() const noexcept { return value_; }
  bool is_whole() const noexcept { return value_ == 1.0; }
  /// Shortened because of an obstacle, not because the motion would overshoot.
  bool is_cut() const noexcept { return value_ < 1.0 && !overshoots_; }
  int looks_left() const noexcept { return looks_; }
  /// While second looks are left a gap may not shrink below the wanted margin; then the least margin is the limit.
  double least_gap(const ContactLengths& lengths) const noexcept {
    return looks_ > 0 ? lengths.wanted_margin : lengths.least_margin;
  }

  /// Counts an attempt; false once all are used up.
  bool next() noexcept { return attempt_++ < kMostAttempts; }

  /// Nothing of the motion is taken.
  void give_up() noexcept { value_ = 0.0; }
  /// The motion ends at the bottom of a valley.
  void stop_at(double share) noexcept {
    value_ = share;
    overshoots_ = true;
  }
  /// The points that were left out of the search do not allow so much.
  void halve() noexcept { shrink(0.5); }
  /// No surface was met up to this share of a chord, but nothing is known beyond it.
  void shrink_to(double share_of_chord) noexcept { shrink(is_early() ? share_of_chord : std::min(share_of_chord, 0.25)); }
  /// An obstacle cannot become a row.
  void shrink_at_obstacle() noexcept {
    looks_ = 0;
    shrink(is_early() ? 0.5 : 0.25);
  }
  /// An obstacle became a row, and the motion was computed anew; `first`: the share of it to begin with.
  void look_again(double first) noexcept {
    --looks_;
    overshoots_ = false;
    value_ = first;
  }

 private:
  /// The first attempts shorten carefully, later ones end the search for a share soon.
  bool is_early() const noexcept { return attempt_ <= kMostSecondLooks; }
  void shrink(double factor) noexcept {
    overshoots_ = false;
    value_ *= factor;
  }

  double value_;
  int attempt_ = 0;
  int looks_ = kMostSecondLooks;
  bool overshoots_ = false;
};

}  // namespace godobject::detail
