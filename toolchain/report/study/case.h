#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "toolchain/report/study/bound.h"
#include "toolchain/report/study/finding.h"

namespace godobject::report {

/// A table of texts; `cell` writes its numbers.
struct Sheet {
  std::string name;  ///< name of its CSV file
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// Returns a number as text; `number` reads the same value back.
std::string cell(double value);
double number(const std::string& cell);

/// Returns text as a cell of a CSV file, quoted if necessary.
std::string csv_text(std::string text);

/// Writes a file completely or not at all. Throws Failure (kIo, kNoPermission).
void write_file(const std::filesystem::path& file, const std::string& text);

/// Returns the sheet as CSV: the columns, then a line for each row.
std::string csv(const Sheet& sheet);

struct CaseResult {
  std::vector<Finding> findings;
  std::vector<Sheet> sheets;
};

/// An independent part of the study.
struct StudyCase {
  std::string name;    ///< letters, digits, '.', '-', '_'; name of its result file
  std::string inputs;  ///< all inputs of the result except the program, as text
  /// Runs the case, possibly in a thread beside other cases. `work` is an empty folder, which is removed afterwards.
  std::function<CaseResult(const std::filesystem::path& work)> run;
  double seconds = 1.0;      ///< approximate duration; long cases are begun first
  bool takes_times = false;  ///< measures run times: begun when no other case runs
};

/// A picture of the page.
struct Picture {
  std::string name;  ///< name of its file, without ".png"
  std::string caption;
  /// Returns a gnuplot program that draws the picture into `png`.
  std::function<std::string(const std::filesystem::path& png)> program;
};

/// The results of a chapter.
struct Section {
  std::vector<Finding> findings;  ///< the chapter's verdicts
  std::vector<Picture> pictures;
  std::string html;  ///< inserted in the page after the verdicts
  std::string text;  ///< for a terminal
};

/// A case of a chapter and its result; null if it was not run.
struct CaseOutcome {
  const StudyCase* study_case = nullptr;
  const CaseResult* result = nullptr;
};

struct Chapter {
  std::string name;
  std::string title;
  std::string introduction;        ///< HTML
  std::vector<Bound> bounds = {};  ///< of all judged quantities, also of those that a run omits
  std::vector<StudyCase> cases;
  /// Writes the chapter's files into the folder. `outcomes` are those of `cases`, in their order.
  std::function<Section(const std::vector<CaseOutcome>& outcomes, const std::filesystem::path& folder)> conclude;
};

/// Returns one sheet with the rows of all sheets of this name, in the order of the cases.
Sheet gathered(const std::vector<CaseOutcome>& outcomes, const std::string& name);

/// Returns a finding for each case without a result.
std::vector<Finding> not_run(const std::vector<CaseOutcome>& outcomes);

/// Concludes most chapters: returns the worst of all findings, and "not run" for cases without a result; writes a CSV
/// file for each sheet.
Section gather(const std::vector<CaseOutcome>& outcomes, const std::filesystem::path& folder);

}  // namespace godobject::report
