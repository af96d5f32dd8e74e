// The controller's CAN drives against the simulated ones, each written from the standard for itself.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>

#include "hal/cia402/bus_plan.h"
#include "hal/cia402/can_drives.h"
#include "sim/can_device.h"
#include "tests/sim/small_master.h"
#include "tests/support/arms.h"

namespace godobject::sim {
namespace {

/// The controller's end of everything, over a simulated device.
struct Loop {
  hal::BusLayout layout;
  std::array<JointHardwareParameters, kMaxJoints> hardware;
  Plant& plant;
  std::unique_ptr<CanDevice> device;
  std::array<hal::CanBus*, hal::kMaxBuses> wires{};
  std::unique_ptr<VirtualClock> clock;
  hal::BusPlan plan;
  std::optional<hal::CanDrives> drives;
  hal::JointReading reading;

  Loop(const ArmModel& arm, const hal::BusLayout& on, Plant& body, const CanScript& script = {})
      : layout(on), hardware(usual_hardware(arm)), plant(body) {
    device = std::make_unique<CanDevice>(plant, layout, hardware, script);
    clock = std::make_unique<VirtualClock>(*device);
    for (int i = 0; i < layout.bus_count; ++i) wires.at(static_cast<std::size_t>(i)) = &device->bus(i);
    plan = hal::plan_buses(layout);
    drives.emplace(layout, std::span(wires.data(), static_cast<std::size_t>(layout.bus_count)), plan.timing);
  }

  hal::BringUpResult bring_up() {
    const hal::BringUpResult result = drives->bring_up(*clock);
    clock->sleep_until((device->now_ns() / 1'000'000 + 1) * 1'000'000);
    return result;
  }

  void cycle(const JointVector& torque, hal::PowerRequest power = hal::PowerRequest::kEnable) {
    const std::int64_t begin_ns = device->now_ns();
    drives->request();
    clock->sleep_until(begin_ns + drives->collect_ns());
    drives->receive(reading);
    EXPECT_TRUE(drives->send({torque, power}));
    clock->sleep_until(begin_ns + 1'000'000);
  }
};

TEST(CanLoop, DrivesOfTheArmComeUpAndTakeTorque) {
  const ArmModel arm = test::lwr().model;
  Plant plant(arm, JointVector::Zero());
  Loop loop(arm, test::layout_of(arm), plant);
  const hal::BringUpResult result = loop.bring_up();
  ASSERT_EQ(result.status, hal::BringUpStatus::kOk)
      << describe(result.status) << " bus " << result.bus << " node " << result.node << std::hex << " object "
      << result.index << ':' << int{result.subindex} << " expected " << result.expected << " found " << result.found;
  for (int i = 0; i < 100; ++i) loop.cycle(plant.gravity_torque());
  EXPECT_EQ(loop.reading.alarm, hal::Alarm::kNone);
  EXPECT_FALSE(loop.reading.emergency_stop);
  EXPECT_TRUE(loop.reading.enable_switch);
  for (int i = 0; i < 7; ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_EQ(loop.reading.state.at(at), hal::DriveState::kEnabled);
    EXPECT_EQ(loop.reading.age.at(at), 0u);
    const hal::DriveConfig& drive = loop.layout.drives.at(at);
    EXPECT_NEAR(loop.reading.position[i], plant.positions()[i], 2.1 * M_PI / (drive.counts * drive.gear));
    EXPECT_NEAR(loop.reading.torque[i], plant.gravity_torque()[i], 1.01e-3 * drive.gear * drive.rated_torque);
  }
  EXPECT_EQ(loop.drives->statistics().malformed, 0u);
  for (const auto lost : loop.drives->statistics().lost) EXPECT_EQ(lost, 0u);
}

}  // namespace
}  // namespace godobject::sim
