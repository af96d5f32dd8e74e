#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "firmware/cycle/control_cycle.h"
#include "firmware/loop/periodic_loop.h"
#include "firmware/loop/run_requests.h"
#include "firmware/loop/telemetry_ring.h"
#include "hal/clock.h"

namespace godobject::firmware {

struct RunSetup {
  std::uint64_t cycles = 0;  ///< after which it ends by itself; 0: never
  std::uint32_t every = 1;   ///< cycles a telemetry record
  /// Of the machine, for the time that computing takes; in virtual time it takes none.
  hal::Clock* stopwatch = nullptr;
  std::int64_t compute_ns = 0;  ///< that computing may take by the bus plan
};

/// How a run stands in a cycle, for who tells the operator.
struct Standing {
  Mode mode = Mode::kBoot;
  Fault fault = Fault::kNone;
  hal::Alarm alarm = hal::Alarm::kNone;
  std::int8_t alarm_joint = -1;  ///< whose alarm; -1: nobody's alone
};
static_assert(std::atomic<Standing>::is_always_lock_free);

/// What a run leaves beside its records.
struct RunReport {
  LoopStatistics loop;
  DurationHistogram computing;    ///< of a cycle, by the stopwatch
  DurationHistogram round_trip;   ///< end of SYNC to the end of the last sample; for a reader that knows it
  std::uint64_t beyond_plan = 0;  ///< cycles in which it took longer than the bus plan gives it
  double largest_force = 0.0;     ///< rendered at the hand [N]
  double largest_torque = 0.0;    ///< [Nm]
  double deepest = 0.0;           ///< of the god object while something was rendered [m]
  std::uint64_t rendering = 0;    ///< cycles with something granted
  std::uint64_t in_contact = 0;   ///< of those, with a force
  std::array<std::uint64_t, kModeCount> in_mode{};  ///< cycles
  /// Cycles in a row that it has waited for the operator, in kIdle or kArmed; another thread may look at it.
  std::atomic<std::uint32_t> waiting{0};
  std::atomic<Standing> standing{};  ///< another thread may look at it
};

/// A fault in it ends the run: what was found wrong before anything was rendered will not mend itself.
bool refuses_to_start(Fault fault) noexcept;

/// The loop, until the supervisor has ended it, or has refused to start. Every record goes to `ring`, from which
/// `reader()` is called once a cycle: in virtual time it is what another thread does else. Real-time safe if `reader`
/// is.
template <class Reader>
void run_controller(const RunSetup& setup, hal::Clock& clock, ControlCycle& cycle, RunRequests& requests,
                    TelemetryRing& ring, RunReport& report, Reader&& reader) noexcept;

namespace detail {

void watch(const CycleRecord& record, RunReport& report) noexcept;

}  // namespace detail

template <class Reader>
void run_controller(const RunSetup& setup, hal::Clock& clock, ControlCycle& cycle, RunRequests& requests,
                    TelemetryRing& ring, RunReport& report, Reader&& reader) noexcept {
  constexpr std::int64_t kPeriod_ns = 1'000'000;
  std::uint64_t cycles = 0;
  run_periodically(
      clock, kPeriod_ns, cycle.collect_ns(), report.loop, [&] { cycle.request(); },
      [&](LoopEvents events) {
        const bool over = setup.cycles > 0 && cycles >= setup.cycles;
        events.end_requested = over || requests.end.load(std::memory_order_relaxed);
        events.reset_requested = requests.reset.exchange(false, std::memory_order_relaxed);
        const std::int64_t begin_ns = setup.stopwatch->now_ns();
        cycle.run_once(events);
        const std::int64_t took_ns = setup.stopwatch->now_ns() - begin_ns;
        report.computing.add(took_ns);
        report.beyond_plan += took_ns > setup.compute_ns ? 1 : 0;
        ++cycles;
        const Mode mode = cycle.record().mode;
        return mode != Mode::kEnded && !(mode == Mode::kStopped && refuses_to_start(cycle.record().fault));
      },
      [&](const CycleTimes& times) {
        detail::watch(cycle.record(), report);
        if (cycles % setup.every == 0) ring.push({times, cycle.record()});
        reader();
      });
}

}  // namespace godobject::firmware
