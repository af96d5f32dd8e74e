#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/report/study/case.h"
#include "toolchain/report/study/known_misses.h"
#include "toolchain/report/study/runner.h"

namespace godobject::report {

/// Returns FOLDER/cases, the folder of the result files.
std::filesystem::path case_folder(const std::filesystem::path& folder);

/// Returns FOLDER/kept, the folder of files that several cases share. It may be removed at any time; cases make it
/// again.
std::filesystem::path kept_folder(const std::filesystem::path& folder);

/// Returns FOLDER/report.html.
std::filesystem::path report_file(const std::filesystem::path& folder);

/// Returns all cases in their order.
std::vector<const StudyCase*> all_cases(const std::vector<Chapter>& chapters);

/// Returns the case of that name. Throws Failure (kUsage).
const StudyCase& find_case(const std::vector<Chapter>& chapters, const std::string& name);

struct Merged {
  std::string text;  ///< for a terminal
  std::vector<PageVerdict> verdicts;
};

/// Reads the result files of FOLDER that match the present inputs, and writes each chapter's files, the pictures,
/// FOLDER/verdicts.csv and FOLDER/report.html. Throws Failure, also if a judged finding is not among its chapter's
/// bounds.
Merged merge(const std::vector<Chapter>& chapters, const std::filesystem::path& folder,
             const std::string& what_was_run);

}  // namespace godobject::report
