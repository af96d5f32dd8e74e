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

/// Settings of `run_controller`.
struct RunSetup {
  std::int64_t period_ns = 1'000'000;  ///< T
  std::uint64_t cycles = 0;            ///< cycles until the run ends; 0: no limit
  /// The machine's clock, to measure computing time; the loop's own clock stands still meanwhile in virtual time.
  hal::Clock* stopwatch = nullptr;
  std::int64_t compute_ns = 0;  ///< computing time in the bus plan
};

/// The state of a run for the thread that informs the operator.
struct Standing {
  Mode mode = Mode::kBoot;
  Fault fault = Fault::kNone;
  hal::Alarm alarm = hal::Alarm::kNone;
  std::int8_t alarm_joint = -1;  ///< joint of the alarm; -1: no single joint
};
static_assert(std::atomic<Standing>::is_always_lock_free);

/// The figures of a run for its summary.
struct RunReport {
  LoopStatistics loop;
  DurationHistogram computing;                      ///< computing time of a cycle, by the stopwatch
  std::int64_t computed_ns = 0;                     ///< the same of the last cycle
  DurationHistogram round_trip;                     ///< from the request to the last sample; filled by the reader
  std::uint64_t beyond_plan = 0;                    ///< cycles that computed for longer than `compute_ns`
  double largest_force = 0.0;                       ///< largest rendered force at the hand [N]
  double largest_torque = 0.0;                      ///< largest rendered torque at the hand [Nm]
  double deepest = 0.0;                             ///< largest penetration of the god object while rendering [m]
  std::uint64_t rendering = 0;                      ///< cycles with a rendered share above 0
  std::uint64_t in_contact = 0;                     ///< of those, cycles with a force
  std::array<std::uint64_t, kModeCount> in_mode{};  ///< cycles in each mode
  std::atomic<std::uint32_t> waiting{0};            ///< cycles in a row in kIdle or kArmed; other threads may read it
  /// Longest row of cycles that the budget of work ended, since another thread has set it to 0.
  std::atomic<std::uint32_t> longest_behind{0};
  /// Drives that limited their torque since another thread has set it to 0, one bit a joint.
  std::atomic<std::uint8_t> limited{0};
  std::atomic<std::uint8_t> warm{0};              ///< the same for warm drives
  std::atomic<std::uint8_t> temperature_lost{0};  ///< the same for drives that did not answer for their temperature
  std::atomic<Standing> standing{};               ///< of the last cycle; other threads may read it
};

/// True if the fault ends the run: a fault that was found before rendering does not go away by a reset.
bool refuses_to_start(Fault fault) noexcept;

/// Runs the loop until the supervisor has ended it or has refused to start. Every record goes to `ring`. `reader()` is
/// called once a cycle after that: in virtual time it does the work of the other threads. Real-time safe if `reader`
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
  std::uint64_t cycles = 0;
  run_periodically(
      clock, {setup.period_ns, cycle.collect_ns(), setup.compute_ns}, report.loop, [&] { cycle.request(); },
      [&](LoopEvents events) {
        const bool over = setup.cycles > 0 && cycles >= setup.cycles;
        events.end_requested = over || requests.end.load(std::memory_order_relaxed);
        events.reset_requested = requests.reset.exchange(false, std::memory_order_relaxed);
        const std::int64_t begin_ns = setup.stopwatch->now_ns();
        cycle.run_once(events);
        const std::int64_t took_ns = setup.stopwatch->now_ns() - begin_ns;
        report.computing.add(took_ns);
        report.computed_ns = took_ns;
        report.beyond_plan += took_ns > setup.compute_ns ? 1 : 0;
        ++cycles;
        const Mode mode = cycle.record().mode;
        return mode != Mode::kEnded && !(mode == Mode::kStopped && refuses_to_start(cycle.record().fault));
      },
      [&](const CycleTimes& times) {
        detail::watch(cycle.record(), report);
        ring.push({times, cycle.record()});
        reader();
      });
}

}  // namespace godobject::firmware
