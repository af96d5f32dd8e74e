#include "toolchain/figures/plan.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/figures/replay_rows.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/figures/page.h"

namespace godobject::figures {
namespace {

using command::ExitCode;
using command::Failure;

class Plan : public testing::Test {
 protected:
  Plan() { std::filesystem::create_directories(folder_ / "peg"); }
  ~Plan() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path holding(const std::string& text) {
    std::ofstream(folder_ / "plan.toml") << text;
    return folder_ / "plan.toml";
  }

  void expect_refused(const std::string& text, ExitCode exit_code, const std::string& part) {
    try {
      (void)read_plan(holding(text));
      FAIL() << "accepted: " << text;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), exit_code);
      EXPECT_NE(std::string(failure.what()).find(part), std::string::npos) << failure.what();
    }
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("plan_") + testing::UnitTest::GetInstance()->current_test_info()->name() + "_" +
       std::to_string(::getpid()));
  const std::string kScene = "[[scene]]\nname = 'peg'\nimage = 'hole'\ntitle = 'A < B'\ntext = 'words'\n";
};

TEST_F(Plan, IsRead) {
  const auto plans = read_plan(holding(kScene + "markers = { A = 0.5, B = 1 }\nbarrier = [0, 0, 1, 0, 0, 2]\n")).scenes;
  ASSERT_EQ(plans.size(), 1u);
  EXPECT_EQ(plans[0].image, "hole");
  ASSERT_EQ(plans[0].markers.size(), 2u);
  EXPECT_EQ(plans[0].markers[1].name, "B");
  EXPECT_EQ(plans[0].markers[1].t, 1.0);
  ASSERT_TRUE(plans[0].barrier);
  EXPECT_EQ(plans[0].barrier->point, Vector3(0, 0, 1));
  EXPECT_EQ(plans[0].barrier->normal, Vector3(0, 0, 1));
}

TEST_F(Plan, HasRunsOnAnArmIfWanted) {
  EXPECT_TRUE(read_plan(holding(kScene)).runs.empty());
  std::string run = kScene;
  run.replace(0, 9, "[[run]]");
  const auto plan = read_plan(holding(kScene + run + "device = '../arm.toml'\nmarkers = { B = 2.5 }\n"));
  ASSERT_EQ(plan.runs.size(), 1u);
  EXPECT_EQ(plan.runs[0].scene.name, "peg");
  EXPECT_EQ(plan.runs[0].scene.markers[0].t, 2.5);
  EXPECT_EQ(plan.runs[0].device, folder_ / "../arm.toml");
  expect_refused(kScene + run, ExitCode::kBadConfig, "run.device: is missing");
  expect_refused(kScene + run + "colour = 3\n", ExitCode::kBadConfig, "run.colour");
  expect_refused(kScene + "device = 'x'\n", ExitCode::kBadConfig, "scene.device");
  expect_refused(kScene + "[[picture]]\n", ExitCode::kBadConfig, "picture");
}

TEST_F(Plan, LinksToStudiesIfWanted) {
  EXPECT_TRUE(read_plan(holding(kScene)).studies.empty());
  const std::string study = "[[study]]\nname = 'fits'\ntitle = 'C < D'\ntext = 'words'\n";
  const auto plan = read_plan(holding(kScene + study));
  ASSERT_EQ(plan.studies.size(), 1u);
  EXPECT_EQ(plan.studies[0].title, "C < D");
  const std::string html = page({.plan = plan,
                                 .figures = {Figure{}},
                                 .entries = {},
                                 .verdicts = {},
                                 .arm_figures = {},
                                 .runs = {},
                                 .run_verdicts = {}},
                                folder_);
  EXPECT_LT(html.find("<h3 id=\"peg\">"), html.find("<h2 id=\"fits\">C &lt; D</h2>"));
  EXPECT_NE(html.find("href=\"fits/report.html\""), std::string::npos);
  expect_refused(kScene + "[[study]]\nname = 'fits'\ntext = 'words'\n", ExitCode::kBadConfig,
                 "study.title: is missing");
  expect_refused(kScene + study + "image = 'hole'\n", ExitCode::kBadConfig, "study.image: unknown key");
}

TEST_F(Plan, IsRefusedNamingTheKey) {
  expect_refused("[[scene]\n", ExitCode::kBadConfig, "plan.toml:1");
  expect_refused("[[scene]]\nname = 'peg'\n", ExitCode::kBadConfig, "scene.image: is missing; write image = ");
  expect_refused("[[scene]]\nname = 3\n", ExitCode::kBadConfig, "scene.name: must be a text");
  expect_refused(kScene + "colour = 3\n", ExitCode::kBadConfig, "scene.colour");
  expect_refused(kScene + "markers = { A = 'now' }\n", ExitCode::kBadConfig, "scene.markers.A");
  expect_refused(kScene + "barrier = [0, 0, 1]\n", ExitCode::kBadConfig, "scene.barrier");
  expect_refused(kScene + "barrier = [0, 0, 1, 0, 0, 0]\n", ExitCode::kBadConfig, "scene.barrier");
  expect_refused("", ExitCode::kBadConfig, "scene");
  std::string key = "a";
  for (int i = 0; i < 50'000; ++i) key += ".a";
  expect_refused(kScene + key + " = 1\n", ExitCode::kBadConfig, "plan.toml:6: tables and arrays nest deeper");
  EXPECT_THROW((void)read_plan("/dev/zero"), Failure);
}

TEST_F(Plan, BecomesAPageWithThePicturesThatAreThere) {
  for (const char* name : {"paper_1.200.png", "contact_1.200.png", "paper_deepest.png", "sketch.png"})
    std::ofstream(folder_ / "peg" / name) << "x";
  const ReplayLog log = {replay_row(1.2, 7.5, 0.0001, 5, 9e3, 100), replay_row(1.201, 2.0, 0.003, 5, 20e3, 400)};
  const Figure figure{.title = "",
                      .facts = "8 points & more.",
                      .voxel_size = 0.002,
                      .markers = {},
                      .series = {{"paper", log}, {"contact", log}}};
  const std::string html =
      page({.plan = read_plan(holding(kScene)),
            .figures = {figure},
            .entries = {{"peg", "paper", 0.002, {}, {}}, {"peg", "contact", 0.002, {}, {}}},
            .verdicts = {.contact = {"HOLDS & keeps"}, .compared = {"MISSED & lost"}, .times = {"MISSED late"}},
            .arm_figures = {},
            .runs = {},
            .run_verdicts = {},
            .logs = {}},
           folder_);
  EXPECT_NE(html.find("<h3 id=\"peg\">A &lt; B</h3>"), std::string::npos);
  EXPECT_NE(html.find("<b>MISSED</b> &amp; lost"), std::string::npos);
  // Verdicts of contact come first, then the scenes, the comparison, and times.
  EXPECT_LT(html.find("<b>HOLDS</b> &amp; keeps"), html.find("<h3 id=\"peg\">"));
  EXPECT_LT(html.find("<h3 id=\"peg\">"), html.find("<b>MISSED</b> &amp; lost"));
  EXPECT_LT(html.find("<b>MISSED</b> &amp; lost"), html.find("<b>MISSED</b> late"));
  EXPECT_NE(html.find("<p>8 points &amp; more.</p>"), std::string::npos);
  EXPECT_NE(html.find("<th class=\"more\">behind [mm]</th>"), std::string::npos);
  EXPECT_NE(html.find("<th>force [N]</th>"), std::string::npos);
  EXPECT_NE(html.find("peg/paper_1.200.png"), std::string::npos);
  EXPECT_NE(html.find("paper, 1.200 s: depth 0.100 mm, force 7.5 N"), std::string::npos);
  EXPECT_NE(html.find("paper, 1.201 s (largest depth of all solvers): depth 3.000 mm, force 2.0 N"), std::string::npos);
  EXPECT_LT(html.find("<figcaption>contact, 1.200"), html.find("<figcaption>paper, 1.200"));
  EXPECT_LT(html.find("<figcaption>paper, 1.200"), html.find("<figcaption>paper, 1.201"));
  EXPECT_NE(html.find("<figcaption>sketch.png"), std::string::npos);
  EXPECT_NE(html.find("href=\"peg/paper.csv\""), std::string::npos);
  PageContent elsewhere;
  elsewhere.plan = read_plan(holding(kScene));
  elsewhere.figures = {figure};
  elsewhere.entries = {{"peg", "paper", 0.002, {}, {}}};
  elsewhere.logs = folder_.parent_path() / "logs & more";
  EXPECT_NE(page(elsewhere, folder_).find("href=\"../logs &amp; more/peg/paper.csv\""), std::string::npos);
  EXPECT_EQ(html.find("replay.html"), std::string::npos);
  std::ofstream(folder_ / "peg" / "replay.html") << "x";
  const std::string moving = page({.plan = read_plan(holding(kScene)),
                                   .figures = {figure},
                                   .entries = {},
                                   .verdicts = {},
                                   .arm_figures = {},
                                   .runs = {},
                                   .run_verdicts = {}},
                                  folder_);
  EXPECT_LT(moving.find("<iframe class=\"moving\" src=\"peg/replay.html\""), moving.find("What holds"));
  EXPECT_NE(moving.find("<a href=\"peg/replay.html\">Moving picture</a>"), std::string::npos);
}

TEST_F(Plan, HasAChapterForRunsOnAnArm) {
  std::filesystem::create_directories(folder_ / "arm-peg");
  std::ofstream(folder_ / "arm-peg" / "telemetry_1.200.png") << "x";
  TelemetryRow row;
  row.cycle = replay_row(1.2, 7.5, -0.00001, 5, 0.0, 0.0);
  row.share = 1.0;
  TelemetryRow after = row;
  after.cycle.t = 1.3;
  after.cycle.depth = 0.001;
  after.share = 0.0;
  ArmRun run;
  run.name = "arm-peg";
  const std::string text =
      kScene + "[[run]]\nname = 'arm-peg'\nimage = 'hole'\ntitle = 'Felt'\ntext = 'words'\ndevice = 'x'\n";
  const Figure figure{
      .title = "", .facts = "", .voxel_size = 0.002, .markers = {}, .series = {{"contact", {row.cycle}}}};
  const std::string html = page({.plan = read_plan(holding(text)),
                                 .figures = {figure},
                                 .entries = {},
                                 .verdicts = {},
                                 .arm_figures = {{.title = "Felt",
                                                  .facts = "8 points.",
                                                  .markers = {},
                                                  .log = {.cycles = {row, after}, .hand = {}, .torque_limits = {}}}},
                                 .runs = {run},
                                 .run_verdicts = {"HOLDS & ends"}},
                                folder_);
  EXPECT_LT(html.find("<h2 id=\"closed-loop\">"), html.find("<h3 id=\"peg\">"));
  EXPECT_LT(html.find("<b>HOLDS</b> &amp; ends"), html.find("<h3 id=\"arm-peg\">Felt</h3>"));
  EXPECT_NE(html.find("<th class=\"more\">torque %</th>"), std::string::npos);
  EXPECT_NE(html.find("telemetry, 1.200 s: depth -0.010 mm, force 7.5 N"), std::string::npos);
  EXPECT_NE(html.find("href=\"arm-peg/hand.csv\""), std::string::npos);
  EXPECT_NE(html.find("src=\"arm-peg/figure.svg\""), std::string::npos);
}

}  // namespace
}  // namespace godobject::figures
