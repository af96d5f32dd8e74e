// The whole controller on the simulated robot with a hand that presses, rubs, shoots and plugs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/closed_loop/simulated_run.h"
#include "tests/support/small_scenes.h"

namespace godobject::firmware {
namespace {

TEST(ClosedLoopContact, HoldsAPressAtRestAsSpringsInSeries) {
  const test::SceneImage image = test::ball_over_plate();
  SimulatedRun::Options options;
  const std::vector<Waypoint> press{{0.0, {0.0, 0.0, 0.06}}, {0.5, {0.0, 0.0, 0.01}}};
  options.path = path_through(press);
  SimulatedRun run(image, options);
  run.run(3000);
  EXPECT_EQ(run.controller().record().fault, Fault::kNone);
  EXPECT_EQ(run.violation(), "");
  // the hand's 300 N/m pull it 20 mm below the surface, 2000 N/m hold against it: 300 * 2000 / 2300 * 0.02 N
  const SimulatedCycle& rest = run.cycles[2990];
  EXPECT_NEAR(rest.record.wrench_R.force.z(), 5.2, 0.4);
  EXPECT_NEAR(rest.record.god_object_W.translation.z(), 0.03, 2e-4);
  double step = 0.0;
  double moved = 0.0;
  for (std::size_t i = 2500; i < 2990; ++i) {
    const Vector3 change = run.cycles[i].record.wrench_R.force - run.cycles[i - 1].record.wrench_R.force;
    step = std::max(step, change.norm());
    moved = std::max(moved, (run.cycles[i].tool_R - rest.tool_R).norm());
  }
  EXPECT_LT(step, 0.05) << "no chatter";
  EXPECT_LT(moved, 5e-4) << "the hand's arm swings out";
}

TEST(ClosedLoopContact, RubsOnAPlateForAMinuteWithoutReachingALimit) {
  const test::SceneImage image = test::ball_over_plate();
  SimulatedRun::Options options;
  const std::vector<Waypoint> press{{0.0, {0.0, 0.0, 0.06}}, {0.5, {0.0, 0.0, 0.01}}};
  options.path = path_through(press);
  for (int k = 0; k < 59'000; ++k) {
    const double angle = 2.0 * M_PI * k / 1000.0;
    options.path.push_back(
        {0.02 * std::sin(angle), 0.02 - 0.02 * std::cos(angle), 0.01 + 0.005 * std::sin(0.7 * angle)});
  }
  SimulatedRun run(image, options);
  run.run(60'000);
  EXPECT_EQ(run.controller().record().fault, Fault::kNone) << describe(run.controller().record().fault);
  EXPECT_EQ(run.violation(), "");
  const CycleCounters& counters = run.controller().counters();
  EXPECT_EQ(counters.clipped + counters.slowed + counters.scaled, 0u);
  EXPECT_EQ(counters.lost + counters.jumps + counters.overruns + counters.sends_failed, 0u);
  EXPECT_GT(run.report.in_contact, 55'000u);
  EXPECT_LT(run.report.largest_force, 25.0);
  double deepest = 0.0;
  for (const SimulatedCycle& cycle : run.cycles) {
    if (cycle.record.share == 1.0) deepest = std::max(deepest, 0.03 - cycle.record.god_object_W.translation.z());
  }
  // between the ball's points, 3 mm apart, its surface stands out by 0.06 mm; a margin and the ripple of the field
  EXPECT_LT(deepest, 2e-4) << "the god object stays on the plate";
}

TEST(ClosedLoopContact, DoesNotShootThroughAThinPlate) {
  const test::SceneImage image = test::ball_over_plate(0.002);  // two voxels
  SimulatedRun::Options options;
  const std::vector<Waypoint> shots{{0.0, {0.0, 0.0, 0.06}}, {0.20, {0.0, 0.0, -0.04}},  {0.40, {0.0, 0.0, -0.04}},
                                    {0.6, {0.0, 0.0, 0.06}}, {0.75, {0.01, 0.0, -0.05}}, {1.0, {0.02, 0.0, -0.05}},
                                    {1.3, {0.0, 0.0, 0.06}}};
  options.path = path_through(shots);
  SimulatedRun run(image, options);
  run.run(2200);
  EXPECT_EQ(run.controller().record().fault, Fault::kNone) << describe(run.controller().record().fault);
  EXPECT_EQ(run.violation(), "");
  double lowest = 1.0;
  for (const SimulatedCycle& cycle : run.cycles) {
    if (cycle.record.share > 0.0) lowest = std::min(lowest, cycle.record.god_object_W.translation.z());
  }
  EXPECT_GT(lowest, 0.022 - 2e-4) << "a ball of 20 mm on a face at 2 mm";
  EXPECT_GT(run.report.largest_force, 8.0);
}

TEST(ClosedLoopContact, PlugsABallIntoAHoleOneVoxelWider) {
  const test::SceneImage image = test::ball_over_hole();
  SimulatedRun::Options options;
  const std::vector<Waypoint> plug{{0.0, {0.0, 0.0, 0.06}},        {0.6, {0.0004, 0.0, 0.035}},
                                   {1.4, {0.001, -0.0005, -0.01}}, {1.8, {0.006, 0.0, -0.01}},
                                   {2.2, {-0.004, -0.004, 0.0}},   {2.8, {0.0, 0.0, 0.06}}};
  options.path = path_through(plug);
  SimulatedRun run(image, options);
  run.run(3600);
  EXPECT_EQ(run.controller().record().fault, Fault::kNone) << describe(run.controller().record().fault);
  EXPECT_EQ(run.violation(), "");
  double widest = 0.0;
  double lowest = 1.0;
  for (const SimulatedCycle& cycle : run.cycles) {
    const Vector3& p = cycle.record.god_object_W.translation;
    if (cycle.record.share == 0.0) continue;
    lowest = std::min(lowest, p.z());
    if (p.z() < 0.02) widest = std::max(widest, std::hypot(p.x(), p.y()));
  }
  EXPECT_LT(lowest, -0.005) << "it went in";
  EXPECT_LT(widest, 0.001 + 2e-4) << "and stayed off the wall, to a fifth of a voxel";
  EXPECT_LT((run.cycles[3500].record.H_WM.translation - Vector3(0.0, 0.0, 0.06)).norm(), 0.01);
}

TEST(ClosedLoopContact, IsUnstableBeyondTheBoundaryThatTheGainsAreCheckedAgainst) {
  // the springs of the coupling far above it: the press does not come to rest, and limits or supervisor step in
  const test::SceneImage image = test::ball_over_plate();
  SimulatedRun::Options options;
  const std::vector<Waypoint> press{{0.0, {0.0, 0.0, 0.06}}, {0.5, {0.0, 0.0, 0.01}}};
  options.path = path_through(press);
  options.scene_stiffness = 60'000.0;
  SimulatedRun run(image, options);
  run.run(3000);
  EXPECT_EQ(run.violation(), "");
  double moved = 0.0;
  for (std::size_t i = 2500; i < std::min<std::size_t>(2990, run.cycles.size()); ++i) {
    moved = std::max(moved, (run.cycles[i].tool_R - run.cycles[2490].tool_R).norm());
  }
  EXPECT_TRUE(moved > 1e-4 || run.controller().record().fault != Fault::kNone);
}

}  // namespace
}  // namespace godobject::firmware
