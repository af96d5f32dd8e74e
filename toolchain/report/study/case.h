#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "toolchain/report/study/finding.h"

namespace godobject::report {

/// A table of texts; numbers as `cell` writes them.
struct Sheet {
  std::string name;  ///< that of its CSV file
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// A number so that it reads back as the same.
std::string cell(double value);
double number(const std::string& cell);

/// Text as a cell of a CSV file: in quotes where it needs them.
std::string csv_text(std::string text);

/// A whole file, or none. Throws Failure (kIo, kNoPermission).
void write_file(const std::filesystem::path& file, const std::string& text);

/// Columns, then a line for each row.
std::string csv(const Sheet& sheet);

struct CaseResult {
  std::vector<Finding> findings;
  std::vector<Sheet> sheets;
};

/// A piece of the study that needs no other one.
struct StudyCase {
  std::string name;    ///< of letters, digits, '.', '-', '_': that of its result file
  std::string inputs;  ///< all that the result depends on beside the program, as text
  /// `work` is a folder of its own that is gone afterwards. May run beside others in a thread of its own.
  std::function<CaseResult(const std::filesystem::path& work)> run;
  double seconds = 1.0;      ///< that it takes, about: what takes longest is begun first
  bool takes_times = false;  ///< by the clock: begun when nothing else runs
};

/// A picture of the page.
struct Picture {
  std::string name;  ///< of its file, without ".png"
  std::string caption;
  /// A program for gnuplot that writes `png`.
  std::function<std::string(const std::filesystem::path& png)> program;
};

/// What a chapter has come to.
struct Section {
  std::vector<Finding> findings;  ///< the chapter's verdicts
  std::vector<Picture> pictures;
  std::string html;  ///< goes on the page as it is, behind the verdicts
  std::string text;  ///< for a terminal
};

/// A case of a chapter, and what it has given; null where it was not run.
struct CaseOutcome {
  const StudyCase* study_case = nullptr;
  const CaseResult* result = nullptr;
};

struct Chapter {
  std::string name;
  std::string title;
  std::string introduction;  ///< HTML
  std::vector<StudyCase> cases;
  /// Writes the chapter's files into the folder. `outcomes` are those of `cases`, in their order.
  std::function<Section(const std::vector<CaseOutcome>& outcomes, const std::filesystem::path& folder)> conclude;
};

/// Rows of the sheets of one name, in the order of the cases.
Sheet gathered(const std::vector<CaseOutcome>& outcomes, const std::string& name);

/// A finding for each case without a result.
std::vector<Finding> not_run(const std::vector<CaseOutcome>& outcomes);

/// What most chapters come to: the worst of all findings, "not run" for cases without result, and a CSV file for each
/// sheet.
Section gather(const std::vector<CaseOutcome>& outcomes, const std::filesystem::path& folder);

}  // namespace godobject::report
