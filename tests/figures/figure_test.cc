#include "toolchain/figures/figure.h"

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/figures/replay_rows.h"
#include "toolchain/command_line/external_program.h"

namespace godobject::figures {
namespace {

Figure three_solvers() {
  const ReplayLog log = {replay_row(0.0, 0.0, -0.006, 0, 9e3, 100), replay_row(0.001, 2.0, 0.003, 5, 20e3, 400)};
  return {.title = "Pot's scene",
          .voxel_size = 0.002,
          .markers = {{"A", 0.0005}},
          .series = {{"paper", log}, {"corrected", log}, {"contact", log}}};
}

TEST(Figure, HoldsItsDataInTheUnitsOfItsAxes) {
  const std::string text = gnuplot_text(three_solvers(), "x.png");
  // t, force, torque, penetration [mm], points, #1 [us], #2-#7 [us]; outside is no penetration
  EXPECT_NE(text.find("\n0.0010 2 0 3 5 20 0.4\n"), std::string::npos);
  EXPECT_NE(text.find("\n0.0000 0 0 0 0 9 0.1\n"), std::string::npos);
  EXPECT_NE(text.find("layout 6,1"), std::string::npos);
  EXPECT_NE(text.find("'Pot''s scene'"), std::string::npos);
  EXPECT_NE(text.find("2 with lines dt 4 lw 1.2 lc rgb '#000000' notitle"), std::string::npos);
}

TEST(Figure, NamesEachSolverOnceWithAColourOfItsOwn) {
  const std::string text = gnuplot_text(three_solvers(), "x.png");
  std::set<std::string> colors;
  for (const std::string solver : {"paper", "corrected", "contact"}) {
    const std::string title = "' title 'solver " + solver + "'";
    const std::size_t at = text.find(title);
    ASSERT_NE(at, std::string::npos) << solver;
    EXPECT_EQ(text.find(title, at + 1), std::string::npos) << solver;
    colors.insert(text.substr(at - 7, 7));
  }
  EXPECT_EQ(colors.size(), 3u);
}

TEST(Figure, IsDrawnByGnuplot) {
  if (!command::find_program("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  const auto png =
      std::filesystem::path(testing::TempDir()) / ("godobject_figure_test_" + std::to_string(::getpid()) + ".png");
  std::filesystem::remove(png);
  draw(three_solvers(), png);
  std::string head(8, '\0');
  std::ifstream(png, std::ios::binary).read(head.data(), 8);
  EXPECT_EQ(head, "\x89PNG\r\n\x1a\n");
  std::filesystem::remove(png);
}

}  // namespace
}  // namespace godobject::figures
