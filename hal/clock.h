#pragma once

#include <cstdint>

namespace godobject::hal {

/// Time that only goes forward, and waiting for it: the machine's monotonic clock, or virtual time.
class Clock {
 public:
  virtual ~Clock() = default;

  /// Returns the present time [ns].
  virtual std::int64_t now_ns() noexcept = 0;

  /// Returns at `ns` or later, at once if it has passed.
  virtual void sleep_until(std::int64_t ns) noexcept = 0;

 protected:
  Clock() = default;
  Clock(const Clock&) = default;
  Clock& operator=(const Clock&) = default;
};

}  // namespace godobject::hal
