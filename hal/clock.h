#pragma once

#include <cstdint>

namespace godobject::hal {

/// Monotonic time and waiting: the machine's clock, or virtual time.
class Clock {
 public:
  virtual ~Clock() = default;

  /// Returns the present time [ns].
  virtual std::int64_t now_ns() noexcept = 0;

  /// Waits until `ns`; returns at once if that has passed.
  virtual void sleep_until(std::int64_t ns) noexcept = 0;

 protected:
  Clock() = default;
  Clock(const Clock&) = default;
  Clock& operator=(const Clock&) = default;
};

}  // namespace godobject::hal
