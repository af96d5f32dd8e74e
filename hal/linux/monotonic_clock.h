#pragma once

#include "hal/clock.h"

namespace godobject::hal {

/// CLOCK_MONOTONIC: independent of the machine's date.
class MonotonicClock final : public Clock {
 public:
  std::int64_t now_ns() noexcept override;

  /// Sleeps until the absolute time by clock_nanosleep; a signal does not end the sleep.
  void sleep_until(std::int64_t ns) noexcept override;
};

}  // namespace godobject::hal
