#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "toolchain/report/fault_table/results.h"

namespace godobject::report {

struct FaultTableRequest {
  std::filesystem::path output;                                       ///< folder; made where it is not there
  std::filesystem::path tests;                                        ///< folder of the project's test programs
  std::function<void(std::string_view phase, double done)> progress;  ///< may be empty
};

/// Runs the tests that inject faults, writes OUTPUT/faults.csv and OUTPUT/faults.html and returns the rows. What a test
/// or its program fails with is in them. Throws Failure: kNoInput where a program is not there.
std::vector<FaultRow> fault_table(const FaultTableRequest& request);

}  // namespace godobject::report
