#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/report/fault_table/requirements.h"

namespace godobject::report {

enum class FaultVerdict {
  kHeld,
  kMissed,     ///< the test failed, or what it saw is not what must happen
  kNotRun,     ///< there is a test, but it was not run or could not be
  kNotCovered  ///< there is no test
};

const char* name(FaultVerdict verdict);

/// What a test says of itself. One that has passed and says nothing counts as failed.
struct TestResult {
  std::string test;  ///< "Rows/CanFault.StopsInTime/bus_off"
  bool ran = false;
  bool passed = false;
  std::string why_not{};   ///< it did not run or pass, on one line
  std::string reaction{};  ///< empty: the case judges it itself
  std::string found{};
  std::string after{};
  int cycles = -1;
};

/// A row of the table with one of its injections; without `result.test` there is none.
struct FaultRow {
  Requirement requirement;
  Injection injection{};
  TestResult result{};
  FaultVerdict verdict = FaultVerdict::kNotCovered;
};

/// GoogleTest's JSON. Throws Failure (kBadData) naming the file.
std::vector<TestResult> read_test_results(const std::filesystem::path& file);

/// What a session of the virtual machine has left of a case below `tests`/hil.
TestResult read_hil_case(const std::filesystem::path& tests, const std::string& name);

/// Held: the test ran and passed, the reaction is the required one, in no more cycles than are allowed.
FaultVerdict judge(const Requirement& requirement, const TestResult& result);

/// injected,by,fault,required,seen,reaction,cycles,allowed,after,verdict
std::string fault_csv(const std::vector<FaultRow>& rows);

/// The same as a page, after `heading`, a sentence on where it was made.
std::string fault_page(const std::vector<FaultRow>& rows, const std::string& heading);

/// "53 rows of the table: 50 held, 1 missed (node never boots), ..."
std::string fault_summary(const std::vector<FaultRow>& rows);

}  // namespace godobject::report
