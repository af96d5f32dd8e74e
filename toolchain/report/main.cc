#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "toolchain/command_line/progress.h"
#include "toolchain/command_line/run.h"
#include "toolchain/files/output_target.h"
#include "toolchain/report/assembly/chapter.h"
#include "toolchain/report/contact_quality/chapter.h"
#include "toolchain/report/extremes/chapter.h"
#include "toolchain/report/fault_table/chapter.h"
#include "toolchain/report/stability/chapter.h"
#include "toolchain/report/study/study.h"
#include "toolchain/report/work_precision/chapter.h"

namespace {

using namespace godobject::report;

const char* const kFooter = R"(Examples:
  godobject-report --only contact --only stability --quick -j 2 -o report
  godobject-report --list | parallel godobject-report --case {} -o report && godobject-report --merge report

The study is a list of independent cases. Each case writes one file, DIR/cases/NAME.json. A case with a file is run
again only if the program or its inputs have changed, so the same command continues an interrupted run. From these
files the command makes DIR/report.html, one page with all pictures, and the tables as CSV. --merge makes the page
without running a case. With the same options the pages of one machine and of several differ only in times and names
of machines.

Chapters:
  contact    the solvers in the same scenes along the same paths; values are those of the worst scene, times are
             medians and grow if cases run side by side
  faults     runs the test programs of --tests that inject faults, and reads the results of `ctest -L hil` in the same
             build
  precision  error against run time, and the recommended settings under a budget
  stability  theory and simulation, in virtual time
  extremes   numerical extremes, and a fuzzer whose violations become files for --replay
  assembly   parts that fit tightly, compared with theory; with --quick only generated ones, which compile in seconds

Exit codes: 0 done (missed rows included), 1 --replay: still violated, --known-misses: another row is missed, 64
usage, 65 bad mesh or case file, 66 a mesh, device or test program is missing or unreadable, 70 gnuplot is missing, 74
cannot write, 77 no permission to write.)";

struct Options {
  std::vector<std::string> only;
  std::string output;
  std::string merge_folder;
  std::string case_name;
  std::string replay_file;
  std::string missing_in;
  std::string known_misses;
  bool list = false;
  int threads = 1;
  ContactQualityRequest contact{.meshes = "toolchain/scenes/meshes", .quick = false, .scene = {}};
  std::string tests = "build/release/tests";
  std::string devices = "firmware/devices";
  std::string scenes = "toolchain/scenes";
  std::int64_t cycles = 0;
  std::uint32_t seed = 0;
};

bool wanted(const Options& options, const std::string& chapter) {
  return options.only.empty() || std::find(options.only.begin(), options.only.end(), chapter) != options.only.end();
}

std::vector<Chapter> chapters(const Options& options) {
  std::vector<Chapter> all;
  if (wanted(options, "contact")) all.push_back(contact_chapter(options.contact));
  if (wanted(options, "faults")) all.push_back(fault_chapter(options.tests));
  if (wanted(options, "precision"))
    all.push_back(work_precision_chapter({options.scenes, kept_folder(options.output), options.contact.quick}));
  if (wanted(options, "stability"))
    all.push_back(
        stability_chapter({.devices = options.devices, .quick = options.contact.quick, .seed = options.seed}));
  if (wanted(options, "extremes"))
    all.push_back(extremes_chapter(
        {.devices = options.devices, .cycles = options.cycles, .quick = options.contact.quick, .seed = options.seed}));
  if (wanted(options, "assembly"))
    all.push_back(assembly_chapter({.scenes = options.scenes,
                                    .kept = kept_folder(options.output),
                                    .quick = options.contact.quick,
                                    .seed = options.seed}));
  return all;
}

std::string words(const RunProgress& now) {
  if (now.seconds_left < 60.0) return now.chapter;
  return fmt::format("{}, about {:.0f} min left", now.chapter, std::ceil(now.seconds_left / 60.0));
}

/// Makes the page. Returns true if a row is missed that is not known to be.
bool conclude(const Options& options, const std::vector<Chapter>& all, const std::string& folder, std::string made) {
  if (options.contact.quick) made += ", --quick";
  const Merged merged = merge(all, folder, made);
  fmt::print("{}", merged.text);
  if (options.known_misses.empty()) return false;
  const std::vector<std::string> unknown = news(merged.verdicts, read_known_misses(options.known_misses));
  for (const std::string& line : unknown) fmt::print("missed, but not a known miss: {}\n", line);
  return !unknown.empty();
}

/// Runs the cases and makes the page. Returns as conclude().
bool run_all(const Options& options) {
  const std::vector<Chapter> all = chapters(options);
  std::vector<const StudyCase*> cases = all_cases(all);
  if (!options.case_name.empty()) cases = {&find_case(all, options.case_name)};
  godobject::files::make_output_folder(options.output);
  godobject::files::make_output_folder(case_folder(options.output));
  godobject::files::output_target(report_file(options.output));  // refused before the work
  {
    godobject::command::Progress progress;
    run_cases(cases, {.folder = case_folder(options.output),
                      .threads = options.threads,
                      .progress = [&](const RunProgress& now) { progress.show(words(now), now.done); }});
  }
  if (!options.case_name.empty()) return false;
  return conclude(options, all, options.output, fmt::format("one process, {} threads", options.threads));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Measures solvers, faults, precision, stability, numerical extremes and assemblies, and makes a page of "
      "verdicts.",
      "godobject-report");
  app.footer(kFooter);
  Options options;
  app.add_option("--only", options.only, "chapter to make, may be repeated; default: all")
      ->check(CLI::IsMember({"contact", "faults", "precision", "stability", "extremes", "assembly"}))
      ->option_text("CHAPTER");
  app.add_flag("--quick", options.contact.quick, "less of everything, below three minutes on two cores");
  app.add_option("-j,--threads", options.threads, "cases at the same time")
      ->check(CLI::Range(1, 1024))
      ->option_text("N")
      ->capture_default_str();
  app.add_option("--cycles", options.cycles, "total cycles of the fuzzer; default: 100000, with --quick 20000")
      ->check(CLI::Range(std::int64_t{1000}, std::int64_t{1'000'000'000'000}))
      ->option_text("N");
  app.add_option("--seed", options.seed,
                 "seed of the fuzzer, and of the random loops, postures, motions and loads of other rows")
      ->check(CLI::Range(0u, 1'000'000u))
      ->option_text("N")
      ->capture_default_str();
  app.add_option("--scene", options.contact.scene,
                 "chapter contact: only scenes whose name contains this; default: all")
      ->type_name("PART");
  app.add_option("--meshes", options.contact.meshes, "folder of bunny_npm.ply, the moving body of some scenes")
      ->type_name("FOLDER")
      ->capture_default_str();
  app.add_option("--tests", options.tests, "folder of the test programs that inject faults")
      ->type_name("FOLDER")
      ->capture_default_str();
  app.add_option("--devices", options.devices, "folder of the device files")
      ->type_name("FOLDER")
      ->capture_default_str();
  app.add_option("--scenes", options.scenes, "folder of the scene files and their motions")
      ->type_name("FOLDER")
      ->capture_default_str();
  app.add_option("--known-misses", options.known_misses,
                 "list of known misses; any other missed row, run times excepted, ends with 1")
      ->type_name("FILE");
  auto* what = app.add_option_group("task");
  auto* output = what->add_option("-o,--output", options.output, "folder of the outputs; created if it is missing")
                     ->type_name("DIR");
  app.add_option("--case", options.case_name, "run only this case, without a page")->type_name("NAME")->needs(output);
  what->add_option("--merge", options.merge_folder,
                   "make the page from the result files in DIR/cases, without running a case")
      ->type_name("DIR");
  auto* list = what->add_flag("--list", options.list, "print the names of the cases, one per line");
  app.add_option("--missing-in", options.missing_in, "list only the cases without a result in DIR")
      ->type_name("DIR")
      ->needs(list);
  what->add_option("--replay", options.replay_file, "run a case file of the fuzzer")->type_name("FILE");
  what->require_option(1);
  bool failed = false;
  const int code = godobject::command::run(app, argc, argv, [&] {
    if (!options.replay_file.empty()) {
      failed = replay(options.replay_file);
    } else if (options.list) {
      const std::vector<Chapter> all = chapters(options);
      const std::vector<const StudyCase*> cases = options.missing_in.empty()
                                                      ? in_running_order(all_cases(all))
                                                      : without_result(all_cases(all), case_folder(options.missing_in));
      for (const StudyCase* study_case : cases) fmt::print("{}\n", study_case->name);
    } else if (!options.merge_folder.empty()) {
      failed = conclude(options, chapters(options), options.merge_folder, "results of single cases");
    } else {
      failed = run_all(options);
    }
  });
  return failed ? 1 : code;
}
