#include "toolchain/bench/page.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <unistd.h>

#include "toolchain/command_line/external_program.h"
#include "toolchain/command_line/failure.h"

namespace godobject::bench {
namespace {

class Page : public ::testing::Test {
 protected:
  Page() : folder_(std::filesystem::temp_directory_path() / ("bench_page_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Page() override { std::filesystem::remove_all(folder_); }

  std::string text(const char* name) const {
    std::ifstream stream(folder_ / name);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }

  const std::filesystem::path folder_;
  Chapter chapter_{
      .tables = {{.name = "shown", .title = "Shown", .columns = {"a", "b"}, .rows = {{"1", "2"}}, .note = {}}},
      .details = {{.name = "detail", .title = "Detail", .columns = {"c"}, .rows = {{"3"}}, .note = {}}},
      .plots = {},
      .targets = {},
      .remarks = {"left out: <something>"}};
};

TEST_F(Page, HoldsEveryTableAndRemark) {
  write_page(chapter_, {{"load", "1, 2"}}, folder_);
  EXPECT_EQ(text("shown.csv"), "a,b\n1,2\n");
  EXPECT_EQ(text("detail.csv"), "c\n3\n");
  EXPECT_EQ(text("machine.csv"), "what,value\nload,\"1, 2\"\n");
  const std::string html = text("index.html");
  for (const char* words : {"Shown", "Detail", "left out: &lt;something&gt;", "1, 2", "</html>"}) {
    EXPECT_NE(html.find(words), std::string::npos) << words;
  }
}

TEST_F(Page, DrawsItsPlotsButNotACurveWithoutPoints) {
  if (!command::find_program("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  chapter_.plots = {{.name = "growth",
                     .title = "It's growth",
                     .x_label = "points",
                     .y_label = "us",
                     .curves = {{"ours", {1e3, 1e4}, {1.0, 2.0}}, {"left out", {}, {}}}}};
  write_page(chapter_, {}, folder_);
  EXPECT_GT(std::filesystem::file_size(folder_ / "growth.png"), 1000u);
  EXPECT_NE(text("index.html").find("growth.png"), std::string::npos);
}

TEST_F(Page, SaysWhatCannotBeWritten) {
  std::filesystem::create_directories(folder_ / "shown.csv");
  try {
    write_page(chapter_, {}, folder_);
    FAIL() << "a folder was replaced";
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kIo);
    EXPECT_NE(std::string(failure.what()).find("shown.csv"), std::string::npos);
  }
}

}  // namespace
}  // namespace godobject::bench
