#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/report/fault_table/requirements.h"

namespace godobject::report {

enum class FaultVerdict {
  kHeld,
  kMissed,     ///< the test failed, or recorded another reaction than the required one
  kNotRun,     ///< there is a test, but it was not run or could not run
  kNotCovered  ///< there is no test
};

const char* name(FaultVerdict verdict);

/// The record of a test. A test that passes without a record counts as failed.
struct TestResult {
  std::string test;  ///< "Rows/CanFault.StopsInTime/bus_off"
  bool ran = false;
  bool passed = false;
  std::string why_not{};   ///< reason if it did not run or pass, on one line
  std::string reaction{};  ///< empty: the case itself judges it
  std::string found{};
  std::string after{};
  int cycles = -1;
};

/// A row of the table with one of its injections; an empty `result.test` stands for no injection.
struct FaultRow {
  Requirement requirement;
  Injection injection{};
  TestResult result{};
  FaultVerdict verdict = FaultVerdict::kNotCovered;
};

/// Reads GoogleTest's JSON. Throws Failure (kBadData) naming the file.
std::vector<TestResult> read_test_results(const std::filesystem::path& file);

/// Reads the result of a case that a session of the virtual machine has left below `tests`/hil.
TestResult read_hil_case(const std::filesystem::path& tests, const std::string& name);

/// Returns "held" if the test ran and passed with the required reaction in the allowed number of cycles.
FaultVerdict judge(const Requirement& requirement, const TestResult& result);

/// Returns CSV: injected,by,fault,required,seen,reaction,cycles,allowed,after,verdict
std::string fault_csv(const std::vector<FaultRow>& rows);

/// Returns the rows as a page; `heading` is a sentence on its origin.
std::string fault_page(const std::vector<FaultRow>& rows, const std::string& heading);

/// Returns a summary such as "53 rows, 80 injections: 50 rows held, 1 missed (node never boots)".
std::string fault_summary(const std::vector<FaultRow>& rows);

}  // namespace godobject::report
