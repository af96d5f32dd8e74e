#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/figures/arm_figure.h"
#include "toolchain/figures/arm_run.h"
#include "toolchain/figures/figure.h"
#include "toolchain/figures/plan.h"
#include "toolchain/figures/statistics.h"

namespace godobject::figures {

/// The content of the page. The figures are those of the plan, in its order; verdicts are sentences.
struct PageContent {
  Plan plan;
  std::vector<Figure> figures;
  std::vector<Entry> entries;
  std::vector<std::string> verdicts;
  std::vector<ArmFigure> arm_figures;
  std::vector<ArmRun> runs;
  std::vector<std::string> run_verdicts;
};

/// Returns the static HTML page for `folder`: a description of the solvers, the table, the verdicts, and for each scene
/// its figure, the pictures in its folder (PNG, by moment) with depth and force at their moment, and its replays; then
/// links to the studies, and the same for the runs on an arm.
std::string page(const PageContent& content, const std::filesystem::path& folder);

}  // namespace godobject::figures
