// The operator's clutch on the simulated robot: the tool moves and the ball rests, and no force jumps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/closed_loop/simulated_run.h"
#include "tests/support/small_scenes.h"

namespace godobject::firmware {
namespace {

using sim::DriveFault;
using sim::FaultKind;

/// Largest changes of the force at the hand from one cycle to the next while it renders at full [N].
struct Steps {
  double while_open = 0.0;  ///< from the cycle in which the clutch opens to the last before it closes
  double on_closing = 0.0;  ///< to the cycle in which it closes
  double without_it = 0.0;
};

Steps force_steps(const SimulatedRun& run) {
  Steps steps;
  for (std::size_t i = 1; i < run.cycles.size(); ++i) {
    const CycleRecord& before = run.cycles[i - 1].record;
    const CycleRecord& now = run.cycles[i].record;
    if (before.mode != Mode::kRunning || now.mode != Mode::kRunning) continue;
    const double step = (now.F_G_R.force - before.F_G_R.force).norm();
    double& largest = now.clutch_is_open      ? steps.while_open
                      : before.clutch_is_open ? steps.on_closing
                                              : steps.without_it;
    largest = std::max(largest, step);
  }
  return steps;
}

const SimulatedCycle& at(const SimulatedRun& run, std::int64_t number) {
  return *std::find_if(run.cycles.begin(), run.cycles.end(), [&](const auto& c) { return c.number >= number; });
}

TEST(Clutch, MovesTheToolWhileTheBallRestsAndGoesOnFromThere) {
  const test::SceneImage image = test::ball_over_plate();
  SimulatedRun::Options options;
  // down to 10 mm over the plate; 50 mm up with the clutch open; down onto the plate, which is so much higher in the
  // room
  const std::vector<Waypoint> path{
      {0.0, {0.0, 0.0, 0.06}}, {0.6, {0.0, 0.0, 0.045}}, {1.2, {0.03, 0.0, 0.09}}, {2.2, {0.03, 0.0, 0.06}}};
  options.path = path_through(path);
  options.faults = {{FaultKind::kClutchOpen, sim::kAllJoints, 1050, 600}};
  SimulatedRun run(image, options);
  run.run(3700);
  EXPECT_EQ(run.controller().record().fault, Fault::kNone) << describe(run.controller().record().fault);
  EXPECT_EQ(run.violation(), "");
  const Vector3 opened = at(run, 1049).record.H_WM.translation;
  for (std::int64_t k = 1050; k < 1650; ++k) {
    ASSERT_TRUE(at(run, k).record.clutch_is_open) << k;
    ASSERT_LT((at(run, k).record.H_WM.translation - opened).norm(), 2e-4) << "the ball rests";
  }
  const double up = at(run, 1650).tool_R.z() - at(run, 1050).tool_R.z();
  EXPECT_GT(up, 0.03) << "the tool moved";
  // in the end the hand would have the ball as much lower as the tool went up: a press on springs in series
  const SimulatedCycle& rest = at(run, 3690);
  EXPECT_NEAR(rest.record.F_G_R.force.z(), 300.0 * 2000.0 / 2300.0 * (0.03 - (0.06 - up)), 0.3);
  const Steps steps = force_steps(run);
  std::printf("[ measured ] opening %.3f N, closing %.3f N, otherwise %.3f N a cycle\n", steps.while_open,
              steps.on_closing, steps.without_it);
  EXPECT_LT(std::max(steps.while_open, steps.on_closing), 0.05);
}

TEST(Clutch, WaitsUntilTheHandLeansOnNothing) {
  const test::SceneImage image = test::ball_over_plate();
  SimulatedRun::Options options;
  const std::vector<Waypoint> path{
      {0.0, {0.0, 0.0, 0.06}}, {0.5, {0.0, 0.0, 0.01}}, {2.4, {0.0, 0.0, 0.01}}, {3.0, {0.0, 0.0, 0.05}}};
  options.path = path_through(path);
  SimulatedRun plain(image, options);
  plain.run(3800);
  options.faults = {{FaultKind::kClutchOpen, sim::kAllJoints, 2300, 1200}};  // it rests, pressed with 5 N
  SimulatedRun run(image, options);
  run.run(3800);
  EXPECT_EQ(run.controller().record().fault, Fault::kNone);
  EXPECT_EQ(run.violation(), "");
  ASSERT_GT(at(run, 2300).record.F_G_R.force.norm(), 4.0);
  std::int64_t opened = 0;
  for (std::size_t i = 0; i < run.cycles.size() && opened == 0; ++i) {
    if (run.cycles[i].record.clutch_is_open) {
      opened = run.cycles[i].number;
    } else {
      ASSERT_EQ(run.cycles[i].record.torque, plain.cycles[i].record.torque) << "as if it had not been asked for";
    }
  }
  ASSERT_GT(opened, 2800) << "on the hand's way up";
  EXPECT_LT(at(run, opened - 1).record.F_G_R.force.norm(), 0.5);
  EXPECT_FALSE(at(run, 3500).record.clutch_is_open);
  const Steps steps = force_steps(run);
  std::printf("[ measured ] opened in cycle %lld; opening %.3f N, closing %.3f N, otherwise %.3f N a cycle\n",
              static_cast<long long>(opened), steps.while_open, steps.on_closing, steps.without_it);
  EXPECT_LT(steps.while_open, 0.1);
  EXPECT_LT(steps.on_closing, 0.05);
}

/// In whichever cycles it opens and closes, in contact, sliding along the plate and off it.
TEST(Clutch, NeverLetsAForceJump) {
  const test::SceneImage image = test::ball_over_plate();
  Steps largest;
  for (std::int64_t begin = 900; begin < 2000; begin += 170) {
    SimulatedRun::Options options;
    const std::vector<Waypoint> path{{0.0, {0.0, 0.0, 0.06}},
                                     {0.5, {0.0, 0.0, 0.02}},
                                     {0.9, {0.02, 0.0, 0.034}},
                                     {1.3, {0.0, 0.01, 0.02}},
                                     {1.7, {0.02, 0.01, 0.05}}};
    options.path = path_through(path);
    options.faults = {{FaultKind::kClutchOpen, sim::kAllJoints, begin, 90},
                      {FaultKind::kClutchOpen, sim::kAllJoints, begin + 110, 300}};
    SimulatedRun run(image, options);
    run.run(2600);
    EXPECT_EQ(run.controller().record().fault, Fault::kNone) << begin;
    EXPECT_EQ(run.violation(), "") << begin;
    const Steps steps = force_steps(run);
    // a 200th of less than engage_force, and what a hand changes in a millisecond of it
    EXPECT_LT(steps.while_open, 0.1) << begin;
    EXPECT_LT(steps.on_closing, 0.05) << begin;
    EXPECT_LT(steps.without_it, 2.0) << begin;
    largest.while_open = std::max(largest.while_open, steps.while_open);
    largest.on_closing = std::max(largest.on_closing, steps.on_closing);
    largest.without_it = std::max(largest.without_it, steps.without_it);
  }
  std::printf("[ measured ] opening %.3f N, closing %.3f N, otherwise %.3f N a cycle\n", largest.while_open,
              largest.on_closing, largest.without_it);
}

}  // namespace
}  // namespace godobject::firmware
