#pragma once

#include <string>
#include <vector>

#include "toolchain/figures/statistics.h"

namespace godobject::figures {

/// Judges the results by the claims of the paper (section 4): the god object penetrates less than one voxel, and goes
/// less than one voxel behind the scene's barrier, if there is one; steps #2-#7 take "only around 5 us" in contact
/// (compared with the 99th percentile); #1-#7 always take less than 1 ms. The solver `contact` claims no penetration at
/// all.
///
/// Each list has, for each of its solvers, one sentence for each claim that an entry misses, then one with the claims
/// that all entries of the solver hold. A claim on times has one sentence a solver, about its worst scene.
struct Verdicts {
  std::vector<std::string> contact;   ///< of the default solver, without times
  std::vector<std::string> compared;  ///< of the other solvers, without times
  std::vector<std::string> times;     ///< of all solvers, the default one first; they depend on the machine's load
};
Verdicts judge(const std::vector<Entry>& entries);

}  // namespace godobject::figures
