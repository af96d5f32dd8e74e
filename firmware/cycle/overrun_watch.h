#pragma once

#include <cstdint>

#include "firmware/cycle/rate_watch.h"

namespace godobject::firmware {

/// Whether a loop overruns more often than can be gone on with: three times in a row, more than one cycle in a hundred
/// over the last second, or once by more than 5 ms.
class OverrunWatch {
 public:
  static constexpr std::uint32_t kInRow = 3;
  static constexpr std::int64_t kLong_ns = 5'000'000;

  /// One cycle: by how much the cycle before was late to end; 0 if it was not. True: too often, or too long.
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
