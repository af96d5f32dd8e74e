#include "toolchain/figures/statistics.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/figures/replay_rows.h"
#include "toolchain/figures/claims.h"
#include "toolchain/figures/table.h"

namespace godobject::figures {
namespace {

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
  EXPECT_EQ(s.penetration_max, 0.0);
  EXPECT_EQ(s.penetration_mean, 0.0);
  EXPECT_EQ(s.step1.max, 0.0);
}

TEST(Statistics, OfAGapThatIsKeptAreNegativeAndLookAtContactOnly) {
  const Statistics s =
      statistics({replay_row(0.000, 0.0, -0.00001, 0, 9e3, 100),  // near, but nothing carries
                  replay_row(0.001, 1.0, -0.00003, 2, 9e3, 100), replay_row(0.002, 1.0, -0.00002, 2, 9e3, 100)},
                 0.006);
  EXPECT_EQ(s.penetration_max, -0.00002);
  EXPECT_EQ(s.penetration_at, 0.002);
  EXPECT_EQ(s.penetration_mean, 0.0);
}

TEST(Statistics, HoldTheLargestForceStepAndCountTheStatuses) {
  ReplayLog log = {replay_row(0.000, 9.0, 0.0, 1, 9e3, 100), replay_row(0.001, 7.0, 0.0, 1, 9e3, 100),
                   replay_row(0.002, -3.0, 0.0, 1, 9e3, 100), replay_row(0.003, 0.0, -0.001, 0, 9e3, 100)};
  log[0].status = "cut";
  log[1].status = "overflow";
  log[2].status = "cut";
  const Statistics s = statistics(log, 0.006);
  EXPECT_DOUBLE_EQ(s.force_step, 10.0);  // of the vector, which reverses; the first force is no step
  EXPECT_DOUBLE_EQ(s.force_step_at, 0.002);
  EXPECT_EQ(s.cut, 2u);
  EXPECT_EQ(s.overflow, 1u);
  EXPECT_EQ(s.infeasible, 0u);
}

Entry entry(double depth, double solve_p99, std::size_t over_1ms) {
  Entry e{.scene = "peg", .solver = "paper", .voxel_size = 0.002, .statistics = {}, .crossing = {}};
  e.statistics.penetration_max = depth;
  e.statistics.solve.p99 = solve_p99;
  e.statistics.over_1ms = over_1ms;
  return e;
}

TEST(Claims, AreMissedInWordsThatNameSceneSolverAndNumber) {
  const Verdicts verdicts = judge({entry(0.005, 5.1, 2), entry(0.0019, 4.9, 0)});
  EXPECT_TRUE(verdicts.contact.empty());
  ASSERT_EQ(verdicts.compared.size(), 1u);
  EXPECT_NE(verdicts.compared[0].find("MISSED peg, solver paper"), std::string::npos);
  EXPECT_NE(verdicts.compared[0].find("5.000 mm, 2.50 voxels"), std::string::npos);
  ASSERT_EQ(verdicts.times.size(), 2u);
  EXPECT_NE(verdicts.times[0].find("5.10 us"), std::string::npos);
  EXPECT_NE(verdicts.times[1].find("2 of"), std::string::npos);
}

TEST(Claims, OfTimeAreOneSentenceASolverWithItsWorstScene) {
  Entry pot = entry(0.0, 9.0, 3);
  pot.scene = "pot";
  Entry other = entry(0.0, 7.0, 0);
  other.solver = "contact";
  const std::vector<std::string> times = judge({entry(0.0, 6.0, 1), pot, other}).times;
  ASSERT_EQ(times.size(), 4u);
  EXPECT_EQ(times[0].rfind("MISSED peg, solver contact: steps #2-#7 take", 0), 0u) << "the default solver first";
  EXPECT_EQ(times[1], "HOLDS in every scene, solver contact: every cycle below 1 ms");
  EXPECT_EQ(times[2].rfind("MISSED peg, pot, solver paper: in pot steps #2-#7 take 0.00 us in the median, 9.00 us", 0),
            0u)
      << times[2];
  EXPECT_EQ(times[3].rfind("MISSED peg, pot, solver paper: in pot 3 of", 0), 0u) << times[3];
}

TEST(Claims, OneVoxelIsNotBelowOneVoxel) {
  EXPECT_EQ(judge({entry(0.002, 1.0, 0)}).compared.front().rfind("MISSED", 0), 0u);
}

TEST(Claims, ThatHoldAreSaidToHoldSolverBySolver) {
  Entry other = entry(0.0015, 1.0, 0);
  other.scene = "pot";
  Entry kept = entry(-0.0000155, 9.0, 0);
  kept.solver = "contact";
  kept.crossing = Crossing{};
  const Verdicts verdicts = judge({entry(-0.001, 1.0, 0), kept, other});
  EXPECT_EQ(verdicts.compared,
            std::vector<std::string>{"HOLDS in every scene, solver paper: sample points less than one voxel inside"});
  EXPECT_EQ(verdicts.contact, std::vector<std::string>{
                                  "HOLDS in every scene, solver contact: no sample point inside, the nearest is 0.0155 "
                                  "mm from the surface; no pop-through"});
  ASSERT_EQ(verdicts.times.size(), 3u);
  EXPECT_EQ(verdicts.times[1], "HOLDS in every scene, solver contact: every cycle below 1 ms");
  EXPECT_EQ(verdicts.times[2],
            "HOLDS in every scene, solver paper: #2-#7 within 5 us (99th percentile); every cycle below 1 ms");
}

TEST(Claims, OfContactAreThatNothingPenetratesAtAll) {
  Entry e = entry(0.000001, 1.0, 0);
  EXPECT_EQ(judge({e}).compared.front().rfind("HOLDS", 0), 0u);
  e.solver = "contact";
  EXPECT_NE(
      judge({e}).contact.front().find("MISSED peg, solver contact: a sample point of the god object is up to 0.001 mm"),
      std::string::npos);
  e.statistics.penetration_max = 0.0;
  EXPECT_EQ(judge({e}).contact.front().rfind("HOLDS", 0), 0u);
}

TEST(Claims, ABodyBehindTheBarrierHasPoppedThroughThoughItsDepthIsSmall) {
  Entry e = entry(0.0005, 1.0, 0);
  e.crossing = Crossing{.distance = 0.1, .t = 1.7};
  const std::vector<std::string> verdicts = judge({e}).compared;
  EXPECT_NE(verdicts[0].find("MISSED peg, solver paper: the god object goes 100.0 mm behind the surface, at 1.700 s"),
            std::string::npos);
  for (const std::string& verdict : verdicts) EXPECT_EQ(verdict.find("no pop-through"), std::string::npos);
}

TEST(Claims, ADepthAtTheBandIsALowerBound) {
  Entry e = entry(0.006, 1.0, 0);
  e.statistics.depth_is_bound = true;
  EXPECT_NE(judge({e}).compared[0].find("at least 6.000 mm"), std::string::npos);
}

TEST(Table, HasTheSameFieldsInEveryLine) {
  const std::string csv = csv_table({entry(0.003, 1.25, 0), entry(0.0, 0.0, 0)});
  EXPECT_EQ(csv.rfind("scene,solver,penetration_max_mm,", 0), 0u);
  EXPECT_NE(csv.find("\npeg,paper,3.000,0.000,1.50,0.00,"), std::string::npos) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 3 * static_cast<std::ptrdiff_t>(columns().size() - 1));
}

TEST(Table, HeadsLengthsForcesAndTimesWithTheirUnits) {
  for (const Column& column : columns()) {
    const std::string name = column.name;
    const std::string heading = column.heading;
    for (const auto& [ending, unit] :
         {std::pair("_mm", "[mm]"), {"_n", "[N]"}, {"_us", "[us]"}, {"_voxels", "[voxels]"}}) {
      EXPECT_TRUE(!name.ends_with(ending) || heading.ends_with(unit)) << name << ": " << heading;
    }
  }
}

TEST(Table, LinesUpOnATerminalOf120Characters) {
  Entry widest = entry(-0.003, 1234.56, 1234);
  widest.scene = "bunny-teapot";
  widest.solver = "corrected";
  widest.statistics.peak_force = 12345.6;
  widest.statistics.force_step = 1234.5;
  widest.statistics.peak_contacts = 5587;
  widest.statistics.step1 = {1234.56, 12345.67, 0.0};
  widest.crossing = Crossing{.distance = 0.1234, .t = 0.0};
  const std::string text = text_table({widest, entry(0.0, 0.0, 0)});
  const std::size_t width = text.find('\n');
  EXPECT_LE(width, 120u);
  for (std::size_t line = 0; line < 3; ++line) EXPECT_EQ(text[(line + 1) * (width + 1) - 1], '\n') << line;
  for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1)
    EXPECT_LE(text.find('\n', begin) - begin, 120u);
}

}  // namespace
}  // namespace godobject::figures
