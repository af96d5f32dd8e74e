#pragma once

#include <cstdint>

namespace godobject::timing {

/// A clock for stretches of less than a microsecond: nanoseconds since some moment. The processor's own counter where
/// it is known to run evenly, because a system clock's reading can take 0.1 us; else CLOCK_MONOTONIC.
using Stopwatch = std::int64_t (*)() noexcept;

/// The first call compares the counter with the system's clock for 20 ms.
Stopwatch stopwatch();

}  // namespace godobject::timing
