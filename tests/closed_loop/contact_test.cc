// The whole controller on the simulated robot with a hand that presses, rubs, shoots and plugs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <vector>

#include "core/device/dynamics.h"
#include "core/device/kinematics.h"
#include "core/device/stability.h"
#include "firmware/configuration/gain_check.h"
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
  EXPECT_NEAR(rest.record.F_G_R.force.z(), 5.2, 0.4);
  EXPECT_NEAR(rest.record.god_object_W.translation.z(), 0.03, 2e-4);
  double step = 0.0;
  double moved = 0.0;
  for (std::size_t i = 2500; i < 2990; ++i) {
    const Vector3 change = run.cycles[i].record.F_G_R.force - run.cycles[i - 1].record.F_G_R.force;
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

/// Presses the tool on the plate with the damping of a soft hand; from cycle `lets_go` on a little harder and undamped.
Wrench lowers_and_lets_go(std::int64_t cycle, const sim::BodyState& tool, const Vector3& normal_R,
                          std::int64_t lets_go = 1500) {
  if (cycle < 400) return {};
  if (cycle >= lets_go) return {-3.1 * normal_R, Vector3::Zero()};
  return {-3.0 * normal_R - 40.0 * tool.velocity.translation, -0.05 * tool.velocity.rotation};
}

/// Extent of the tool's motion along the plate's normal in [from, from + 300).
double swing(const SimulatedRun& run, std::int64_t from, const Vector3& normal_R) {
  double low = 1e9;
  double high = -1e9;
  for (const SimulatedCycle& cycle : run.cycles) {
    if (cycle.number < from || cycle.number >= from + 300) continue;
    low = std::min(low, normal_R.dot(cycle.tool_R));
    high = std::max(high, normal_R.dot(cycle.tool_R));
  }
  return high - low;
}

/// Returns the theory's loop for an arm that a spring holds along the plate's normal only.
ArmLoop held_along(const SimulatedRun& run, const Vector3& normal_R) {
  const ArmModel& arm = run.device().model;
  const ArmKinematics kinematics = forward_kinematics(arm, run.plant().positions());
  const auto felt = FeltCoupling::of(run.scene(), 1.0);
  ArmLoop loop;
  loop.joint_count = arm.joint_count;
  loop.mass = mass_matrix(arm, kinematics);
  for (int i = 0; i < arm.joint_count; ++i) loop.damping[i] = arm.joints[static_cast<std::size_t>(i)].damping;
  // the spring may have any row
  const Jacobian J = geometric_jacobian(kinematics, kinematics.H_RM.translation);
  loop.jacobian.row(0) = normal_R.transpose() * J.topRows<3>();
  loop.stiffness = felt.stiffness;
  loop.tool_damping = felt.damping;
  loop.timing = {CycleSetup().period, run.delay(), SimulatedRun::kVelocityWindow};
  return loop;
}

/// Here about a fifth of the boundary's stiffness more is still calm: the ball rolls, its contact goes from sample
/// point to sample point, 3 mm apart, and each change takes energy, some 0.17 of the amplitude's logarithm a second. It
/// is neither friction nor rounding, and of gravity little: see ClosedLoopBoundary, where nothing rolls.
TEST(ClosedLoopContact, ComesToRestBelowTheExactBoundaryAndDoesNotAboveIt) {
  const test::SceneImage image = test::ball_over_plate();
  SimulatedRun::Options options;
  options.load = [](std::int64_t cycle, const sim::BodyState& tool) {
    return lowers_and_lets_go(cycle, tool, Vector3::UnitZ());
  };
  options.friction = false;
  SimulatedRun soft(image, options);
  soft.run(1500);
  ASSERT_NEAR(soft.cycles[1490].record.F_G_R.force.z(), 3.0, 0.2) << "it lies on the plate";
  const ArmLoop loop = held_along(soft, Vector3::UnitZ());
  const double boundary = stiffness_margin(loop) * loop.stiffness;

  // the check at the start accepts less stiffness than the boundary
  const GainReport report = check_gains(soft.scene(), soft.device().model, soft.posture(), 1.0, loop.timing);
  EXPECT_LT(report.margin * loop.stiffness, boundary);
  for (const double share : {0.8, 1.4}) {
    options.scene_stiffness = share * boundary;
    SimulatedRun run(image, options);
    run.run(3000);
    EXPECT_EQ(run.violation(), "");
    const double growth = std::log(swing(run, 2650, Vector3::UnitZ()) / swing(run, 1600, Vector3::UnitZ()));
    std::printf("[ measured ] %.0f N/m, %.2f of the boundary: e^%.2f in 1050 cycles; the start allows %.0f N/m\n",
                options.scene_stiffness, share, growth, report.margin * loop.stiffness);
    if (share < 1.0) {
      EXPECT_LT(growth, -0.2);
      EXPECT_EQ(run.controller().record().fault, Fault::kNone);
    } else {
      EXPECT_GT(growth, 0.2);
    }
  }
}

/// A body of two sample points, one over the other: what pushes it goes through its middle, and it cannot roll.
test::SceneImage tip_over_plate() {
  const Vector3 half_edges(0.05, 0.05, 0.01);
  test::SceneDescription description;
  description.distance = [half_edges](const Vector3& p) { return test::box_distance(p, half_edges); };
  description.surface_min = -half_edges;
  description.surface_max = half_edges;
  description.voxel_size = 0.002;
  description.points = {Vector3(0.0, 0.0, -1e-3), Vector3(0.0, 0.0, 1e-3)};
  return test::build_scene_image(description);
}

/// Axis of the room across which the plate is; whether the arm has no weight.
class ClosedLoopBoundary : public testing::TestWithParam<std::tuple<int, bool>> {};

/// A4 through the whole controller: drives that round nothing, no dry friction, the tool on a plate across each axis of
/// the room. With weight the torque that holds the arm comes a delay late, which takes 0.01 to 0.05 of the amplitude's
/// logarithm a second that theory does not have.
TEST_P(ClosedLoopBoundary, TwoPercentBelowDecaysTwoPercentAboveGrows) {
  const auto [axis, weightless] = GetParam();
  const Vector3 normal = Vector3::Unit(axis);
  const test::SceneImage image = tip_over_plate();
  SimulatedRun::Options options;
  options.load = [&normal](std::int64_t cycle, const sim::BodyState& tool) {
    return lowers_and_lets_go(cycle, tool, normal, 2500);
  };
  options.friction = false;
  options.weightless = weightless;
  const Vector3 across = normal.cross(Vector3::UnitZ());  // the shortest turn from the normal to z
  options.turn = Quaternion(1.0 + normal.z(), across.x(), across.y(), across.z()).normalized();
  SimulatedRun soft(image, options);
  soft.run(2500);
  ASSERT_NEAR(soft.cycles[2490].record.F_G_R.force.dot(normal), 3.0, 0.5) << "it lies on the plate";
  ArmLoop loop = held_along(soft, normal);
  const double boundary = stiffness_margin(loop) * loop.stiffness;
  for (const double share : {0.98, 1.02}) {
    options.scene_stiffness = loop.stiffness = share * boundary;
    SimulatedRun run(image, options);
    run.run(5000);
    EXPECT_EQ(run.violation(), "");
    EXPECT_EQ(run.controller().record().fault, Fault::kNone);
    const double growth = std::log(swing(run, 4600, normal) / swing(run, 2600, normal));
    const double expected = 2000.0 * std::log(spectral_radius(loop));
    std::printf("[ measured ] axis %d%s, %.0f N/m, %.2f of the boundary: e^%.4f in 2000 cycles, by theory e^%.4f\n",
                axis, weightless ? ", weightless" : "", options.scene_stiffness, share, growth, expected);
    if (share < 1.0) {
      EXPECT_LT(growth, 0.0);
    } else {
      EXPECT_GT(growth, 0.0);
    }
    EXPECT_NEAR(growth, expected, weightless ? 0.04 : 0.12);
  }
}

INSTANTIATE_TEST_SUITE_P(Axes, ClosedLoopBoundary, testing::Combine(testing::Values(0, 1, 2), testing::Bool()));

}  // namespace
}  // namespace godobject::firmware
