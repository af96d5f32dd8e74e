#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/figures/plan.h"
#include "toolchain/figures/statistics.h"

namespace godobject::figures {

/// The static HTML page over `folder`: table, verdicts, and for each scene its figure, the pictures found in its folder
/// (PNG, by name) and its replays.
std::string page(const std::vector<ScenePlan>& plans, const std::vector<Entry>& entries,
                 const std::vector<std::string>& verdicts, const std::filesystem::path& folder);

}  // namespace godobject::figures
