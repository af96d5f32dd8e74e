#include "toolchain/figures/statistics.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/figures/replay_rows.h"
#include "toolchain/figures/claims.h"
#include "toolchain/figures/table.h"

namespace godobject::figures {
namespace {

TEST(Percentile, IsTheNearestRank) {
  std::vector<double> values = {50, 15, 40, 20, 35};
  EXPECT_EQ(percentile(values, 0.05), 15);
  EXPECT_EQ(percentile(values, 0.30), 20);  // ceil(1.5) = 2nd
  EXPECT_EQ(percentile(values, 0.40), 20);  // exactly the 2nd
  EXPECT_EQ(percentile(values, 0.50), 35);
  EXPECT_EQ(percentile(values, 1.00), 50);
}

TEST(Percentile, OfAHundredIsThatRankInSpiteOfRounding) {
  std::vector<double> values(100);
  std::iota(values.begin(), values.end(), 1.0);
  for (int share = 1; share <= 100; ++share) EXPECT_EQ(percentile(values, share / 100.0), share);
}

TEST(Percentile, OfOneIsItself) {
  std::vector<double> values = {7};
  EXPECT_EQ(percentile(values, 0.01), 7);
  EXPECT_EQ(percentile(values, 0.99), 7);
}

TEST(Statistics, AreHandComputed) {
  const ReplayLog log = {
      replay_row(0.000, 0.0, -0.006, 0, 5e6, 100),    // free, and slow: counts only for cycles over 1 ms
      replay_row(0.001, 1.0, -0.0005, 4, 10e3, 1e3),  // in contact, not inside
      replay_row(0.002, 8.0, 0.003, 9, 30e3, 3e3),
      replay_row(0.003, 3.0, 0.001, 0, 20e3, 2e3),   // inside: in contact without a count
      replay_row(0.004, 2.0, 0.000, 1, 999e3, 1e3),  // exactly 1 ms: not over
  };
  const Statistics s = statistics(log, 0.0035);
  EXPECT_EQ(s.cycles, 5u);
  EXPECT_EQ(s.contact_cycles, 4u);
  EXPECT_DOUBLE_EQ(s.penetration_max, 0.003);
  EXPECT_DOUBLE_EQ(s.penetration_at, 0.002);
  EXPECT_DOUBLE_EQ(s.penetration_mean, 0.001);  // (0 + 3 + 1 + 0) / 4 mm
  EXPECT_EQ(s.peak_force, 8.0);
  EXPECT_EQ(s.peak_contacts, 9.0);
  EXPECT_EQ(s.step1.p50, 20.0);
  EXPECT_EQ(s.step1.p99, 999.0);
  EXPECT_EQ(s.solve.p50, 1.0);
  EXPECT_EQ(s.solve.max, 3.0);
  EXPECT_EQ(s.over_1ms, 1u);
  EXPECT_FALSE(s.depth_is_bound);
  EXPECT_TRUE(statistics(log, 0.003).depth_is_bound);
}

TEST(Statistics, OfAFreeMotionAreZero) {
  const Statistics s = statistics({replay_row(0.0, 0.0, -0.006, 0, 9e3, 100)}, 0.006);
  EXPECT_EQ(s.contact_cycles, 0u);
  EXPECT_EQ(s.penetration_mean, 0.0);
  EXPECT_EQ(s.step1.max, 0.0);
}

Entry entry(double depth, double solve_p99, std::size_t over_1ms) {
  Entry e{.scene = "peg", .solver = "paper", .voxel_size = 0.002, .statistics = {}, .crossing = {}};
  e.statistics.penetration_max = depth;
  e.statistics.solve.p99 = solve_p99;
  e.statistics.over_1ms = over_1ms;
  return e;
}

TEST(Claims, AreMissedInWordsThatNameSceneSolverAndNumber) {
  const auto verdicts = judge({entry(0.005, 5.1, 2), entry(0.0019, 4.9, 0)});
  ASSERT_EQ(verdicts.size(), 3u);
  EXPECT_NE(verdicts[0].find("peg, solver paper"), std::string::npos);
  EXPECT_NE(verdicts[0].find("5.00 mm, 2.5 voxels"), std::string::npos);
  EXPECT_NE(verdicts[1].find("5.10 us"), std::string::npos);
  EXPECT_NE(verdicts[2].find("2 of"), std::string::npos);
}

TEST(Claims, OneVoxelIsNotBelowOneVoxel) { EXPECT_EQ(judge({entry(0.002, 1.0, 0)}).front().rfind("MISSED", 0), 0u); }

TEST(Claims, ThatHoldAreSaidToHold) {
  const auto verdicts = judge({entry(0.0, 1.0, 0)});
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_EQ(verdicts[0],
            "Met by every scene and solver: penetration below one voxel; steps #2-#7 within 5 us (99th percentile); "
            "every cycle below 1 ms");
}

TEST(Claims, ABodyBehindTheBarrierHasPoppedThroughThoughItsDepthIsSmall) {
  Entry e = entry(0.0005, 1.0, 0);
  e.crossing = Crossing{.distance = 0.1, .t = 1.7};
  const auto verdicts = judge({e});
  EXPECT_NE(verdicts[0].find("MISSED peg, solver paper: the god object goes 100.0 mm behind the surface, at 1.700 s"),
            std::string::npos);
  for (const std::string& verdict : verdicts) EXPECT_EQ(verdict.find("penetration below one voxel"), std::string::npos);
}

TEST(Claims, ADepthAtTheBandIsALowerBound) {
  Entry e = entry(0.006, 1.0, 0);
  e.statistics.depth_is_bound = true;
  EXPECT_NE(judge({e})[0].find("at least 6.00 mm"), std::string::npos);
}

TEST(Table, HasTheSameFieldsInEveryLine) {
  const std::string csv = csv_table({entry(0.003, 1.25, 0), entry(0.0, 0.0, 0)});
  EXPECT_EQ(csv.rfind("scene,solver,penetration_max_mm,", 0), 0u);
  EXPECT_NE(csv.find("\npeg,paper,3.000,0.000,1.50,0.00,"), std::string::npos) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 3 * static_cast<std::ptrdiff_t>(columns().size() - 1));
}

TEST(Table, LinesUpOnATerminal) {
  const std::string text = text_table({entry(0.003, 1.25, 0), entry(0.0, 0.0, 0)});
  const std::size_t width = text.find('\n');
  EXPECT_EQ(text.size(), 3 * (width + 1));
}

}  // namespace
}  // namespace godobject::figures
