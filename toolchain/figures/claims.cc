#include "toolchain/figures/claims.h"

#include <fmt/format.h>

namespace godobject::figures {
namespace {

constexpr double kSolve_us = 5.0;

}  // namespace

std::vector<std::string> judge(const std::vector<Entry>& entries) {
  std::vector<std::string> depth;
  std::vector<std::string> solve;
  std::vector<std::string> cycle;
  for (const Entry& e : entries) {
    const Statistics& s = e.statistics;
    const std::string who = fmt::format("{}, solver {}", e.scene, e.solver);
    if (s.penetration_max >= e.voxel_size) {
      depth.push_back(fmt::format(
          "MISSED {}: the god object penetrates {} {:.2f} mm, {:.1f} voxels, at {:.3f} s (paper: below one voxel)", who,
          s.depth_is_bound ? "at least" : "up to", 1e3 * s.penetration_max, s.penetration_max / e.voxel_size,
          s.penetration_at));
    }
    if (e.crossing && e.crossing->distance >= e.voxel_size) {
      depth.push_back(fmt::format(
          "MISSED {}: the god object goes {:.1f} mm behind the surface, at {:.3f} s (paper: it does not pop through)",
          who, 1e3 * e.crossing->distance, e.crossing->t));
    }
    if (s.solve.p99 > kSolve_us) {
      solve.push_back(fmt::format(
          "MISSED {}: steps #2-#7 take {:.2f} us in the median, {:.2f} us in the 99th percentile (paper: around 5 us)",
          who, s.solve.p50, s.solve.p99));
    }
    if (s.over_1ms > 0) {
      cycle.push_back(fmt::format(
          "MISSED {}: {} of {} cycles took longer than 1 ms (paper: none; a machine without real-time scheduling can "
          "do that by itself)",
          who, s.over_1ms, s.cycles));
    }
  }
  std::string met;
  if (depth.empty()) met += " penetration below one voxel;";
  if (solve.empty()) met += " steps #2-#7 within 5 us (99th percentile);";
  if (cycle.empty()) met += " every cycle below 1 ms;";
  std::vector<std::string> sentences = std::move(depth);
  sentences.insert(sentences.end(), solve.begin(), solve.end());
  sentences.insert(sentences.end(), cycle.begin(), cycle.end());
  if (!met.empty()) sentences.push_back(fmt::format("Met by every scene and solver:{}", met.substr(0, met.size() - 1)));
  return sentences;
}

}  // namespace godobject::figures
