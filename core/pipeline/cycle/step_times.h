#pragma once

#include <cstdint>

#include "godobject/report.h"

namespace godobject::detail {

/// Starts the stopwatch of a cycle; `times` may be null.
inline void begin(StepTimes* times) noexcept {
  if (times == nullptr) return;
  times->step1_ns = times->solve_ns = 0;
  times->since_ns = times->now_ns();
}

/// Ends an interval, adds it to the member `spent`, and begins the next interval; `times` may be null.
inline void end(StepTimes* times, std::int64_t StepTimes::*spent) noexcept {
  if (times == nullptr) return;
  const std::int64_t now_ns = times->now_ns();
  times->*spent += now_ns - times->since_ns;
  times->since_ns = now_ns;
}

}  // namespace godobject::detail
