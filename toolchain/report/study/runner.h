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

/// How far a run is.
struct RunProgress {
  std::string chapter;        ///< of the case begun last
  double done = 0.0;          ///< share of the time that all cases take
  double seconds_left = 0.0;  ///< by the pace so far
};

struct RunRequest {
  std::filesystem::path folder;                      ///< of the result files; must be there
  int threads = 1;                                   ///< cases at the same time
  std::function<void(const RunProgress&)> progress;  ///< called on this thread only; may be empty
};

/// As they are run: what takes longest first, and what takes times last.
std::vector<const StudyCase*> in_running_order(std::span<const StudyCase* const> cases);

/// Those that have no result file of this program and their inputs in the folder, in running order.
std::vector<const StudyCase*> without_result(std::span<const StudyCase* const> cases,
                                             const std::filesystem::path& folder);

/// Runs each case without a result and writes it, in running order; those that take times one by one. What a case
/// throws ends the run when those under way are finished, and is thrown on; their results stay.
void run_cases(std::span<const StudyCase* const> cases, const RunRequest& request);

}  // namespace godobject::report
