#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "toolchain/bench/brute_force.h"
#include "toolchain/bench/chapters.h"
#include "toolchain/bench/cycle_times.h"
#include "toolchain/bench/peers.h"
#include "toolchain/bench/workload.h"

namespace godobject::bench {
namespace {

/// Points and voxel size of one scene in which the bunny slides on the teapot.
struct Scale {
  std::uint32_t points;
  double voxel_size;  ///< [m]
};

/// Returns the levels with which each node of the tree has as many children as with 5587 points in 7 levels.
int levels_for(std::uint32_t points) {
  return static_cast<int>(std::lround(7.0 * std::log(static_cast<double>(points)) / std::log(5587.0)));
}

std::string scene_text(const Scale& scale, const std::filesystem::path& scenes) {
  const auto mesh = [&](const char* name) { return std::filesystem::absolute(scenes / "meshes" / name).string(); };
  return fmt::format(
      "[still]\nmesh = \"{}\"\nscale = 0.037\nvoxel_size = {}\n"
      "[moving]\nmesh = \"{}\"\nscale = 0.0161497\npoints = {}\nlevels = {}\n"
      "[contact]\nboth_directions = false\n"
      "[friction]\nstatic = 0.2\nkinetic = 0.18\n",
      mesh("teapot.ply"), scale.voxel_size, mesh("bunny_npm.ply"), scale.points, levels_for(scale.points));
}

/// Quantiles of one scale [ns].
struct Found {
  std::size_t points = 0;
  Distribution plain, friction, own_plain, own_friction, step1, cold;
  Distribution brute, brute_cold;
  std::string brute_name = "-";
};

/// Dense grids above this size are not measured.
constexpr double kMostGridBytes = 1e9;

double grid_bytes(const SceneView& scene) {
  double nodes = 1.0;
  for (int k = 0; k < 3; ++k) {
    nodes *= 4.0 + (scene.grid.surface_max[k] - scene.grid.surface_min[k]) / scene.grid.voxel_size;
  }
  return sizeof(float) * nodes;
}

Found measure(const SceneView& scene, std::span<const Pose> device, const Phase& phase, bool full) {
  const PassBudget budget{.least_passes = full ? 2u : 1u, .most_passes = 40, .seconds = full ? 3.0 : 0.3};
  const std::vector<std::size_t> cold_cycles = thinned(phase.cycles, full ? 200 : 25);
  Found found;
  found.points = scene.pointshell.size;
  const Pipeline friction{Solver::kContact, true};
  {
    const CycleTimes plain = time_cycles(scene, {Solver::kContact, false}, device, budget);
    const CycleTimes times = time_cycles(scene, friction, device, budget);
    found.plain = plain.whole.all(phase.cycles);
    found.own_plain = plain.whole.least(phase.cycles);
    found.friction = times.whole.all(phase.cycles);
    found.own_friction = times.whole.least(phase.cycles);
    found.step1 = times.step1.all(phase.cycles);
  }
  found.cold = distribution(time_cold_cycles(scene, friction, device, cold_cycles));
  if (grid_bytes(scene) > kMostGridBytes) return found;
  const Recording recording = record(scene, friction, device);
  BruteForce brute(scene, kLeastReach * scene.grid.voxel_size);
  std::vector<Pose> poses;
  for (const std::size_t i : phase.cycles) poses.push_back(recording.H_WS[i]);
  std::vector<std::size_t> every(poses.size());
  for (std::size_t i = 0; i < every.size(); ++i) every[i] = i;
  for (const NamedScan& scan : runnable_scans()) {
    const Distribution times = time_scan(brute, scan.scan, poses, budget).all(every);
    if (found.brute.count > 0 && times.p50 >= found.brute.p50) continue;
    found.brute = times;
    found.brute_name = scan.name;
    found.brute_cold = distribution(time_cold_scan(brute, scan.scan, recording.H_WS, cold_cycles));
  }
  return found;
}

std::vector<std::string> row(const Scale& scale, const Found& found) {
  const auto us = [](const Distribution& d, double Distribution::*quantile) {
    return d.count == 0 ? std::string("-") : digits(1e-3 * (d.*quantile));
  };
  return {std::to_string(found.points),
          fmt::format("{:g} mm", 1e3 * scale.voxel_size),
          us(found.plain, &Distribution::p50),
          us(found.plain, &Distribution::p999),
          us(found.own_plain, &Distribution::p999),
          us(found.friction, &Distribution::p50),
          us(found.friction, &Distribution::p999),
          us(found.own_friction, &Distribution::p999),
          us(found.cold, &Distribution::p50),
          us(found.step1, &Distribution::p50),
          us(found.brute, &Distribution::p50),
          us(found.brute, &Distribution::p999),
          us(found.brute_cold, &Distribution::p50),
          found.brute_name};
}

}  // namespace

Chapter scaling_chapter(const BenchRequest& request) {
  const SceneCache cache(request.cache);
  const Workload& workload = workloads().front();
  const auto sliding = std::find_if(workload.phases.begin(), workload.phases.end(),
                                    [](const Phase& phase) { return phase.name == "sliding"; });
  std::vector<Pose> device = device_poses(workload, request.scenes);
  device.resize(sliding->cycles.back() + 1);

  std::vector<Scale> scales = {{1000, 0.002}, {10000, 0.002}, {100000, 0.002}, {5587, 0.002}, {5587, 0.001}};
  if (request.full) {
    scales.insert(scales.begin() + 3, {1000000, 0.002});
    scales.push_back({5587, 0.0005});
    scales.push_back({5587, 0.00025});
  }
  Chapter chapter;
  Table table{
      .name = "scaling",
      .title = "The bunny slides on the teapot: more points, smaller voxels; contact, one direction [us]",
      .columns = {"points", "voxel", "cycle p50", "p99.9", "own p99.9", "with friction p50", "p99.9", "own p99.9",
                  "cold p50", "#1 p50", "brute p50", "brute p99.9", "brute cold p50", "best brute force"},
      .rows = {},
      .note = request.full ? "" : "--full adds 10^6 points and voxels of 0.5 and 0.25 mm."};
  Plot by_points{.name = "scaling_points",
                 .title = "Sliding, voxels of 2 mm: more points",
                 .x_label = "points",
                 .y_label = "median [us]",
                 .curves = {{"cycle, friction", {}, {}},
                            {"cycle, friction, cold", {}, {}},
                            {"brute force", {}, {}},
                            {"brute force, cold", {}, {}}}};
  Plot by_voxels = by_points;
  by_voxels.name = "scaling_voxels";
  by_voxels.title = "Sliding, 5587 points: smaller voxels";
  by_voxels.x_label = "voxel [mm]";
  double ten_thousand_ns = 0.0;
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const Scale& scale = scales[i];
    const auto image = cache.image_of_text(fmt::format("sliding-{}-{:g}mm", scale.points, 1e3 * scale.voxel_size),
                                           scene_text(scale, request.scenes), request.progress);
    request.progress("scaling", static_cast<double>(i) / static_cast<double>(scales.size()));
    const Found found = measure(image.scene, device, *sliding, request.full);
    table.rows.push_back(row(scale, found));
    if (scale.points == 10000) ten_thousand_ns = found.friction.p50;
    if (scale.points == 1000000) {
      chapter.targets.push_back(
          {"sliding, 10^6 points: cycle with friction, p99.9", "us", 40.0, 1e-3 * found.friction.p999, false});
      chapter.targets.push_back(
          {"sliding, 10^6 points: cycle with friction, own p99.9", "us", 40.0, 1e-3 * found.own_friction.p999, false});
      chapter.targets.push_back(
          {"sliding, p50: 10^6 points over 10^4", "1", 4.0, found.friction.p50 / ten_thousand_ns, false});
    }
    const bool voxels = scale.points == 5587;
    Plot& plot = voxels ? by_voxels : by_points;
    const Distribution* const shown[] = {&found.friction, &found.cold, &found.brute, &found.brute_cold};
    for (std::size_t c = 0; c < plot.curves.size(); ++c) {
      if (shown[c]->count == 0) continue;
      plot.curves[c].x.push_back(voxels ? 1e3 * scale.voxel_size : static_cast<double>(found.points));
      plot.curves[c].y.push_back(1e-3 * shown[c]->p50);
    }
  }
  chapter.tables.push_back(std::move(table));
  chapter.plots = {std::move(by_points), std::move(by_voxels)};
  return chapter;
}

}  // namespace godobject::bench
