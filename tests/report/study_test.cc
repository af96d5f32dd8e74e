// The list of cases: cases that run, cases that are skipped, and the page.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "tests/support/folder_test.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/report/study/made_once.h"
#include "toolchain/report/study/page.h"
#include "toolchain/report/study/plot.h"
#include "toolchain/report/study/study.h"

namespace godobject::report {
namespace {

Finding finding(double value, double most) {
  return {.row = "A", .what = "deviation", .unit = "%", .value = value, .most = most};
}

TEST(Finding, IsHeldUpToItsBound) {
  EXPECT_EQ(verdict_text(finding(2.0, 2.0)), "held");
  EXPECT_EQ(verdict_text(finding(2.5, 2.0)), "missed by 0.5 %");
  EXPECT_EQ(verdict_text(finding(std::nan(""), 2.0)), "missed: no number");
  EXPECT_EQ(verdict_text(finding(HUGE_VAL, 2.0)), "missed by inf %");
  Finding open = finding(9.0, 0.0);
  open.most.reset();
  EXPECT_EQ(verdict_text(open), "-");
}

TEST(Finding, OfTheSameQuantityTheWorstCounts) {
  Finding not_run = finding(0.0, 2.0);
  not_run.not_judged = "not run";
  EXPECT_EQ(worst_of({finding(1.0, 2.0), not_run, finding(1.5, 2.0)}).front().not_judged, "not run");
  EXPECT_TRUE(std::isnan(worst_of({finding(3.0, 2.0), finding(std::nan(""), 2.0), not_run}).front().value))
      << "what is missed is worse than what is not run";
  EXPECT_EQ(summary({finding(1.0, 2.0), finding(3.0, 2.0)}), "2 rows: 1 held, 1 missed (A: deviation)");
}

TEST(Cell, ReadsBackTheSame) {
  for (const double value : {0.1, -1e-300, 1.0 / 3.0, 6.02e23, HUGE_VAL}) EXPECT_EQ(number(cell(value)), value);
  EXPECT_TRUE(std::isnan(number(cell(std::nan("")))));
  EXPECT_TRUE(std::isnan(number("")));
  EXPECT_EQ(csv({.name = "t", .columns = {"a", "b"}, .rows = {{"x,y", "say \"no\""}}}),
            "a,b\n\"x,y\",\"say \"\"no\"\"\"\n");
}

TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\x00\xfe", 3)), "/wD+");
}

TEST(Plot, LeavesOutWhatIsNotFinite) {
  const std::string text = gnuplot_text(
      {.title = "it's", .x = "x", .y = "y", .curves = {{"", "lines", {{1.0, 2.0}, {3.0, std::nan("")}}}}}, "a.png");
  EXPECT_NE(text.find("1 2\nEND"), std::string::npos);
  EXPECT_NE(text.find("'it''s'"), std::string::npos);
}

class StudyTest : public test::FolderTest {
 protected:
  void SetUp() override { std::filesystem::create_directories(case_folder(folder_)); }

  /// A case that counts its runs and measures `value`.
  StudyCase counted(const std::string& name, double value, const std::string& inputs = "") {
    return {.name = name, .inputs = inputs, .run = [this, name, value](const std::filesystem::path& work) {
              EXPECT_TRUE(std::filesystem::is_directory(work));
              ++runs_;
              CaseResult result;
              result.findings.push_back({.row = name, .what = "value", .unit = "mm", .value = value, .most = 1.0});
              result.sheets.push_back({.name = "values", .columns = {"case", "value"}, .rows = {{name, cell(value)}}});
              return result;
            }};
  }

  void run(const std::vector<Chapter>& chapters, int threads = 1) {
    run_cases(all_cases(chapters), {.folder = case_folder(folder_), .threads = threads, .progress = {}});
  }

  static Chapter chapter(std::vector<StudyCase> cases) {
    std::vector<Bound> bounds;
    for (const StudyCase& each : cases) bounds.push_back({each.name, "value", "mm", 1.0});
    return {.name = "things",
            .title = "Things & more",
            .introduction = "",
            .bounds = std::move(bounds),
            .cases = std::move(cases),
            .conclude = gather};
  }

  std::string text_of(const std::filesystem::path& file) const {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  std::atomic<int> runs_ = 0;
};

TEST_F(StudyTest, RunsAgainOnlyWhatIsNotThereOrHasOtherInputs) {
  const std::vector<Chapter> chapters{chapter({counted("a", 0.1), counted("b", 0.2), counted("c", 3.0)})};
  run(chapters);
  EXPECT_EQ(runs_, 3);
  run(chapters);
  EXPECT_EQ(runs_, 3) << "all are there";
  std::filesystem::remove(result_path(case_folder(folder_), "b"));
  run(chapters);
  EXPECT_EQ(runs_, 4) << "one was interrupted";
  run({chapter({counted("a", 0.1), counted("b", 0.2, "other"), counted("c", 3.0)})});
  EXPECT_EQ(runs_, 5) << "one has other inputs";
  std::ofstream(result_path(case_folder(folder_), "a")) << "{\"form";
  std::vector<std::string> missing;
  for (const StudyCase* it : without_result(all_cases(chapters), case_folder(folder_))) missing.push_back(it->name);
  EXPECT_EQ(missing, (std::vector<std::string>{"a", "b"}));
  run(chapters);
  EXPECT_EQ(runs_, 7) << "one is torn, one has other inputs again";
}

TEST_F(StudyTest, GivesTheSamePageFromSingleCasesAndSeveralThreads) {
  std::vector<StudyCase> cases;
  for (int i = 0; i < 40; ++i) cases.push_back(counted("case-" + std::to_string(i), 0.03 * i));
  const std::vector<Chapter> chapters{chapter(cases)};
  run(chapters, 4);
  EXPECT_EQ(runs_, 40);
  const std::string text = merge(chapters, folder_, "x").text;
  const std::string values = text_of(folder_ / "values.csv");
  std::filesystem::remove_all(case_folder(folder_));
  std::filesystem::create_directories(case_folder(folder_));
  for (auto it = cases.rbegin(); it != cases.rend(); ++it) {
    const StudyCase* const only = &find_case(chapters, it->name);
    run_cases({&only, 1}, {.folder = case_folder(folder_), .threads = 1, .progress = {}});
  }
  EXPECT_EQ(merge(chapters, folder_, "x").text, text);
  EXPECT_EQ(text_of(folder_ / "values.csv"), values);
  EXPECT_NE(text.find("missed by 0.17 mm"), std::string::npos) << text;
}

TEST_F(StudyTest, SaysWhatWasNotRunAndDoesNotUseOldInputs) {
  run({chapter({counted("a", 0.1), counted("b", 0.2)})});
  const std::vector<Chapter> changed{chapter({counted("a", 0.1), counted("b", 0.2, "other"), counted("c", 0.3)})};
  const std::string text = merge(changed, folder_, "x").text;
  EXPECT_NE(text.find("3 rows: 1 held, 2 not run (b: the case; c: the case)"), std::string::npos) << text;
  const Finding not_run{.row = "a", .what = "the case", .unit = "", .not_judged = "not run"};
  EXPECT_TRUE(summary(std::vector<Finding>(60, not_run)).ends_with("; a: the case; and 56 more)"));
  EXPECT_EQ(summary(std::vector<Finding>(60, finding(2.0, 1.0))).find("more"), std::string::npos)
      << "all that is missed";
  const std::string html = text_of(report_file(folder_));
  EXPECT_NE(html.find("made from other inputs: b"), std::string::npos);
  EXPECT_NE(text_of(folder_ / "verdicts.csv").find("things,c,the case,,,,computation,not run,"), std::string::npos)
      << "what was not measured has no number";
  EXPECT_NE(html.find("Things &amp; more"), std::string::npos);
}

TEST_F(StudyTest, KeepsWhatIsDoneWhenACaseFails) {
  const StudyCase fails{
      .name = "fails", .inputs = "", .run = [](const auto&) -> CaseResult { throw std::runtime_error("no"); }};
  const std::vector<Chapter> chapters{chapter({counted("a", 0.1), fails, counted("b", 0.2)})};
  EXPECT_THROW(run(chapters), std::runtime_error);
  EXPECT_TRUE(std::filesystem::exists(result_path(case_folder(folder_), "a")));
  EXPECT_FALSE(std::filesystem::exists(result_path(case_folder(folder_), "fails")));
  EXPECT_THROW(find_case(chapters, "nothing"), command::Failure);
}

TEST_F(StudyTest, BeginsWithTheLongestCaseAndTakesTimesAlone) {
  std::atomic<int> running = 0;
  std::atomic<int> beside_times = 0;
  std::mutex mutex;
  std::vector<std::string> begun;
  const auto noted = [&](const std::string& name, double seconds, bool takes_times) {
    return StudyCase{.name = name,
                     .inputs = "",
                     .run =
                         [&, name, takes_times](const auto&) {
                           {
                             const std::lock_guard lock(mutex);
                             begun.push_back(name);
                           }
                           if (takes_times) beside_times += running;
                           ++running;
                           std::this_thread::yield();
                           --running;
                           return CaseResult{};
                         },
                     .seconds = seconds,
                     .takes_times = takes_times};
  };
  const std::vector<Chapter> chapters{chapter({noted("t1", 5.0, true), noted("a", 1.0, false), noted("b", 9.0, false),
                                               noted("t2", 50.0, true), noted("c", 4.0, false)})};
  std::vector<std::string> order;
  for (const StudyCase* study_case : in_running_order(all_cases(chapters))) order.push_back(study_case->name);
  EXPECT_EQ(order, (std::vector<std::string>{"b", "c", "a", "t2", "t1"}));
  run(chapters);
  EXPECT_EQ(begun, order);
  std::filesystem::remove_all(case_folder(folder_));
  std::filesystem::create_directories(case_folder(folder_));
  run(chapters, 4);
  EXPECT_EQ(beside_times, 0);
  EXPECT_EQ(begun.size(), 10u);
}

TEST_F(StudyTest, SaysHowLongItStillTakes) {
  std::vector<StudyCase> cases{counted("things.a", 0.1), counted("things.b", 0.2)};
  for (StudyCase& study_case : cases) study_case.seconds = 100.0;
  std::vector<RunProgress> seen;
  run_cases(all_cases({chapter(cases)}),
            {.folder = case_folder(folder_), .threads = 1, .progress = [&](const auto& now) { seen.push_back(now); }});
  for (const RunProgress& now : seen) {
    EXPECT_EQ(now.chapter, "things");
    EXPECT_GE(now.done, 0.0);
    EXPECT_LE(now.done, 1.0);
    EXPECT_LE(now.seconds_left, 200.0) << "never more than what was expected: it goes faster";
  }
}

TEST_F(StudyTest, ListsEveryVerdict) {
  const std::vector<Chapter> chapters{chapter({counted("a", 0.1), counted("b", 3.0)})};
  run(chapters);
  static_cast<void>(merge(chapters, folder_, "x"));
  EXPECT_EQ(text_of(folder_ / "verdicts.csv"),
            "chapter,row,quantity,unit,measured,at_most,by,verdict,where\nthings,a,value,mm,0.1,1,computation,held,\n"
            "things,b,value,mm,3,1,computation,missed by 2 mm,\n");
}

TEST_F(StudyTest, TellsNewMissesFromKnownOnes) {
  const auto verdict = [](const std::string& row, double value, bool timed = false) {
    Finding measured = finding(value, 2.0);
    measured.row = row;
    measured.timed = timed;
    return PageVerdict{"things", measured};
  };
  const std::filesystem::path file = folder_ / "known.toml";
  std::ofstream(file) << "[[missed]]\nchapter = \"things\"\nrow = \"B\"\nquantity = \"deviation\"\nmeasured = 3.0\n"
                         "[[missed]]\nchapter = \"things\"\nrow = \"C\"\nquantity = \"deviation\"\n";
  const std::vector<KnownMiss> known = read_known_misses(file);
  ASSERT_EQ(known.size(), 2u);
  EXPECT_TRUE(news({verdict("A", 2.0), verdict("B", 3.2), verdict("C", 99.0), verdict("D", 9.0, true)}, known).empty());
  EXPECT_EQ(news({verdict("A", 2.1)}, known).size(), 1u) << "not in the list";
  EXPECT_EQ(news({verdict("B", 3.4)}, known).size(), 1u) << "worse than is known";
  EXPECT_EQ(news({verdict("B", std::nan(""))}, known).size(), 1u);
  PageVerdict elsewhere = verdict("B", 3.0);
  elsewhere.chapter = "other things";
  EXPECT_EQ(news({elsewhere}, known).size(), 1u);
  PageVerdict not_run = verdict("A", 9.0);
  not_run.finding.not_judged = "not run";
  EXPECT_TRUE(news({not_run}, known).empty());
  std::ofstream(file) << "[[missed]]\nchapter = \"things\"\n";
  EXPECT_THROW(read_known_misses(file), command::Failure);
}

TEST_F(StudyTest, MakesAFileForSeveralCasesOnce) {
  const std::filesystem::path file = folder_ / "shared";
  std::atomic<int> made = 0;
  const auto make = [&] {
    ++made;
    std::this_thread::yield();
    write_file(file, "whole");
  };
  EXPECT_THROW(make_once(file, [] { throw std::runtime_error("no"); }), std::runtime_error);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i) threads.emplace_back([&] { make_once(file, make); });
  }
  EXPECT_EQ(made, 1) << "also after a first attempt that failed";
  EXPECT_EQ(text_of(file), "whole");
  EXPECT_THROW(make_once(folder_ / "nowhere" / "shared", make), command::Failure);
}

TEST_F(StudyTest, RefusesAResultOfAnotherCase) {
  run({chapter({counted("a", 0.1)})});
  std::filesystem::copy_file(result_path(case_folder(folder_), "a"), result_path(case_folder(folder_), "b"));
  EXPECT_THROW(merge({chapter({counted("a", 0.1), counted("b", 0.1)})}, folder_, "x"), command::Failure);
}

}  // namespace
}  // namespace godobject::report
