#include "firmware/controller/run_summary.h"

#include <cstddef>
#include <cstdint>
#include <iterator>

#include <fmt/format.h>

#include "firmware/machine/rt_setup.h"

namespace godobject::firmware {
namespace {

std::string quantiles(const DurationHistogram& times) {
  const auto us = [](std::int64_t ns) { return 1e-3 * static_cast<double>(ns); };
  return fmt::format("p50 {:.1f} us, p99.9 {:.1f} us, largest {:.1f} us of {} cycles", us(times.quantile_ns(0.5)),
                     us(times.quantile_ns(0.999)), us(times.largest_ns()), times.count());
}

std::string seconds_in_modes(const RunReport& report, double period) {
  std::string text;
  for (std::size_t mode = 0; mode < report.in_mode.size(); ++mode) {
    if (report.in_mode[mode] == 0) continue;
    text += fmt::format("{} {} {:.3f} s", text.empty() ? "" : ",", name(static_cast<Mode>(mode)),
                        period * static_cast<double>(report.in_mode[mode]));
  }
  return text;
}

}  // namespace

std::string run_summary(const RunReport& report, const CycleCounters& counters, double period,
                        const std::string& transport, std::optional<long> page_faults) {
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "rendered in {} of {} cycles, in contact in {}: at most {:.2f} N, {:.3f} Nm, {:.3f} mm deep\n",
                 report.rendering, counters.cycles, report.in_contact, report.largest_force, report.largest_torque,
                 1e3 * report.deepest);
  fmt::format_to(out, "modes:{}\n", seconds_in_modes(report, period));
  fmt::format_to(out, "positions lost in {} cycles, jumps in {}, sends failed {}, overruns {}, periods skipped {}\n",
                 counters.lost, counters.jumps, counters.sends_failed, counters.overruns, counters.skipped);
  text += transport;
  fmt::format_to(out,
                 "limits: force in {} cycles, speed {}, joint torque {}, torque rate {}; friction not found in {}\n",
                 counters.clipped, counters.slowed, counters.scaled, counters.rate_limited, counters.unconverged);
  fmt::format_to(out, "computing: {}; longer than loop.compute in {}\n", quantiles(report.computing),
                 report.beyond_plan);
  if (counters.out_of_work > 0) {
    fmt::format_to(out, "budget of work: spent in {} cycles, at most {} in a row\n", counters.out_of_work,
                   counters.most_out_of_work);
  }
  if (counters.limited > 0) {
    fmt::format_to(out, "internal limit of a drive: active in {} cycles with power\n", counters.limited);
  }
  if (counters.warm + counters.temperature_lost > 0) {
    fmt::format_to(out, "temperature of a drive: above temperature.warn in {} cycles, not answered in {}\n",
                   counters.warm, counters.temperature_lost);
  }
  if (page_faults) {
    fmt::format_to(out, "round trip: {}\n", quantiles(report.round_trip));
    fmt::format_to(out, "waking late: {}\n", quantiles(report.loop.lateness));
    fmt::format_to(out, "waking late for the samples: {}\n", quantiles(report.loop.collect_lateness));
    fmt::format_to(out, "page faults in the loop: {}\n", *page_faults);
  }
  fmt::format_to(out, "on {}\n", describe_machine());
  return text;
}

}  // namespace godobject::firmware
