#include "toolchain/report/fault_table/results.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/html_text.h"
#include "toolchain/report/study/case.h"

namespace godobject::report {
namespace {

using files::html_text;

std::string one_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  constexpr std::size_t kLongest = 200;
  return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TestResult result_of(const nlohmann::json& test) {
  TestResult result;
  result.test = test.at("classname").get<std::string>() + '.' + test.at("name").get<std::string>();
  const auto failures = test.find("failures");
  result.ran = test.at("status") == "RUN" && test.at("result") == "COMPLETED";
  result.passed = result.ran && failures == test.end();
  if (failures != test.end()) result.why_not = one_line(failures->at(0).at("failure").get<std::string>());
  if (!result.ran) result.why_not = "skipped";
  result.reaction = test.value("fault_reaction", "");
  result.found = one_line(test.value("fault_found", ""));
  result.after = test.value("fault_after", "");
  result.cycles = std::stoi(test.value("fault_cycles", "-1"));
  if (result.passed && result.reaction.empty()) {
    result.passed = false;
    result.why_not = "the test passed without a record of the reaction";
  }
  return result;
}

/// Returns a test's name in words: "bus off" for "StopsInTime/bus_off", "waits for a drive" for "WaitsForADrive".
std::string in_words(const std::string& test) {
  const std::size_t slash = test.rfind('/');
  const std::size_t dot = test.find('.');
  const bool is_row = slash != std::string::npos && slash > dot;
  std::string words;
  for (const char c : test.substr(is_row ? slash + 1 : dot + 1)) {
    const bool upper = !is_row && c >= 'A' && c <= 'Z';
    if (upper && !words.empty()) words += ' ';
    words += c == '_' ? ' ' : upper ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return words;
}

/// Returns the place in which the tests of a program run.
const char* place(const std::string& program) {
  if (program == "closed_loop_can_faults_test") return "simulated CAN";
  if (program == "closed_loop_faults_test") return "no wire";
  if (program == "hil") return "SocketCAN";
  return program == "firmware_command_test" ? "process" : "unit";
}

std::string cycles_text(int cycles) { return cycles < 0 ? "-" : std::to_string(cycles); }

std::string seen_text(const FaultRow& row) {
  if (row.verdict == FaultVerdict::kNotCovered) return "no test";
  if (!row.result.passed) return row.result.why_not;
  return row.result.found.empty() ? row.result.reaction : row.result.reaction + ": " + row.result.found;
}

const char* const kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Injected faults</title>
<style>
body { font: 15px/1.45 sans-serif; color: #222; max-width: 1700px; margin: 2em auto; padding: 0 1em }
table { border-collapse: collapse; font-size: 13px }
th, td { padding: 3px 8px; border-bottom: 1px solid #ddd; text-align: left; vertical-align: top }
td.number { text-align: right; white-space: nowrap }
td.where { white-space: nowrap } td.then { min-width: 15em }
tr.first td { border-top: 2px solid #999 }
.held { color: #06691f } .missed { color: #fff; background: #b00020 } .not { background: #ffe9a8 }
</style></head><body>
<h1>Injected faults</h1>
)";

const char* const kColumns =
    R"(<p>Each row of the table of faults, with every test that injects it. The test has measured the columns seen,
cycles and then in this run; required and allowed are given. Cycles of 1 ms are counted from the cause, whose own
cycle is the first, to the first cycle without rendering; for drives that stop by themselves, to the last drive
that leaves operation. Held: the test passed with the required reaction, and in time. STOP: rendering ends on all
axes, the arm is held, then quick stop and brakes, until the operator resets. FADE: the last rendered wrench fades
to zero in 5 cycles. DRIVE: the drives stop by themselves. REFUSE: no start and no torque.</p>
)";

}  // namespace

const char* name(FaultVerdict verdict) {
  switch (verdict) {
    case FaultVerdict::kHeld: return "held";
    case FaultVerdict::kMissed: return "missed";
    case FaultVerdict::kNotRun: return "not run";
    case FaultVerdict::kNotCovered: return "not covered";
  }
  return "";
}

std::vector<TestResult> read_test_results(const std::filesystem::path& file) {
  std::vector<TestResult> results;
  try {
    const auto all = nlohmann::json::parse(text_of(file));
    for (const auto& suite : all.at("testsuites")) {
      for (const auto& test : suite.at("testsuite")) results.push_back(result_of(test));
    }
  } catch (const std::exception& error) {
    throw command::Failure(command::ExitCode::kBadData, fmt::format("{}: not a result file of GoogleTest ({})",
                                                                    file.string(), one_line(error.what())));
  }
  return results;
}

TestResult read_hil_case(const std::filesystem::path& tests, const std::string& name) {
  TestResult result;
  result.test = name;
  result.why_not = "no result; run ctest -L hil first";
  std::error_code error;
  for (const auto& session : std::filesystem::directory_iterator(tests / "hil", error)) {
    const std::filesystem::path code = session.path() / (name + ".code");
    if (!std::filesystem::exists(code)) continue;
    const std::string exit = text_of(code);
    result.ran = exit != "77\n";
    result.passed = exit == "0\n";
    result.why_not = result.ran ? "exit " + one_line(exit) : "skipped";
    result.found = "see hil." + name;
    std::istringstream lines(text_of(session.path() / (name + ".log")));
    for (std::string line; std::getline(lines, line);) {
      if (line.find("stopped:") != std::string::npos) result.found = line;
    }
    break;
  }
  return result;
}

FaultVerdict judge(const Requirement& requirement, const TestResult& result) {
  if (result.test.empty()) return FaultVerdict::kNotCovered;
  if (!result.ran) return FaultVerdict::kNotRun;
  if (!result.passed) return FaultVerdict::kMissed;
  if (result.reaction.empty()) return FaultVerdict::kHeld;
  if (!is(requirement.kind, result.reaction)) return FaultVerdict::kMissed;
  const bool in_time = result.cycles >= 0 && result.cycles <= requirement.most;
  return requirement.most < 0 || in_time ? FaultVerdict::kHeld : FaultVerdict::kMissed;
}

std::string fault_csv(const std::vector<FaultRow>& rows) {
  std::string text = "fault,required,allowed_cycles,injected,where,test,reaction,found,cycles,after,verdict\n";
  for (const FaultRow& row : rows) {
    const TestResult& seen = row.result;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", csv_text(row.requirement.fault),
                        csv_text(row.requirement.reaction), cycles_text(row.requirement.most), in_words(seen.test),
                        seen.test.empty() ? "" : place(row.injection.program), seen.test, csv_text(seen.reaction),
                        csv_text(seen.passed ? seen.found : seen.why_not), cycles_text(seen.cycles),
                        csv_text(seen.after), name(row.verdict));
  }
  return text;
}

std::string fault_page(const std::vector<FaultRow>& rows, const std::string& heading) {
  std::string text = kHead;
  text += fmt::format(
      "<p>{}</p>\n<p>{}</p>\n{}<table><tr><th>fault</th><th>required</th><th>injected</th><th>where"
      "</th><th>seen</th><th>cycles</th><th>allowed</th><th>then</th><th></th></tr>\n",
      html_text(heading), html_text(fault_summary(rows)), kColumns);
  std::string before;
  for (const FaultRow& row : rows) {
    const bool first = row.requirement.fault != before;
    before = row.requirement.fault;
    const char* look = row.verdict == FaultVerdict::kHeld     ? "held"
                       : row.verdict == FaultVerdict::kMissed ? "missed"
                                                              : "not";
    text += fmt::format(
        "<tr{}><td>{}</td><td>{}</td><td>{}</td><td class=\"where\">{}</td><td>{}</td><td class=\"number\">{}</td>"
        "<td class=\"number\">{}</td><td class=\"then\">{}</td><td class=\"{}\">{}</td></tr>\n",
        first ? " class=\"first\"" : "", first ? html_text(row.requirement.fault) : "",
        first ? html_text(row.requirement.reaction) : "", html_text(in_words(row.result.test)),
        row.result.test.empty() ? "" : place(row.injection.program), html_text(seen_text(row)),
        cycles_text(row.result.cycles), cycles_text(row.requirement.most), html_text(row.result.after), look,
        name(row.verdict));
  }
  return text + "</table>\n<p>The same as <a href=\"faults.csv\">CSV</a>.</p>\n</body></html>\n";
}

std::string fault_summary(const std::vector<FaultRow>& rows) {
  // the verdict on a row is that of its worst injection
  std::vector<std::pair<std::string, FaultVerdict>> faults;
  const auto worse = [](FaultVerdict a, FaultVerdict b) {
    const auto rank = [](FaultVerdict v) {
      return v == FaultVerdict::kMissed ? 3 : v == FaultVerdict::kNotCovered ? 2 : v == FaultVerdict::kNotRun ? 1 : 0;
    };
    return rank(a) > rank(b) ? a : b;
  };
  for (const FaultRow& row : rows) {
    if (faults.empty() || faults.back().first != row.requirement.fault) {
      faults.emplace_back(row.requirement.fault, row.verdict);
    } else {
      faults.back().second = worse(faults.back().second, row.verdict);
    }
  }
  std::map<FaultVerdict, std::vector<std::string>> names;
  for (const auto& [fault, verdict] : faults) names[verdict].push_back(fault);
  std::string text = fmt::format("{} rows, {} injections: {} rows held", faults.size(), rows.size(),
                                 names[FaultVerdict::kHeld].size());
  for (const FaultVerdict verdict : {FaultVerdict::kMissed, FaultVerdict::kNotRun, FaultVerdict::kNotCovered}) {
    if (names[verdict].empty()) continue;
    text += fmt::format(", {} {} ({})", names[verdict].size(), name(verdict), fmt::join(names[verdict], "; "));
  }
  return text;
}

}  // namespace godobject::report
