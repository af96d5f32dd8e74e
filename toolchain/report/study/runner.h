#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "toolchain/report/study/case.h"
#include "toolchain/report/study/result_file.h"

namespace godobject::report {

/// Progress of a run.
struct RunProgress {
  std::string chapter;        ///< chapter of the case that began last
  double done = 0.0;          ///< completed share of the time of all cases
  double seconds_left = 0.0;  ///< estimate by the pace so far
};

struct RunRequest {
  std::filesystem::path folder;                      ///< folder of the result files; must exist
  int threads = 1;                                   ///< cases at the same time
  std::function<void(const RunProgress&)> progress;  ///< called on this thread only; may be empty
};

/// Returns the cases in the order of a run: long ones first; those that measure run times last.
std::vector<const StudyCase*> in_running_order(std::span<const StudyCase* const> cases);

/// Returns the cases without a result of this program and their inputs in the folder, in running order.
std::vector<const StudyCase*> without_result(std::span<const StudyCase* const> cases,
                                             const std::filesystem::path& folder);

/// Runs each case without a result, in running order, and writes its result. Cases that measure run times run one by
/// one. An exception of a case ends the run after the running cases, whose results remain, and is rethrown.
void run_cases(std::span<const StudyCase* const> cases, const RunRequest& request);

}  // namespace godobject::report
