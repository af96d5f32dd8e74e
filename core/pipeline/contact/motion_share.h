#pragma once

#include <algorithm>

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/contact_limits.h"

namespace godobject::detail {

/// The share of a sub-step's motion that the next attempt tries. The attempts end when one is certified free.
class MotionShare {
 public:
  explicit MotionShare(double first) noexcept : value_(first) {}

  double value() const noexcept { return value_; }
  bool is_whole() const noexcept { return value_ == 1.0; }
  /// Tells whether the motion was shortened because of an obstacle, not only because it would overshoot.
  bool is_cut() const noexcept { return value_ < 1.0 && !overshoots_; }
  /// Tells whether the motion ends at the lowest energy along its way.
  bool is_stopped() const noexcept { return stopped_; }
  int looks_left() const noexcept { return looks_; }
  /// Returns the gap below which no gap may shrink [m]: the wanted margin while second looks remain, then the least
  /// margin.
  double least_gap(const ContactLengths& lengths) const noexcept {
    return looks_ > 0 ? lengths.wanted_margin : lengths.least_margin;
  }

  /// Counts an attempt. False: all are used up.
  bool next() noexcept { return attempt_++ < kMostAttempts; }
  /// Tells whether another attempt may follow.
  bool has_next() const noexcept { return attempt_ < kMostAttempts; }
  /// Allows no second look.
  void forgo_looks() noexcept { looks_ = 0; }

  /// Sets the share to 0: the god object stays.
  void give_up() noexcept {
    value_ = 0.0;
    stopped_ = overshoots_ = false;
  }
  /// Sets the share at which the motion ends at the lowest energy along its way, as at the bottom of a valley.
  void stop_at(double share) noexcept {
    overshoots_ = is_whole();
    value_ = share;
    stopped_ = true;
  }
  /// Shortens the motion to at most this share.
  void limit_to(double share) noexcept {
    if (share < value_) shrink(share / value_);
  }
  /// Halves the share: points that are not near do not allow more.
  void halve() noexcept { shrink(0.5); }
  /// Shortens the motion to the share of a chord that is proved free; beyond it nothing is known.
  void shrink_to(double share_of_chord) noexcept {
    shrink(is_early() ? share_of_chord : std::min(share_of_chord, 0.25));
  }
  /// Shortens the motion at an obstacle that cannot become a row.
  void shrink_at_obstacle() noexcept {
    looks_ = 0;
    shrink(is_early() ? 0.5 : 0.25);
  }
  /// Restarts with the share `first` after near points became rows and the motion was computed again.
  void restart(double first) noexcept {
    stopped_ = overshoots_ = false;
    value_ = first;
  }
  /// The same after an obstacle became a row: a second look.
  void look_again(double first) noexcept {
    --looks_;
    restart(first);
  }

 private:
  /// Tells whether the motion is shortened carefully; later attempts shorten faster, so that the attempts suffice.
  /// Measured (godobject-replay, the demo's paths): quarters from the start change no replay, halves to the end only
  /// the peg's.
  bool is_early() const noexcept { return attempt_ <= kMostSecondLooks; }
  void shrink(double factor) noexcept {
    stopped_ = overshoots_ = false;
    value_ *= factor;
  }

  double value_;
  int attempt_ = 0;
  int looks_ = kMostSecondLooks;
  bool stopped_ = false;
  bool overshoots_ = false;  // the whole motion would have been free
};

}  // namespace godobject::detail
