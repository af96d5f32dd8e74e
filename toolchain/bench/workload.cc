#include "toolchain/bench/workload.h"

#include <initializer_list>
#include <utility>

#include <fmt/format.h>

#include "toolchain/path/pose_file.h"

namespace godobject::bench {
namespace {

Phase phase(std::string name, std::initializer_list<std::pair<std::size_t, std::size_t>> ranges) {
  Phase result{std::move(name), {}};
  for (const auto& [first, end] : ranges) {
    for (std::size_t i = first; i < end; ++i) result.cycles.push_back(i);
  }
  return result;
}

}  // namespace

const std::vector<Workload>& workloads() {
  static const std::vector<Workload> all = {
      {"bunny-teapot",
       "bunny-teapot",
       "bunny-teapot.csv",
       {phase("free", {{1, 350}, {1620, 1750}}), phase("pressing", {{400, 800}}), phase("sliding", {{800, 1500}}),
        phase("knocking", {{1750, 2000}})}},
      {"ear-handle",
       "bunny-teapot",
       "ear-handle.toml",
       {phase("pressed to the rim", {{500, 2000}}), phase("ear in handle", {{2000, 3200}}),
        phase("deeper and out", {{3200, 4001}})}},
      {"peg-hole",
       "peg-hole",
       "peg-hole.toml",
       {phase("free", {{1, 250}}), phase("going in", {{300, 900}}), phase("pressed, twisted", {{900, 1900}}),
        phase("tilted", {{1900, 2700}}), phase("on the bottom", {{2700, 3400}})}},
      {"bunny-plate",
       "bunny-plate",
       "through-plate.toml",
       {phase("pressed, moved along", {{400, 1200}}), phase("shot at the plate", {{1500, 2800}})}},
  };
  return all;
}

std::vector<Pose> device_poses(const Workload& workload, const std::filesystem::path& scenes) {
  constexpr double kPeriod = 1e-3;  // of these scenes [s]
  return path::read_poses(scenes / "paths" / workload.path, kPeriod);
}

std::string Pipeline::name() const {
  return fmt::format("{}{}", format::kSolverNames[static_cast<std::size_t>(solver)], friction ? ", friction" : "");
}

std::vector<Pipeline> pipelines(const SceneView& scene) {
  std::vector<Pipeline> held;
  for (const Solver solver : {Solver::kContact, Solver::kCorrected, Solver::kPaper}) {
    if (!scene.holds(solver)) continue;
    held.push_back({solver, false});
    if (scene.settings.friction != 0) held.push_back({solver, true});
  }
  return held;
}

}  // namespace godobject::bench
