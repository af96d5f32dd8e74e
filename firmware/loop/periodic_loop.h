#pragma once

#include <algorithm>
#include <cstdint>

#include "firmware/cycle/control_cycle.h"
#include "firmware/loop/duration_histogram.h"
#include "hal/clock.h"

namespace godobject::firmware {

/// Times of one cycle: lateness, which is the scheduler's, and computing time, which is the controller's.
struct CycleTimes {
  std::int64_t deadline_ns = 0;      ///< planned time of waking
  std::int64_t late_ns = 0;          ///< lateness of waking
  std::int64_t collect_late_ns = 0;  ///< lateness of waking for the samples
  std::int64_t compute_ns = 0;       ///< duration of `body`
};

struct LoopStatistics {
  DurationHistogram lateness;
  DurationHistogram collect_lateness;
  DurationHistogram compute;
};

/// The times that a loop plans with.
struct LoopPlan {
  std::int64_t period_ns = 0;
  std::int64_t collect_ns = 0;  ///< from the request to the samples
  std::int64_t compute_ns = 0;  ///< computing time that the bus plan and the gain check count on
};

/// Calls `request()` and, `plan.collect_ns` later, `body(events)` once a period until `body` returns false. Deadlines
/// are absolute, so errors do not accumulate. `after(times)` follows each `body`, after the next deadline is known: it
/// is for records, and its duration is not computing time.
///
/// A body that takes longer than `plan.compute_ns` computes late: its torques reach the drives later than planned.
/// `events` reports that to the next cycle.
///
/// Overruns: a cycle ends after the next one should have begun, or wakes a period late. Deadlines that have passed by
/// then are skipped, never made up for in a burst. `events` reports to a cycle, each once, its own late waking and the
/// time by which the previous cycle ended late. It also reports the periods without a call since the previous one,
/// counted from waking to waking, which is when positions are sampled. Real-time safe if `body` and `after` are.
template <class Request, class Body, class After>
void run_periodically(hal::Clock& clock, const LoopPlan& plan, LoopStatistics& statistics, Request&& request,
                      Body&& body, After&& after) noexcept {
  const std::int64_t period_ns = plan.period_ns;
  const auto nearest_period = [period_ns](std::int64_t ns) { return (ns + period_ns / 2) / period_ns; };
  std::int64_t deadline_ns = (clock.now_ns() + period_ns - 1) / period_ns * period_ns;
  std::int64_t last_period = nearest_period(deadline_ns) - 1;
  std::int64_t took_too_long_ns = 0;
  std::int64_t computed_late_ns = 0;
  for (bool goes_on = true; goes_on;) {
    clock.sleep_until(deadline_ns);
    const std::int64_t woke_ns = clock.now_ns();
    const std::int64_t late_ns = woke_ns - deadline_ns;
    request();
    if (plan.collect_ns > 0) clock.sleep_until(woke_ns + plan.collect_ns);
    const std::int64_t collected_ns = clock.now_ns();
    const bool woke_late = late_ns >= period_ns;
    const std::int64_t period = nearest_period(woke_ns);
    LoopEvents events;
    events.skipped = static_cast<std::uint32_t>(std::max<std::int64_t>(0, period - last_period - 1));
    events.overrun_ns = std::max(took_too_long_ns, woke_late ? late_ns : 0);
    events.computed_late_ns = computed_late_ns;
    last_period = period;
    goes_on = body(events);
    const std::int64_t done_ns = clock.now_ns();
    const CycleTimes times{deadline_ns, late_ns, collected_ns - woke_ns - plan.collect_ns, done_ns - collected_ns};
    statistics.lateness.add(times.late_ns);
    statistics.collect_lateness.add(times.collect_late_ns);
    statistics.compute.add(times.compute_ns);
    computed_late_ns = std::max<std::int64_t>(0, times.compute_ns - plan.compute_ns);
    const std::int64_t next_ns = woke_late ? woke_ns + period_ns : deadline_ns + period_ns;
    took_too_long_ns = std::max<std::int64_t>(0, done_ns - next_ns);
    deadline_ns += period_ns;
    if (done_ns > deadline_ns) deadline_ns += ((done_ns - deadline_ns - 1) / period_ns + 1) * period_ns;
    after(times);
  }
}

}  // namespace godobject::firmware
