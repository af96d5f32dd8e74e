// Compares the controller behind CAN with the same controller on drives without a bus that have the bus plan's delays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "hal/cia402/bus_plan.h"
#include "tests/closed_loop/can_run.h"
#include "tests/support/small_scenes.h"

namespace godobject::firmware {
namespace {

constexpr double kBegin = 4.2;     // of the hand's path [s]
constexpr double kHoldFrom = 4.0;  // the enable switch [s]
constexpr int kCompared = 1000;    // cycles from the first contact on

/// Returns a path that goes down to the plate, 20 mm into it, and along the plate in circles.
std::vector<Vector3> circling() {
  const std::vector<Waypoint> waypoints{{0.0, {0.0, 0.0, 0.06}}, {0.4, {0.0, 0.0, 0.01}}};
  std::vector<Vector3> path = path_through(waypoints);
  for (int k = 0; k < 2500; ++k) {
    const double angle = 2.0 * M_PI * k / 1200.0;
    path.push_back({0.02 * std::sin(angle), 0.02 - 0.02 * std::cos(angle), 0.01});
  }
  return path;
}

/// Returns the times at which joints are sampled and torques act if each frame has its greatest length and none waits.
sim::DriveTiming timing_of(const hal::BusLayout& layout) {
  const hal::BusPlan plan = hal::plan_buses(layout);
  sim::DriveTiming timing;
  timing.delay_ns = 0;
  timing.enable_ns = std::llround(1e9 * kHoldFrom);
  timing.collect_ns = plan.timing.collect_ns;
  for (std::size_t i = 0; i < static_cast<std::size_t>(layout.joint_count); ++i) {
    timing.sampled_ns[i] = plan.buses[static_cast<std::size_t>(layout.drives[i].bus)].sync_ns;
    timing.acts_ns[i] = timing.sampled_ns[i] + plan.unblocked_ns[i];
  }
  return timing;
}

std::vector<SimulatedCycle> direct_run(const test::SceneImage& scene, const sim::DriveTiming& timing,
                                       std::int64_t cycles) {
  SimulatedRun::Options options;
  options.path = circling();
  options.begin = kBegin;
  options.timing = timing;
  options.enable_ns += 2'000'000;  // enabling a CiA 402 drive takes three controlwords, one a cycle
  SimulatedRun run(scene, options);
  run.run(cycles);
  return run.cycles;
}

/// Returns the largest difference of joint positions between two runs, over kCompared cycles, in encoder steps.
double apart(const std::vector<CanRun::Cycle>& can, const std::vector<SimulatedCycle>& direct, std::int64_t from) {
  constexpr double kStep = 2.0 * M_PI / (1 << 20);  // [rad]
  double most = 0.0;
  for (const CanRun::Cycle& cycle : can) {
    if (cycle.number >= from + kCompared) break;
    const SimulatedCycle& other = direct.at(static_cast<std::size_t>(cycle.number));
    EXPECT_EQ(other.number, cycle.number);
    most = std::max(most, (cycle.record.q - other.record.q).cwiseAbs().maxCoeff() / kStep);
  }
  return most;
}

TEST(BusDelay, ArmMovesAsOnDrivesWithThePlansDelays) {
  const test::SceneImage plate = test::ball_over_plate();
  CanRun::Options options;
  options.path = circling();
  options.begin = kBegin;
  options.hold_from = kHoldFrom;
  options.quiet = true;
  CanRun can(plate, options);
  const hal::BringUpResult result = can.bring_up();
  ASSERT_EQ(result.status, hal::BringUpStatus::kOk) << describe(result.status) << ' ' << result.node;
  can.run(2000);

  const auto touches = [](const CanRun::Cycle& cycle) { return cycle.record.contacts > 0; };
  const auto first = std::ranges::find_if(can.cycles, touches);
  ASSERT_GE(can.cycles.end() - first, kCompared);
  const auto contacts = std::count_if(first, first + kCompared, touches);
  EXPECT_GT(contacts, kCompared / 2);

  sim::DriveTiming timing = timing_of(can.layout());
  const std::int64_t cycles = first->number + kCompared + 1;
  const double most = apart(can.cycles, direct_run(plate, timing, cycles), first->number);
  std::printf(
      "%d cycles from the first contact on, %ld in contact: positions differ by %.2f steps of the encoder at most\n",
      kCompared, static_cast<long>(contacts), most);
  EXPECT_LT(most, 1.5);

  // the comparison is sensitive: 5 us more for the torque of one joint show
  timing.acts_ns[1] += 5'000;
  const double off = apart(can.cycles, direct_run(plate, timing, cycles), first->number);
  std::printf("torque of joint 2 later by 5 us: %.0f steps\n", off);
  EXPECT_GT(off, 3.0);
}

}  // namespace
}  // namespace godobject::firmware
