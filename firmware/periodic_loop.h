#pragma once

#include <cstdint>

#include "firmware/control_cycle.h"
#include "firmware/duration_histogram.h"
#include "hal/clock.h"

namespace godobject::firmware {

/// When a cycle woke and how long it took: the scheduler's fault, and ours.
struct CycleTimes {
  std::int64_t deadline_ns = 0;  ///< at which it should have woken
  std::int64_t late_ns = 0;      ///< by which it woke later
  std::int64_t compute_ns = 0;
};

struct LoopStatistics {
  DurationHistogram lateness;
  DurationHistogram compute;
};

/// Calls `body(events)` once a period, at absolute deadlines so that errors do not add up, until it returns false.
/// `after(times)` follows each call, once the next deadline is known: it is for records and does not count as
/// computing.
///
/// Overruns: a cycle that ends after the next one should have begun. Deadlines that have passed by then are left out,
/// never made up for in a burst; the next call is told by how much it was late and how many were left out, and the
/// statistics count both. Real-time safe if `body` and `after` are.
template <class Body, class After>
void run_periodically(hal::Clock& clock, std::int64_t period_ns, LoopStatistics& statistics, Body&& body,
                      After&& after) noexcept {
  LoopEvents events;
  std::int64_t deadline_ns = (clock.now_ns() + period_ns - 1) / period_ns * period_ns;
  for (bool goes_on = true; goes_on;) {
    clock.sleep_until(deadline_ns);
    const std::int64_t woke_ns = clock.now_ns();
    goes_on = body(events);
    const std::int64_t done_ns = clock.now_ns();
    const CycleTimes times{deadline_ns, woke_ns - deadline_ns, done_ns - woke_ns};
    statistics.lateness.add(times.late_ns);
    statistics.compute.add(times.compute_ns);
    deadline_ns += period_ns;
    events = LoopEvents();
    if (done_ns > deadline_ns) {
      events.overrun_ns = done_ns - deadline_ns;
      events.skipped = static_cast<std::uint32_t>((events.overrun_ns - 1) / period_ns + 1);
      deadline_ns += events.skipped * period_ns;
    }
    after(times);
  }
}

}  // namespace godobject::firmware
