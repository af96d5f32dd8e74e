#pragma once

#include <cstdint>

namespace godobject::timing {

/// A clock for times below a microsecond: nanoseconds since some moment. It is the processor's own counter if that runs
/// evenly, because reading a system clock can take 0.1 us; otherwise CLOCK_MONOTONIC.
using Stopwatch = std::int64_t (*)() noexcept;

/// Returns the clock. The first call compares the counter with the system's clock for 20 ms.
Stopwatch stopwatch();

}  // namespace godobject::timing
