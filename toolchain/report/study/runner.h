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

struct RunRequest {
  std::filesystem::path folder;                                       ///< of the result files; must be there
  int threads = 1;                                                    ///< cases at the same time
  std::function<void(std::string_view phase, double done)> progress;  ///< called on this thread only; may be empty
};

/// Runs each case that has no result file of this program and its inputs, in their order, and writes it. What a case
/// throws ends the run when those under way are finished, and is thrown on; their results stay.
void run_cases(std::span<const StudyCase* const> cases, const RunRequest& request);

}  // namespace godobject::report
