#pragma once

#include <cstdint>

#include "firmware/cycle/rate_watch.h"

namespace godobject::firmware {

/// Detects too many overruns of the loop: kInRow in a row, more than one cycle in a hundred over the last second, or
/// one longer than kLong_ns.
class OverrunWatch {
 public:
  /// Chosen, as for lost positions: the drives hold the last torque for two cycles. With 5 the arm no longer stops
  /// within the 8 cycles of the fault table, with 2 a single disturbance of two cycles stops it.
  static constexpr std::uint32_t kInRow = 3;
  /// Derived: a period longer than the default deadline of torques, 4 ms (BusLayout::command_deadline), after which the
  /// drives have stopped by themselves.
  static constexpr std::int64_t kLong_ns = 5'000'000;

  /// Takes the overrun of one cycle; 0: none. True: too often, or too long.
  bool update(std::int64_t overrun_ns) noexcept {
    const bool overrun = overrun_ns > 0;
    in_row_ = overrun ? in_row_ + 1 : 0;
    const bool too_often = rate_.update(overrun);
    return too_often || in_row_ >= kInRow || overrun_ns > kLong_ns;
  }

 private:
  std::uint32_t in_row_ = 0;
  RateWatch rate_;
};

}  // namespace godobject::firmware
