#include "toolchain/figures/claims.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace godobject::figures {
namespace {

constexpr double kSolve_us = 5.0;
constexpr std::string_view kDefault = "contact";  // the default solver

/// A claim on a solver's run in a scene. `missed` tells by how much the run misses it; empty: the claim holds.
struct Claim {
  std::string (*missed)(const Entry& entry);
  std::string (*holds)(const std::vector<const Entry*>& entries);  ///< the claim in words; empty: not tested
  /// Only for claims that depend on the machine's load: the size of the miss. Such a claim gets one sentence per
  /// solver, about its worst scene.
  double (*size)(const Entry& entry) = nullptr;
};

std::string penetration(const Entry& e) {
  const Statistics& s = e.statistics;
  if (e.solver == "contact" ? s.penetration_max <= 0.0 : s.penetration_max < e.voxel_size) return "";
  return fmt::format("a sample point of the god object is {} {:.3f} mm, {:.2f} voxels, inside, at {:.3f} s ({})",
                     s.depth_is_bound ? "at least" : "up to", 1e3 * s.penetration_max, s.penetration_max / e.voxel_size,
                     s.penetration_at, e.solver == "contact" ? "contact: none is inside" : "paper: below one voxel");
}

std::string penetration_holds(const std::vector<const Entry*>& entries) {
  const auto deeper = [](const Entry* a, const Entry* b) {
    return a->statistics.penetration_max < b->statistics.penetration_max;
  };
  const double deepest = (*std::max_element(entries.begin(), entries.end(), deeper))->statistics.penetration_max;
  if (deepest > 0.0) return "sample points less than one voxel inside";
  return fmt::format("no sample point inside, the nearest is {:.4f} mm from the surface", -1e3 * deepest);
}

std::string pop_through(const Entry& e) {
  if (!e.crossing || e.crossing->distance < e.voxel_size) return "";
  return fmt::format("the god object goes {:.1f} mm behind the surface, at {:.3f} s (paper: it does not pop through)",
                     1e3 * e.crossing->distance, e.crossing->t);
}

std::string pop_through_holds(const std::vector<const Entry*>& entries) {
  const bool shown =
      std::any_of(entries.begin(), entries.end(), [](const Entry* e) { return e->crossing.has_value(); });
  return shown ? "no pop-through" : "";
}

std::string solve_time(const Entry& e) {
  const Times& solve = e.statistics.solve;
  if (solve.p99 <= kSolve_us) return "";
  return fmt::format(
      "steps #2-#7 take {:.2f} us in the median, {:.2f} us in the 99th percentile (paper: around 5 us; a "
      "busy machine takes longer)",
      solve.p50, solve.p99);
}

std::string cycle_time(const Entry& e) {
  const Statistics& s = e.statistics;
  if (s.over_1ms == 0) return "";
  return fmt::format(
      "{} of {} cycles took longer than 1 ms (paper: none; without real-time scheduling the machine alone can cause "
      "this)",
      s.over_1ms, s.cycles);
}

constexpr Claim kClaims[] = {
    {penetration, penetration_holds},
    {pop_through, pop_through_holds},
    {solve_time, [](const std::vector<const Entry*>&) { return std::string("#2-#7 within 5 us (99th percentile)"); },
     [](const Entry& e) { return e.statistics.solve.p99; }},
    {cycle_time, [](const std::vector<const Entry*>&) { return std::string("every cycle below 1 ms"); },
     [](const Entry& e) { return static_cast<double>(e.statistics.over_1ms); }},
};

/// Returns a sentence about one solver: the scenes in which it misses the claim, and the size of the worst miss.
std::string missed_most(const Claim& claim, const std::vector<const Entry*>& entries) {
  std::vector<std::string_view> scenes;
  const Entry* worst = nullptr;
  for (const Entry* e : entries) {
    if (claim.missed(*e).empty()) continue;
    scenes.push_back(e->scene);
    if (worst == nullptr || claim.size(*e) > claim.size(*worst)) worst = e;
  }
  if (worst == nullptr) return "";
  const std::string where = scenes.size() == 1 ? "" : fmt::format("in {} ", worst->scene);
  return fmt::format("MISSED {}, solver {}: {}{}", fmt::join(scenes, ", "), worst->solver, where, claim.missed(*worst));
}

/// Returns those of the claims that one solver holds in all of its scenes; empty: none. `of_time`: the claims on times,
/// or the others.
std::string held(bool of_time, const std::vector<const Entry*>& entries) {
  std::vector<std::string> words;
  for (const Claim& claim : kClaims) {
    if (of_time != (claim.size != nullptr)) continue;
    const bool missed =
        std::any_of(entries.begin(), entries.end(), [&](const Entry* e) { return !claim.missed(*e).empty(); });
    std::string word = missed ? "" : claim.holds(entries);
    if (!word.empty()) words.push_back(std::move(word));
  }
  return fmt::format("{}", fmt::join(words, "; "));
}

/// Returns the sentences about one solver: missed claims, then those that hold.
std::vector<std::string> judge_solver(bool of_time, const std::vector<const Entry*>& entries) {
  std::vector<std::string> sentences;
  for (const Claim& claim : kClaims) {
    if (of_time != (claim.size != nullptr)) continue;
    if (of_time) {
      std::string sentence = missed_most(claim, entries);
      if (!sentence.empty()) sentences.push_back(std::move(sentence));
      continue;
    }
    for (const Entry* e : entries) {
      const std::string what = claim.missed(*e);
      if (!what.empty()) sentences.push_back(fmt::format("MISSED {}, solver {}: {}", e->scene, e->solver, what));
    }
  }
  const std::string holds = held(of_time, entries);
  if (!holds.empty())
    sentences.push_back(fmt::format("HOLDS in every scene, solver {}: {}", entries.front()->solver, holds));
  return sentences;
}

}  // namespace

Verdicts judge(const std::vector<Entry>& entries) {
  std::vector<std::string_view> solvers;
  for (const Entry& e : entries) {
    if (std::find(solvers.begin(), solvers.end(), e.solver) == solvers.end()) solvers.push_back(e.solver);
  }
  std::stable_partition(solvers.begin(), solvers.end(), [](std::string_view solver) { return solver == kDefault; });
  Verdicts verdicts;
  const auto append = [](std::vector<std::string>& to, const std::vector<std::string>& sentences) {
    to.insert(to.end(), sentences.begin(), sentences.end());
  };
  for (const std::string_view solver : solvers) {
    std::vector<const Entry*> own;
    for (const Entry& e : entries) {
      if (e.solver == solver) own.push_back(&e);
    }
    append(solver == kDefault ? verdicts.contact : verdicts.compared, judge_solver(false, own));
    append(verdicts.times, judge_solver(true, own));
  }
  return verdicts;
}

}  // namespace godobject::figures
