#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/figures/figure.h"
#include "toolchain/figures/plan.h"
#include "toolchain/figures/statistics.h"

namespace godobject::figures {

/// The static HTML page over `folder`: what the solvers are, table, verdicts, and for each scene its figure, the
/// pictures found in its folder (PNG, by moment) with depth and force at their moment, and its replays. `figures` are
/// those of the plans, in the same order.
std::string page(const std::vector<ScenePlan>& plans, const std::vector<Figure>& figures,
                 const std::vector<Entry>& entries, const std::vector<std::string>& verdicts,
                 const std::filesystem::path& folder);

}  // namespace godobject::figures
