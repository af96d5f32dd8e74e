#pragma once

#include <cstdint>

#include "firmware/cycle/rate_watch.h"
#include "hal/joint_drives.h"

namespace godobject::firmware {

/// Detects too many late cycles, which overrun or compute for longer than planned: kInRow in a row, more than one cycle
/// in a hundred over the last thousand, or one that is late by more than the drives wait for torques.
class LatenessWatch {
 public:
  /// Chosen, as for lost positions: the drives hold the last torque for two cycles. With 5 the arm no longer stops
  /// within the 8 cycles of the fault table, with 2 a single disturbance of two cycles stops it.
  static constexpr std::uint32_t kInRow = 3;

  /// `period`: T [s].
  explicit LatenessWatch(double period) noexcept
      : long_ns_(static_cast<std::int64_t>(1e9 * (hal::default_deadline(period) + period) + 0.5)) {}

  /// Takes the lateness of one cycle; 0: in time. True: too often, or too late.
  bool update(std::int64_t late_ns) noexcept {
    const bool late = late_ns > 0;
    in_row_ = late ? in_row_ + 1 : 0;
    const bool too_often = rate_.update(late);
    return too_often || in_row_ >= kInRow || late_ns > long_ns_;
  }

 private:
  std::int64_t long_ns_;  // derived: a period longer than drives wait by default before they stop by themselves
  std::uint32_t in_row_ = 0;
  RateWatch rate_;
};

}  // namespace godobject::firmware
