#include "toolchain/figures/figure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/figures/replay_rows.h"
#include "toolchain/command_line/external_program.h"
#include "toolchain/figures/curve.h"

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
  // force, torque, penetration [mm], points, #1 [us], #2-#7 [us]; outside is no penetration
  const char* const values[6][2] = {{"0", "2"}, {"0", "0"}, {"0", "3"}, {"0", "5"}, {"9", "20"}, {"0.1", "0.4"}};
  for (int panel = 0; panel < 6; ++panel) {
    const std::string block =
        fmt::format("$data2_{} << END\n0.0000 {}\n0.0010 {}\nEND\n", panel, values[panel][0], values[panel][1]);
    EXPECT_NE(text.find(block), std::string::npos) << block;
    EXPECT_NE(text.find(fmt::format("$data2_{} using 1:2", panel)), std::string::npos);
  }
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
  const auto svg =
      std::filesystem::path(testing::TempDir()) / ("godobject_figure_test_" + std::to_string(::getpid()) + ".svg");
  std::filesystem::remove(svg);
  draw(three_solvers(), svg);
  std::ostringstream text;
  text << std::ifstream(svg).rdbuf();
  EXPECT_NE(text.str().find("<svg"), std::string::npos);
  EXPECT_NE(text.str().find("penetration [mm]"), std::string::npos);
  EXPECT_NE(text.str().find("</svg>"), std::string::npos);
  std::filesystem::remove(svg);
}

/// A long curve has few samples left, in their order, among them its ends and each peak of one sample.
TEST(Curve, KeepsEachPeak) {
  std::mt19937 random(1);
  for (const int count : {1, 2, 649, 650, 651, 1300, 50'000}) {
    std::vector<Sample> curve;
    for (int i = 0; i < count; ++i) curve.push_back({1e-3 * i, std::sin(1e-3 * i)});
    const auto up = static_cast<std::size_t>(random() % static_cast<unsigned>(count));
    const auto down = static_cast<std::size_t>(random() % static_cast<unsigned>(count));
    curve[up].value = 7.0;
    if (down != up) curve[down].value = -7.0;
    const std::vector<Sample> thin = thinned(curve);
    EXPECT_LE(thin.size(), std::min<std::size_t>(curve.size(), 4 * 650));
    EXPECT_EQ(thin.front().t, curve.front().t);
    EXPECT_EQ(thin.back().t, curve.back().t);
    int peaks = 0;
    for (std::size_t i = 0; i < thin.size(); ++i) {
      ASSERT_TRUE(i == 0 || thin[i - 1].t < thin[i].t);
      peaks += std::fabs(thin[i].value) == 7.0 ? 1 : 0;
      ASSERT_EQ(thin[i].value, curve[static_cast<std::size_t>(std::lround(1e3 * thin[i].t))].value);
    }
    EXPECT_EQ(peaks, down != up ? 2 : 1) << count;
  }
  EXPECT_TRUE(thinned({}).empty());
}

/// A gap stays a gap, and a curve of gaps alone has no peak.
TEST(Curve, KeepsItsGaps) {
  std::vector<Sample> curve;
  for (int i = 0; i < 10'000; ++i) curve.push_back({1e-3 * i, i >= 5000 && i < 5100 ? std::nan("") : 1.0});
  int gaps = 0;
  for (const Sample& sample : thinned(curve)) {
    gaps += std::isnan(sample.value) ? 1 : 0;
    EXPECT_EQ(std::isnan(sample.value), sample.t > 4.9995 && sample.t < 5.0995) << sample.t;
  }
  EXPECT_GE(gaps, 100 / (10'000 / 650) - 1);
  EXPECT_EQ(curve_block("c", {{0.5, std::nan("")}}), "$c << END\n0.5000 nan\nEND\n");
}

}  // namespace
}  // namespace godobject::figures
