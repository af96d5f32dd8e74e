#include "toolchain/report/fault_table/chapter.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <sys/utsname.h>

#include "firmware/command/failure.h"
#include "firmware/command/input_file.h"
#include "toolchain/command/atomic_file.h"
#include "toolchain/command/external_program.h"
#include "toolchain/command/output_target.h"
#include "toolchain/command/work_folder.h"

namespace godobject::report {
namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  command::AtomicFile out(file);
  out.write(text);
  out.commit();
}

/// The tests of each program.
std::map<std::string, std::vector<std::string>> programs() {
  std::map<std::string, std::vector<std::string>> found;
  for (const Requirement& requirement : requirements()) {
    for (const Injection& injection : requirement.injections) {
      if (injection.program != "hil") found[injection.program].push_back(injection.test);
    }
  }
  return found;
}

/// What a program says of its tests; with a reason where it died.
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

std::string where_it_was_made() {
  utsname system{};
  ::uname(&system);
  return fmt::format("Made by godobject-report on {} {}, {}.", system.sysname, system.release, system.machine);
}

}  // namespace

std::vector<FaultRow> fault_table(const FaultTableRequest& request) {
  const auto all = programs();
  for (const auto& [program, tests] : all) {
    command::require_regular_input(request.tests / program, "build it, and name its folder with --tests");
  }
  command::make_output_folder(request.output);
  const std::filesystem::path table = request.output / "faults.csv";
  const std::filesystem::path page = request.output / "faults.html";
  command::output_target(page);
  const command::WorkFolder work(table);

  std::map<std::string, TestResult> results;  // by program and test
  double done = 0.0;
  for (const auto& [program, tests] : all) {
    if (request.progress) request.progress("faults", done / static_cast<double>(all.size()));
    for (const TestResult& result : run(request.tests / program, tests, work.path() / (program + ".json"))) {
      results[program + ' ' + result.test] = result;
    }
    done += 1.0;
  }

  std::vector<FaultRow> rows;
  for (const Requirement& requirement : requirements()) {
    if (requirement.injections.empty()) rows.push_back({.requirement = requirement});
    for (const Injection& injection : requirement.injections) {
      FaultRow row{.requirement = requirement, .injection = injection};
      if (injection.program == "hil") {
        row.result = read_hil_case(request.tests, injection.test);
      } else if (const auto found = results.find(injection.program + ' ' + injection.test); found != results.end()) {
        row.result = found->second;
      } else {
        row.result = {.test = injection.test, .why_not = "the program has no such test"};
      }
      row.verdict = judge(requirement, row.result);
      rows.push_back(row);
    }
  }
  write(table, fault_csv(rows));
  write(page, fault_page(rows, where_it_was_made()));
  return rows;
}

}  // namespace godobject::report
