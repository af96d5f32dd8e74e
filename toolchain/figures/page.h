#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/figures/arm_figure.h"
#include "toolchain/figures/arm_run.h"
#include "toolchain/figures/claims.h"
#include "toolchain/figures/figure.h"
#include "toolchain/figures/plan.h"
#include "toolchain/figures/statistics.h"

namespace godobject::figures {

/// The content of the page. The figures are those of the plan, in its order; verdicts are sentences.
struct PageContent {
  Plan plan;
  std::vector<Figure> figures;
  std::vector<Entry> entries;
  Verdicts verdicts;
  std::vector<ArmFigure> arm_figures;
  std::vector<ArmRun> runs;
  std::vector<std::string> run_verdicts;
  /// Folder of the replays and of the logs of runs, to which the page links; empty: the folder of the page.
  std::filesystem::path logs = {};
};

/// Returns the static HTML page for `folder`. It begins with a moving picture of the first scene, if its folder has one
/// (replay.html), and the verdicts on the solver `contact` and on the runs on an arm. For each scene follow its figure,
/// the pictures in its folder (PNG, by moment) with depth and force at their moment, and its replays; the same for each
/// run, before the scenes; then links to the studies, the table of the replays with the verdicts on the other solvers,
/// and those on times.
std::string page(const PageContent& content, const std::filesystem::path& folder);

}  // namespace godobject::figures
