#pragma once

#include "hal/clock.h"

namespace godobject::hal {

/// CLOCK_MONOTONIC: setting the machine's date has no effect on it.
class MonotonicClock final : public Clock {
 public:
  std::int64_t now_ns() noexcept override;

  /// One clock_nanosleep to the absolute time; a signal does not end it.
  void sleep_until(std::int64_t ns) noexcept override;
};

}  // namespace godobject::hal
