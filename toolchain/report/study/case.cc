#include "toolchain/report/study/case.h"

#include <cstdlib>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "toolchain/files/atomic_file.h"

namespace godobject::report {

std::string cell(double value) { return fmt::format("{}", value); }

double number(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return end == cell.c_str() ? std::numeric_limits<double>::quiet_NaN() : value;
}

std::string csv_text(std::string text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
  return fmt::format("\"{}\"", text);
}

std::string csv(const Sheet& sheet) {
  std::string text = fmt::format("{}\n", fmt::join(sheet.columns, ","));
  for (const auto& row : sheet.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text += fmt::format("{}{}", i == 0 ? "" : ",", csv_text(row[i]));
    text += "\n";
  }
  return text;
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  files::AtomicFile out(file);
  out.write(text);
  out.commit();
}

Sheet gathered(const std::vector<CaseOutcome>& outcomes, const std::string& name) {
  Sheet all{.name = name, .columns = {}, .rows = {}};
  for (const CaseOutcome& outcome : outcomes) {
    if (outcome.result == nullptr) continue;
    for (const Sheet& sheet : outcome.result->sheets) {
      if (sheet.name != name) continue;
      all.columns = sheet.columns;
      all.rows.insert(all.rows.end(), sheet.rows.begin(), sheet.rows.end());
    }
  }
  return all;
}

std::vector<Finding> not_run(const std::vector<CaseOutcome>& outcomes) {
  std::vector<Finding> findings;
  for (const CaseOutcome& outcome : outcomes) {
    if (outcome.result != nullptr) continue;
    findings.push_back({.row = outcome.study_case->name, .what = "the case", .unit = "", .not_judged = "not run"});
  }
  return findings;
}

Section gather(const std::vector<CaseOutcome>& outcomes, const std::filesystem::path& folder) {
  Section section;
  std::set<std::string> names;
  for (const CaseOutcome& outcome : outcomes) {
    if (outcome.result == nullptr) continue;
    section.findings.insert(section.findings.end(), outcome.result->findings.begin(), outcome.result->findings.end());
    for (const Sheet& sheet : outcome.result->sheets) names.insert(sheet.name);
  }
  section.findings = worst_of(section.findings);
  const std::vector<Finding> missing = not_run(outcomes);
  section.findings.insert(section.findings.end(), missing.begin(), missing.end());
  for (const std::string& name : names) {
    write_file(folder / (name + ".csv"), csv(gathered(outcomes, name)));
  }
  return section;
}

}  // namespace godobject::report
