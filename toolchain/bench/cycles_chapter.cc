#include <fmt/format.h>

#include "toolchain/bench/chapters.h"
#include "toolchain/bench/cycle_times.h"
#include "toolchain/bench/workload.h"

namespace godobject::bench {
namespace {

std::vector<std::string> row(const Workload& workload, const Phase& phase, const Pipeline& pipeline,
                             const CycleTimes& times, const Distribution& cold) {
  const Distribution whole = times.whole.all(phase.cycles);
  const Distribution least = times.whole.least(phase.cycles);
  const Distribution step1 = times.step1.least(phase.cycles);
  const Distribution solve = times.solve.least(phase.cycles);
  const auto us = [](double ns) { return digits(1e-3 * ns); };
  const auto cold_us = [&](double ns) { return cold.count == 0 ? "-" : us(ns); };
  return {workload.name + ", " + phase.name,
          pipeline.name(),
          us(whole.p50),
          us(whole.p99),
          us(whole.p999),
          us(whole.max),
          us(least.p50),
          us(least.p999),
          us(least.max),
          us(step1.p50),
          us(step1.p999),
          us(solve.p50),
          us(solve.p999),
          cold_us(cold.p50),
          cold_us(cold.p99)};
}

const std::vector<std::string> kColumns = {"path, phase", "pipeline",  "p50",         "p99",      "p99.9",
                                           "max",         "own p50",   "own p99.9",   "own max",  "#1 p50",
                                           "#1 p99.9",    "#2-#7 p50", "#2-#7 p99.9", "cold p50", "cold p99"};

}  // namespace

Chapter cycles_chapter(const BenchRequest& request) {
  const SceneCache cache(request.cache);
  Table shown{.name = "cycles",
              .title = "Whole cycles #1-#7 of contact [us]",
              .columns = kColumns,
              .rows = {},
              .note =
                  "own: each cycle's least of all passes, what it takes when nobody interrupts it; #1 (look-ups and "
                  "certificate) and #2-#7 are of that kind, with a few readings of the clock in them. cold: 96 MB "
                  "walked before the cycle."};
  Table all = shown;
  all.name = "cycles_all";
  all.title = "Whole cycles #1-#7 of all pipelines [us]";
  const PassBudget budget{.least_passes = 3, .most_passes = 40, .seconds = request.full ? 4.0 : 0.6};
  const std::size_t cold_samples = request.full ? 200 : 40;
  for (std::size_t w = 0; w < workloads().size(); ++w) {
    const Workload& workload = workloads()[w];
    const auto image = cache.image(request.scenes / (workload.scene + ".toml"), request.progress);
    const std::vector<Pose> device = device_poses(workload, request.scenes);
    const std::vector<Pipeline> held = pipelines(image.scene);
    for (std::size_t p = 0; p < held.size(); ++p) {
      request.progress("cycles, " + workload.name, static_cast<double>(p) / static_cast<double>(held.size()));
      const CycleTimes times = time_cycles(image.scene, held[p], device, budget);
      for (const Phase& phase : workload.phases) {
        Distribution cold;
        if (held[p].solver == Solver::kContact) {
          cold = distribution(time_cold_cycles(image.scene, held[p], device, thinned(phase.cycles, cold_samples)));
        }
        all.rows.push_back(row(workload, phase, held[p], times, cold));
        if (held[p].solver == Solver::kContact) shown.rows.push_back(all.rows.back());
      }
    }
  }
  Chapter chapter;
  chapter.tables.push_back(std::move(shown));
  chapter.details.push_back(std::move(all));
  return chapter;
}

}  // namespace godobject::bench
