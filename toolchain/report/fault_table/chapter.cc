#include "toolchain/report/fault_table/chapter.h"

#include <map>

#include <fmt/format.h>

#include "toolchain/command_line/external_program.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"
#include "toolchain/report/fault_table/results.h"
#include "toolchain/report/study/result_file.h"

namespace godobject::report {
namespace {

/// Returns the tests of each program.
std::map<std::string, std::vector<std::string>> programs() {
  std::map<std::string, std::vector<std::string>> found;
  for (const Requirement& requirement : requirements()) {
    for (const Injection& injection : requirement.injections) {
      found[injection.program].push_back(injection.test);
    }
  }
  return found;
}

/// Runs tests of a program and returns their records; if the program dies, with the reason.
std::vector<TestResult> run(const std::filesystem::path& program, const std::vector<std::string>& tests,
                            const std::filesystem::path& results) {
  std::string died;
  try {
    command::run_program(
        {std::filesystem::absolute(program).string(), fmt::format("--gtest_filter={}", fmt::join(tests, ":")),
         "--gtest_output=json:" + results.string()},
        "");
  } catch (const command::Failure& failure) {
    died = failure.what();
  }
  if (std::filesystem::exists(results)) return read_test_results(results);
  std::vector<TestResult> none;
  for (const std::string& test : tests) none.push_back({.test = test, .ran = true, .why_not = died});
  return none;
}

std::vector<TestResult> read_hil_cases(const std::filesystem::path& tests, const std::vector<std::string>& names) {
  std::vector<TestResult> results;
  for (const std::string& name : names) results.push_back(read_hil_case(tests, name));
  return results;
}

const char* const kSheet = "fault_tests";
const char* const kVirtualMachine = "hil";

Sheet sheet_of(const std::string& program, const std::vector<TestResult>& results) {
  Sheet sheet{.name = kSheet,
              .columns = {"program", "test", "ran", "passed", "why_not", "reaction", "found", "after", "cycles"},
              .rows = {}};
  for (const TestResult& r : results) {
    sheet.rows.push_back({program, r.test, r.ran ? "1" : "0", r.passed ? "1" : "0", r.why_not, r.reaction, r.found,
                          r.after, std::to_string(r.cycles)});
  }
  return sheet;
}

std::map<std::string, TestResult> results_of(const Sheet& sheet) {
  std::map<std::string, TestResult> results;  // by program and test
  for (const auto& row : sheet.rows) {
    results[row[0] + ' ' + row[1]] = {.test = row[1],
                                      .ran = row[2] == "1",
                                      .passed = row[3] == "1",
                                      .why_not = row[4],
                                      .reaction = row[5],
                                      .found = row[6],
                                      .after = row[7],
                                      .cycles = std::stoi(row[8])};
  }
  return results;
}

Bound bound_of(const Requirement& requirement) {
  return {requirement.fault, "injections with another reaction than: " + requirement.reaction, "", 0.0};
}

Finding finding_of(const FaultRow& row) {
  const bool missed = row.verdict == FaultVerdict::kMissed;
  Finding finding = judged(bound_of(row.requirement), missed ? 1.0 : 0.0, missed ? row.result.test : "");
  if (row.verdict == FaultVerdict::kNotRun || row.verdict == FaultVerdict::kNotCovered) {
    finding.not_judged = name(row.verdict);
  }
  return finding;
}

Section conclude(const std::vector<CaseOutcome>& outcomes, const std::filesystem::path& folder) {
  const auto results = results_of(gathered(outcomes, kSheet));
  std::vector<FaultRow> rows;
  for (const Requirement& requirement : requirements()) {
    if (requirement.injections.empty()) rows.push_back({.requirement = requirement});
    for (const Injection& injection : requirement.injections) {
      FaultRow row{.requirement = requirement, .injection = injection};
      const auto found = results.find(injection.program + ' ' + injection.test);
      row.result = found != results.end()
                       ? found->second
                       : TestResult{.test = injection.test, .why_not = "the program has no such test"};
      row.verdict = judge(requirement, row.result);
      rows.push_back(row);
    }
  }
  write_file(folder / "faults.csv", fault_csv(rows));
  write_file(folder / "faults.html", fault_page(rows, fmt::format("Made by godobject-report on {}.", this_machine())));
  Section section;
  for (const FaultRow& row : rows) section.findings.push_back(finding_of(row));
  section.findings = worst_of(section.findings);
  section.text = fault_summary(rows) + "\n";
  section.html = "<p>All injections: <a href=\"faults.html\">table</a>, <a href=\"faults.csv\">CSV</a>.</p>\n";
  return section;
}

/// Returns the inputs of a case: the test program, or the results of a session of the virtual machine.
std::string inputs_of(const std::filesystem::path& tests, const std::string& program,
                      const std::vector<std::string>& names) {
  if (program != kVirtualMachine) return file_digest(tests / program);
  return csv(sheet_of(program, read_hil_cases(tests, names)));
}

}  // namespace

Chapter fault_chapter(const std::filesystem::path& tests) {
  Chapter chapter{
      .name = "faults",
      .title = "Injected faults",
      .introduction = "<p>Reactions of the controller to faults, measured by the tests that inject them.</p>",
      .cases = {},
      .conclude = conclude};
  for (const Requirement& requirement : requirements()) chapter.bounds.push_back(bound_of(requirement));
  for (const auto& [program, names] : programs()) {
    if (program != kVirtualMachine) {
      files::require_regular_input(tests / program, "build it, and name its folder with --tests");
    }
    chapter.cases.push_back({.name = "faults." + program,
                             .inputs = inputs_of(tests, program, names),
                             .run =
                                 [tests, program = program, names = names](const std::filesystem::path& work) {
                                   const auto results = program == kVirtualMachine
                                                            ? read_hil_cases(tests, names)
                                                            : run(tests / program, names, work / (program + ".json"));
                                   return CaseResult{.findings = {}, .sheets = {sheet_of(program, results)}};
                                 },
                             .seconds = 8.0});
  }
  return chapter;
}

}  // namespace godobject::report
