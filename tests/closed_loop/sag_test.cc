// A STOP of the whole controller, with nobody at the tool: how far the arm sinks before its brakes hold.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "tests/closed_loop/simulated_run.h"
#include "tests/support/small_scenes.h"

namespace godobject::firmware {
namespace {

using sim::FaultKind;

constexpr std::int64_t kStop = 1200;  ///< cycle of the stop
constexpr std::int64_t kSagEnd = 2200;
constexpr double kAllowed = 5e-3;  ///< [m]

struct Way {
  const char* name;
  std::vector<sim::DriveFault> faults;
};

class Sag : public testing::TestWithParam<Way> {};

std::vector<Way> ways() {
  const std::int64_t for_good = kSagEnd;
  return {{"EmergencyStop", {{FaultKind::kEmergencyStop, sim::kAllJoints, kStop, for_good, 0.0}}},
          {"EnableSwitchReleased", {{FaultKind::kEnableReleased, sim::kAllJoints, kStop, for_good, 0.0}}},
          {"PositionsLost", {{FaultKind::kReadingLost, sim::kAllJoints, kStop, for_good, 0.0}}},
          {"CommandsLost", {{FaultKind::kCommandLost, sim::kAllJoints, kStop, for_good, 0.0}}},
          {"OneDriveTrips", {{FaultKind::kDriveTrips, 1, kStop, for_good, 0.0}}},
          {"AllDrivesTrip", {{FaultKind::kDriveTrips, sim::kAllJoints, kStop, for_good, 0.0}}},
          {"AllDrivesOff", {{FaultKind::kDriveDisabled, sim::kAllJoints, kStop, for_good, 0.0}}},
          {"SupplyLost", {{FaultKind::kSupplyLost, sim::kAllJoints, kStop, for_good, 0.0}}}};
}

TEST_P(Sag, StaysWithinFiveMillimetres) {
  static const test::SceneImage image = test::ball_over_plate();
  SimulatedRun::Options options;
  options.load = [](std::int64_t, const sim::BodyState&) { return Wrench{}; };
  options.faults = GetParam().faults;
  SimulatedRun run(image, options);
  run.run(kSagEnd);

  double before = 0.0;
  double lowest = 0.0;
  for (const SimulatedCycle& cycle : run.cycles) {
    if (cycle.number == kStop - 1) {
      ASSERT_EQ(cycle.record.mode, Mode::kRunning);
      lowest = before = cycle.tool_R.z();
    }
    if (cycle.number >= kStop) lowest = std::min(lowest, cycle.tool_R.z());
  }
  std::printf("[ measured ] %s: the tool sinks by %.4f mm\n", GetParam().name, 1e3 * (before - lowest));
  EXPECT_LT(before - lowest, kAllowed);
  EXPECT_TRUE(run.plant().velocities().isZero(0.0)) << "the brakes hold";
  EXPECT_NE(run.controller().record().mode, Mode::kRunning);
}

INSTANTIATE_TEST_SUITE_P(Stop, Sag, testing::ValuesIn(ways()),
                         [](const auto& way) { return std::string(way.param.name); });

}  // namespace
}  // namespace godobject::firmware
