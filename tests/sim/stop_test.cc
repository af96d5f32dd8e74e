// Stops of the arm by its drives: the distance that the tool travels until the brakes hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "sim/direct_drives.h"
#include "tests/sim/one_joint.h"
#include "tests/support/arms.h"

namespace godobject::sim {
namespace {

using hal::DriveState;
using hal::PowerRequest;
using test::Arm;
using test::kPeriod_ns;
using test::Random;

struct Stop {
  double sag = 0.0;      ///< farthest from where the stop began [m]
  double seconds = 0.0;  ///< until it moved no more
  bool off = true;       ///< all drives ended where they should
};

/// An arm that rests under gravity compensation and is stopped in cycle 100. `speed`: of its joints just before
/// [rad/s].
Stop stop(const Arm& arm, const JointVector& q, const JointVector& qd, PowerRequest request,
          std::span<const DriveFault> script, DriveState end) {
  Plant plant(arm.model, q);
  const auto hardware = usual_hardware(arm.model);
  DirectDrives drives(plant, hardware, {}, script);
  VirtualClock clock(drives);
  hal::JointReading reading;
  hal::JointCommand command;
  command.power = PowerRequest::kEnable;
  Vector3 begun = Vector3::Zero();
  Stop result;
  for (int cycle = 0; cycle < 1100; ++cycle) {
    drives.receive(reading);
    command.torque = plant.gravity_torque();
    if (cycle == 100) {
      EXPECT_EQ(reading.state[0], script.empty() ? DriveState::kEnabled : DriveState::kUnavailable);
      command.power = request;
      plant.set_velocity(qd);
      begun = plant.tool().pose.translation;
    }
    EXPECT_TRUE(drives.send(command));
    clock.sleep_until((cycle + 1) * kPeriod_ns);
    if (cycle < 100) continue;
    result.sag = std::max(result.sag, (plant.tool().pose.translation - begun).norm());
    if (!plant.velocities().isZero(0.0)) result.seconds = 1e-3 * (cycle - 99);
  }
  drives.receive(reading);
  for (int i = 0; i < arm.model.joint_count; ++i) {
    result.off = result.off && reading.state.at(static_cast<std::size_t>(i)) == end;
  }
  EXPECT_TRUE(plant.velocities().isZero(0.0)) << "the brakes hold";
  return result;
}

enum class Way { kQuickStop, kOff, kSupplyLost };

Stop worst(const Arm& arm, Way way, double tool_speed, unsigned seed) {
  Random random(seed);
  Stop worst;
  for (int i = 0; i < 12; ++i) {
    const JointVector q = 0.8 * test::random_positions(random, arm.model);
    const Plant plant(arm.model, q);
    JointVector qd = test::random_joints(random, arm.model, 1.0);
    qd *= tool_speed / plant.arm().tool_velocity(plant.posture(), qd).translation.norm();
    const std::vector<DriveFault> lost = {{FaultKind::kSupplyLost, kAllJoints, 100, 100000, 0.0}};
    const bool supply = way == Way::kSupplyLost;
    const Stop found = stop(arm, q, qd, way == Way::kQuickStop ? PowerRequest::kQuickStop : PowerRequest::kOff,
                            supply ? std::span<const DriveFault>(lost) : std::span<const DriveFault>(),
                            supply ? DriveState::kUnavailable : DriveState::kOff);
    EXPECT_TRUE(found.off);
    worst.sag = std::max(worst.sag, found.sag);
    worst.seconds = std::max(worst.seconds, found.seconds);
  }
  return worst;
}

void report(const char* what, const Stop& stop) {
  std::printf("[ measured ] %s: %.4f mm at the tool, %.0f ms\n", what, 1e3 * stop.sag, 1e3 * stop.seconds);
}

TEST(Stop, GravityIsHeldUntilTheBrakesHold) {
  const Stop lwr = worst(test::lwr(), Way::kQuickStop, 0.0, 1);
  const Stop desktop = worst(test::desktop6(), Way::kQuickStop, 0.0, 2);
  report("lwr, quick stop at rest", lwr);
  report("desktop6, quick stop at rest", desktop);
  EXPECT_LT(lwr.sag, 0.5e-3);
  EXPECT_LT(desktop.sag, 0.5e-3);
}

/// At 0.2 m/s a stop with the drives' own loops of 100 rad/s takes about 0.2 / (100 / 2) m.
TEST(Stop, ArmThatMovesIsBroughtToRest) {
  const Stop lwr = worst(test::lwr(), Way::kQuickStop, 0.2, 3);
  const Stop desktop = worst(test::desktop6(), Way::kQuickStop, 0.2, 4);
  report("lwr, quick stop at 0.2 m/s", lwr);
  report("desktop6, quick stop at 0.2 m/s", desktop);
  EXPECT_LT(lwr.sag, 15e-3);
  EXPECT_LT(desktop.sag, 15e-3);
}

/// Limp for the 20 ms that the brakes take: g t^2/2 is 2 mm, more where the tool falls faster than freely.
TEST(Stop, TorqueOffIsLimpUntilTheBrakesHold) {
  const Stop lwr = worst(test::lwr(), Way::kOff, 0.0, 5);
  const Stop desktop = worst(test::desktop6(), Way::kOff, 0.0, 6);
  report("lwr, torque off", lwr);
  report("desktop6, torque off", desktop);
  EXPECT_LT(lwr.sag, 5e-3);
  EXPECT_LT(desktop.sag, 5e-3);
  EXPECT_GT(lwr.sag, 0.5e-3);
}

TEST(Stop, PowerLossIsLimpUntilTheBrakesHold) {
  const Stop lwr = worst(test::lwr(), Way::kSupplyLost, 0.0, 7);
  const Stop desktop = worst(test::desktop6(), Way::kSupplyLost, 0.0, 8);
  report("lwr, power loss", lwr);
  report("desktop6, power loss", desktop);
  EXPECT_LT(lwr.sag, 5e-3);
  EXPECT_LT(desktop.sag, 5e-3);
}

}  // namespace
}  // namespace godobject::sim
