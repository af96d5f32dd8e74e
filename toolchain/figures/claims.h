#pragma once

#include <string>
#include <vector>

#include "toolchain/figures/statistics.h"

namespace godobject::figures {

/// Judges the results by the claims of the paper (section 4): the god object penetrates less than one voxel, and goes
/// less than one voxel behind the scene's barrier, if there is one; steps #2-#7 take "only around 5 us" in contact
/// (compared with the 99th percentile); #1-#7 always take less than 1 ms. The solver `contact` claims no penetration at
/// all. Returns one sentence for each claim that an entry misses, then one sentence per solver with the claims that all
/// its entries hold.
std::vector<std::string> judge(const std::vector<Entry>& entries);

}  // namespace godobject::figures
