#include "toolchain/report/study/study.h"

#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/command_line/source_commit.h"
#include "toolchain/figures/gnuplot.h"
#include "toolchain/report/study/page.h"
#include "toolchain/report/study/result_file.h"

namespace godobject::report {
namespace {

/// Machines, programs and unused results among the result files.
struct Origin {
  std::map<std::string, std::size_t> machines;  ///< cases by machine
  std::set<std::string> programs;
  std::vector<std::string> stale;  ///< cases whose result has other inputs

  std::vector<std::string> sentences(const std::string& what_was_run) const {
    std::vector<std::string> all{fmt::format("Commit {}. Made by: {}.", command::kSourceCommit, what_was_run)};
    for (const auto& [machine, count] : machines) all.push_back(fmt::format("{} cases on {}.", count, machine));
    if (programs.size() > 1) {
      all.push_back(fmt::format("The cases were run by {} different builds.", programs.size()));
    }
    if (!stale.empty()) {
      all.push_back(
          fmt::format("Not used, because made from other inputs: {}. Run these cases again.", fmt::join(stale, ", ")));
    }
    return all;
  }
};

std::string picture_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

PageChapter concluded(const Chapter& chapter, const std::filesystem::path& folder, Origin& origin) {
  std::vector<std::optional<StoredResult>> stored;
  std::vector<CaseOutcome> outcomes;
  stored.reserve(chapter.cases.size());
  PageChapter entry{.chapter = &chapter, .section = {}, .pictures = {}};
  for (const StudyCase& study_case : chapter.cases) {
    stored.push_back(read_result(result_path(case_folder(folder), study_case.name), study_case.name));
    if (stored.back() && stored.back()->inputs != digest(study_case.inputs)) {
      origin.stale.push_back(study_case.name);
      stored.back().reset();
    }
    if (stored.back()) {
      ++origin.machines[stored.back()->machine];
      origin.programs.insert(stored.back()->program);
      entry.seconds += stored.back()->seconds;
    }
    outcomes.push_back({&study_case, stored.back() ? &stored.back()->result : nullptr});
  }
  entry.section = chapter.conclude(outcomes, folder);
  if (const std::string text = without_bound(entry.section.findings, chapter.bounds); !text.empty()) {
    throw command::Failure(command::ExitCode::kInternal, fmt::format("{}: {}", chapter.name, text));
  }
  for (const Picture& picture : entry.section.pictures) {
    const std::filesystem::path png = folder / (picture.name + ".png");
    figures::draw_with_gnuplot(picture.program, png);
    entry.pictures.push_back(picture_bytes(png));
  }
  return entry;
}

Sheet sheet_of(const std::vector<PageVerdict>& verdicts) {
  Sheet sheet{.name = "verdicts",
              .columns = {"chapter", "row", "quantity", "unit", "measured", "at_most", "by", "verdict", "where"},
              .rows = {}};
  for (const auto& [chapter, finding] : verdicts) {
    const bool judged = finding.not_judged.empty();
    sheet.rows.push_back({chapter, finding.row, finding.what, finding.unit, judged ? cell(finding.value) : "",
                          finding.most ? cell(*finding.most) : "", finding.timed ? "clock" : "computation",
                          verdict_text(finding), finding.where});
  }
  return sheet;
}

std::string text_of(const PageChapter& entry) {
  std::string text = entry.section.text;
  if (text.empty()) {
    for (const Finding& finding : entry.section.findings) {
      const bool judged = finding.not_judged.empty();
      text += fmt::format("{:<34} {:<64} {:>11} {:<6} {}\n", finding.row, finding.what,
                          judged ? fmt::format("{:.4g}", finding.value) : "", finding.unit, verdict_text(finding));
    }
  }
  return text + entry.chapter->name + ": " + summary(entry.section.findings) + "\n";
}

}  // namespace

std::filesystem::path case_folder(const std::filesystem::path& folder) { return folder / "cases"; }

std::filesystem::path kept_folder(const std::filesystem::path& folder) { return folder / "kept"; }

std::filesystem::path report_file(const std::filesystem::path& folder) { return folder / "report.html"; }

std::vector<const StudyCase*> all_cases(const std::vector<Chapter>& chapters) {
  std::vector<const StudyCase*> all;
  for (const Chapter& chapter : chapters) {
    for (const StudyCase& study_case : chapter.cases) all.push_back(&study_case);
  }
  return all;
}

const StudyCase& find_case(const std::vector<Chapter>& chapters, const std::string& name) {
  for (const StudyCase* study_case : all_cases(chapters)) {
    if (study_case->name == name) return *study_case;
  }
  throw command::Failure(command::ExitCode::kUsage, fmt::format("--case {}: no such case; see --list", name));
}

Merged merge(const std::vector<Chapter>& chapters, const std::filesystem::path& folder,
             const std::string& what_was_run) {
  Origin origin;
  PageContent content;
  Merged merged;
  for (const Chapter& chapter : chapters) {
    content.chapters.push_back(concluded(chapter, folder, origin));
    merged.text += text_of(content.chapters.back());
    for (const Finding& finding : content.chapters.back().section.findings) {
      merged.verdicts.push_back({chapter.name, finding});
    }
  }
  content.made_by = origin.sentences(what_was_run);
  write_file(folder / "verdicts.csv", csv(sheet_of(merged.verdicts)));
  write_file(report_file(folder), page(content));
  merged.text += fmt::format("page: {}\n", report_file(folder).string());
  return merged;
}

}  // namespace godobject::report
