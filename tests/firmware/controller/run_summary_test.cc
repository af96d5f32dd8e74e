#include "firmware/controller/run_summary.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "firmware/machine/rt_setup.h"

namespace godobject::firmware::run_summary_test {
namespace {

RunReport& example(RunReport& report) {
  report.rendering = 41;
  report.in_contact = 42;
  report.largest_force = 1.234;
  report.largest_torque = 0.5678;
  report.deepest = 1.5e-3;
  report.in_mode[static_cast<std::size_t>(Mode::kBoot)] = 1500;
  report.in_mode[static_cast<std::size_t>(Mode::kRunning)] = 250;
  report.beyond_plan = 43;
  for (const std::int64_t us : {1, 2, 3}) report.computing.add(1000 * us);
  report.round_trip.add(5000);
  report.loop.lateness.add(6000);
  report.loop.lateness.add(6000);
  report.loop.collect_lateness.add(7000);
  return report;
}

CycleCounters counters() {
  CycleCounters counters;
  counters.cycles = 11;
  counters.lost = 12;
  counters.jumps = 13;
  counters.overruns = 14;
  counters.skipped = 15;
  counters.sends_failed = 16;
  counters.clipped = 17;
  counters.slowed = 18;
  counters.scaled = 19;
  counters.rate_limited = 20;
  counters.unconverged = 21;
  counters.out_of_work = 22;
  counters.most_out_of_work = 23;
  return counters;
}

const char* const kAlways =
    "rendered in 41 of 11 cycles, in contact in 42: at most 1.23 N, 0.568 Nm, 1.500 mm deep\n"
    "modes: boot 1.500 s, running 0.250 s\n"
    "positions lost in 12 cycles, jumps in 13, sends failed 16, overruns 14, periods skipped 15\n"
    "buses: none\n"
    "limits: force in 17 cycles, speed 18, joint torque 19, torque rate 20; friction not found in 21\n";

const char* const kComputing =
    "computing: p50 2.0 us, p99.9 3.0 us, largest 3.0 us of 3 cycles; longer than loop.compute in 43\n"
    "budget of work: spent in 22 cycles, at most 23 in a row\n";

TEST(RunSummary, TellsOfAnInternalLimitOnlyIfThereWasOne) {
  RunReport report;
  CycleCounters counts = counters();
  const std::string without = run_summary(example(report), counts, 1e-3, "", std::nullopt);
  EXPECT_EQ(without.find("internal limit"), std::string::npos);
  counts.limited = 24;
  const std::string with = run_summary(report, counts, 1e-3, "", std::nullopt);
  EXPECT_NE(with.find("\ninternal limit of a drive: active in 24 cycles with power\n"), std::string::npos) << with;
}

TEST(RunSummary, TellsOfTemperaturesOnlyIfThereWasAWarning) {
  RunReport report;
  CycleCounters counts = counters();
  EXPECT_EQ(run_summary(example(report), counts, 1e-3, "", std::nullopt).find("temperature"), std::string::npos);
  counts.warm = 25;
  counts.temperature_lost = 26;
  const std::string text = run_summary(report, counts, 1e-3, "", std::nullopt);
  EXPECT_NE(text.find("\ntemperature of a drive: above temperature.warn in 25 cycles, not answered in 26\n"),
            std::string::npos)
      << text;
}

TEST(RunSummary, HasEachNumberInItsPlace) {
  RunReport report;
  const std::string text = run_summary(example(report), counters(), 1e-3, "buses: none\n", std::nullopt);
  EXPECT_EQ(text, fmt::format("{}{}on {}\n", kAlways, kComputing, describe_machine()));
}

TEST(RunSummary, HasLatenciesOnlyOfARealTimeRun) {
  RunReport report;
  const std::string text = run_summary(example(report), counters(), 1e-3, "buses: none\n", 3);
  EXPECT_EQ(text, fmt::format("{}{}"
                              "round trip: p50 5.0 us, p99.9 5.0 us, largest 5.0 us of 1 cycles\n"
                              "waking late: p50 6.0 us, p99.9 6.0 us, largest 6.0 us of 2 cycles\n"
                              "waking late for the samples: p50 7.0 us, p99.9 7.0 us, largest 7.0 us of 1 cycles\n"
                              "page faults in the loop: 3\n"
                              "on {}\n",
                              kAlways, kComputing, describe_machine()));
}

}  // namespace
}  // namespace godobject::firmware::run_summary_test
