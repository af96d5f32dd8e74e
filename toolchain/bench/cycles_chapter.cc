#include <map>
#include <span>
#include <string>
#include <vector>

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

/// Returns the bytes of points, normals and sphere tree.
std::size_t bytes_of(const Pointshell& shell) {
  const std::size_t arrays = shell.normal_x != nullptr ? 6 : 3;
  return arrays * sizeof(float) * shell.size + shell.nodes.size_bytes();
}

using ColdTimes = std::map<const Phase*, std::vector<double>>;

/// Times about `wanted` cycles of each phase with cold caches, all in one pass [ns].
ColdTimes cold_by_phase(const SceneView& scene, const Pipeline& pipeline, std::span<const Pose> device,
                        const Workload& workload, std::size_t wanted) {
  std::map<std::size_t, const Phase*> phase_of;
  for (const Phase& phase : workload.phases) {
    for (const std::size_t cycle : thinned(phase.cycles, wanted)) phase_of[cycle] = &phase;
  }
  std::vector<std::size_t> cycles;
  for (const auto& [cycle, phase] : phase_of) cycles.push_back(cycle);
  const std::vector<double> times = time_cold_cycles(scene, pipeline, device, cycles);
  ColdTimes found;
  for (std::size_t i = 0; i < times.size(); ++i) found[phase_of[cycles[i]]].push_back(times[i]);
  return found;
}

/// Adds the targets of a phase of a path.
void add_targets(const Workload& workload, const Phase& phase, const Pipeline& pipeline, const CycleTimes& times,
                 const Distribution& cold, std::vector<Target>& targets) {
  if (workload.name != "bunny-teapot" || pipeline.solver != Solver::kContact) return;
  const Distribution whole = times.whole.all(phase.cycles);
  const Distribution own = times.whole.least(phase.cycles);
  const auto add = [&](const std::string& quantity, double wanted, double measured_ns) {
    targets.push_back(
        {fmt::format("{}, {}: {}", phase.name, pipeline.name(), quantity), "us", wanted, 1e-3 * measured_ns, false});
  };
  if (phase.name == "free") add("cycle, p50", 0.3, whole.p50);
  if (phase.name != "sliding") return;
  const double slow = pipeline.friction ? 20.0 : 5.0;
  add("cycle, p50", pipeline.friction ? 4.0 : 1.0, whole.p50);
  add("cycle, p99.9", slow, whole.p999);
  add("cycle, own p99.9", slow, own.p999);
  add("cycle, cold, p50", 10.0, cold.p50);
}

/// Adds the targets of the peg, from its way into the hole to the press on the bottom.
void add_peg_targets(const Workload& workload, const Pipeline& pipeline, const CycleTimes& times,
                     std::vector<Target>& targets) {
  if (workload.name != "peg-hole" || pipeline.solver != Solver::kContact) return;
  std::vector<std::size_t> cycles;
  for (const Phase& phase : workload.phases) {
    if (phase.name != "free") cycles.insert(cycles.end(), phase.cycles.begin(), phase.cycles.end());
  }
  const Distribution whole = times.whole.all(cycles);
  const std::string name = "peg in hole, " + pipeline.name();
  targets.push_back({name + ": cycle, p50", "us", 20.0, 1e-3 * whole.p50, false});
  targets.push_back({name + ": cycle, p99.9", "us", 60.0, 1e-3 * whole.p999, false});
  targets.push_back({name + ": cycle, own p99.9", "us", 60.0, 1e-3 * times.whole.least(cycles).p999, false});
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
                  "own: the shortest time of a cycle of all passes, without interruptions. #1 (look-ups and "
                  "certificate) and #2-#7 are own times and include some readings of the clock. cold: 96 MB are read "
                  "before the cycle."};
  Chapter chapter;
  Table all = shown;
  all.name = "cycles_all";
  all.title = "Whole cycles #1-#7 of all pipelines [us]";
  const std::size_t cold_samples = request.full ? 200 : 25;
  for (std::size_t w = 0; w < workloads().size(); ++w) {
    const Workload& workload = workloads()[w];
    const auto image = cache.image(request.scenes / (workload.scene + ".toml"), request.progress);
    const std::vector<Pose> device = device_poses(workload, request.scenes);
    const std::vector<Pipeline> held = pipelines(image.scene);
    if (workload.name == "bunny-teapot") {
      constexpr double kMiB = 1024.0 * 1024.0;
      const std::size_t fields =
          image.bytes.span().size() - bytes_of(image.scene.pointshell) - bytes_of(image.scene.features);
      chapter.targets.push_back({"bunny-teapot: image without points and their trees", "MiB", 0.5,
                                 static_cast<double>(fields) / kMiB, false});
    }
    for (std::size_t p = 0; p < held.size(); ++p) {
      request.progress("cycles, " + workload.name, static_cast<double>(p) / static_cast<double>(held.size()));
      const bool twice = request.full || held[p].solver == Solver::kContact;  // for own times
      const PassBudget budget{.least_passes = twice ? 2u : 1u, .most_passes = 40, .seconds = request.full ? 4.0 : 0.4};
      const CycleTimes times = time_cycles(image.scene, held[p], device, budget);
      auto cold_times = held[p].solver == Solver::kContact
                            ? cold_by_phase(image.scene, held[p], device, workload, cold_samples)
                            : ColdTimes();
      add_peg_targets(workload, held[p], times, chapter.targets);
      for (const Phase& phase : workload.phases) {
        const Distribution cold = distribution(cold_times[&phase]);
        add_targets(workload, phase, held[p], times, cold, chapter.targets);
        all.rows.push_back(row(workload, phase, held[p], times, cold));
        if (held[p].solver == Solver::kContact) shown.rows.push_back(all.rows.back());
      }
    }
  }
  chapter.tables.push_back(std::move(shown));
  chapter.details.push_back(std::move(all));
  return chapter;
}

}  // namespace godobject::bench
