#include "toolchain/precision/trace.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "toolchain/command_line/failure.h"
#include "toolchain/precision/instruction_counter.h"
#include "toolchain/statistics/samples.h"
#include "toolchain/timing/stopwatch.h"

namespace godobject::precision {
namespace {

/// Returns the cost from `passes` times of each cycle.
CycleCost cost_of(const std::vector<std::vector<double>>& times_ns) {
  std::vector<double> medians;
  for (const std::vector<double>& of_cycle : times_ns) medians.push_back(percentile(of_cycle, 0.5));
  CycleCost cost;
  cost.p50_ns = percentile(medians, 0.5);
  cost.p99_ns = percentile(medians, 0.99);
  cost.max_ns = *std::max_element(medians.begin(), medians.end());
  return cost;
}

template <class Cycle>
void for_each_cycle(Session& session, const Paths& paths, Cycle&& cycle) {
  for (const std::vector<Pose>& path : paths) {
    session.reset();
    for (const Pose& H_WM : path) cycle(H_WM);
  }
}

}  // namespace

Session::Session(const SceneView& scene, const Setting& setting) : god_object_(std::make_unique<OwnedGodObject>()) {
  SceneView with_margin = scene;
  with_margin.settings.margin = setting.margin;
  if (god_object_->start(with_margin, setting.solver, setting.friction) != Status::kOk) {
    throw command::Failure(command::ExitCode::kBadData,
                           "the scene image was compiled without " + name(setting) + "; compile it again");
  }
}

TracedCycle Session::update(const Pose& H_WM) {
  CycleReport report;
  if ((*god_object_)->update({H_WM, Motion{}}, report) != Status::kOk) {
    throw command::Failure(command::ExitCode::kBadData,
                           "the path contains an invalid pose; godobject-replay names its row");
  }
  return {(*god_object_)->mesh_pose(), report.force.spring_W};
}

std::vector<TracedCycle> trace(Session& session, const Paths& paths) {
  std::vector<TracedCycle> cycles;
  for_each_cycle(session, paths, [&](const Pose& H_WM) { cycles.push_back(session.update(H_WM)); });
  return cycles;
}

std::vector<CycleCost> time_cycles(std::span<Session> sessions, const Paths& paths, std::size_t passes) {
  const timing::Stopwatch now_ns = timing::stopwatch();
  std::vector<std::vector<std::vector<double>>> times_ns(sessions.size());
  for (std::size_t pass = 0; pass < passes; ++pass) {
    for (std::size_t s = 0; s < sessions.size(); ++s) {
      std::size_t cycle = 0;
      for_each_cycle(sessions[s], paths, [&](const Pose& H_WM) {
        const std::int64_t begin_ns = now_ns();
        sessions[s].update(H_WM);
        const auto taken_ns = static_cast<double>(now_ns() - begin_ns);
        if (pass == 0) times_ns[s].emplace_back();
        times_ns[s][cycle++].push_back(taken_ns);
      });
    }
  }
  std::vector<CycleCost> costs;
  InstructionCounter counter;
  for (std::size_t s = 0; s < sessions.size(); ++s) {
    costs.push_back(cost_of(times_ns[s]));
    counter.start();
    for_each_cycle(sessions[s], paths, [&](const Pose& H_WM) { sessions[s].update(H_WM); });
    costs.back().instructions = counter.stop() / static_cast<double>(times_ns[s].size());
  }
  return costs;
}

}  // namespace godobject::precision
