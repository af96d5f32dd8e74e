#include "toolchain/timing/stopwatch.h"

#include <ctime>
#include <fstream>
#include <string>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace godobject::timing {
namespace {

std::int64_t monotonic_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{1000000000} * now.tv_sec + now.tv_nsec;
}

#if defined(__x86_64__)
double ns_per_tick = 0.0;
std::uint64_t first_tick = 0;

std::int64_t counter_ns() noexcept {
  return static_cast<std::int64_t>(ns_per_tick * static_cast<double>(__rdtsc() - first_tick));
}

/// True if Linux itself uses the counter as its clock, which it does only if the counter runs evenly.
bool is_even() {
  std::string name;
  std::ifstream("/sys/devices/system/clocksource/clocksource0/current_clocksource") >> name;
  return name == "tsc";
}

Stopwatch choose() {
  constexpr std::int64_t kCompared_ns = 20'000'000;
  if (!is_even()) return &monotonic_ns;
  const std::int64_t begin_ns = monotonic_ns();
  first_tick = __rdtsc();
  std::int64_t elapsed_ns = 0;
  while (elapsed_ns < kCompared_ns) elapsed_ns = monotonic_ns() - begin_ns;
  ns_per_tick = static_cast<double>(elapsed_ns) / static_cast<double>(__rdtsc() - first_tick);
  return &counter_ns;
}
#else
Stopwatch choose() { return &monotonic_ns; }
#endif

}  // namespace

Stopwatch stopwatch() {
  static const Stopwatch chosen = choose();
  return chosen;
}

}  // namespace godobject::timing
