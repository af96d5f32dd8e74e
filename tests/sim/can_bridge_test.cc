#include "sim/can_bridge.h"

#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "hal/cia402/bus_plan.h"
#include "hal/cia402/can_drives.h"
#include "tests/sim/small_master.h"
#include "tests/support/arms.h"

namespace godobject::sim {
namespace {

using test::can_frame;
using test::kMs;

/// Two ends of a bus without a wire: what one sends the other has at once, and the sender gets it back.
class Pipe {
 public:
  class End final : public hal::CanBus {
   public:
    hal::SendResult send(const hal::CanFrame& frame) noexcept override {
      peer->inbox.push_back({frame, 0, false});
      inbox.push_back({frame, 0, true});
      return hal::SendResult::kSent;
    }
    bool receive(hal::ReceivedFrame& received) noexcept override {
      if (inbox.empty()) return false;
      received = inbox.front();
      inbox.pop_front();
      return true;
    }
    hal::BusHealth health() const noexcept override { return {}; }
    End* peer = nullptr;
    std::deque<hal::ReceivedFrame> inbox;
  };
  Pipe() {
    controller.peer = &device;
    device.peer = &controller;
  }
  End controller;
  End device;
};

/// The same device twice over: with the controller's end of its wires, or behind a bridge.
struct BridgeBench {
  ArmModel arm = test::lwr().model;
  hal::BusLayout layout = test::layout_of(arm);
  std::array<JointHardwareParameters, kMaxJoints> hardware = usual_hardware(arm);
  Plant plant{arm, JointVector::Constant(0.2)};
  std::unique_ptr<CanDevice> device = std::make_unique<CanDevice>(plant, layout, hardware);
  hal::BusTiming timing = hal::plan_buses(layout).timing;
  std::array<Pipe, 3> pipes;
};

/// Time that passes as the controller sleeps; the bridge is polled as often as it wants, and when frames come.
class BridgedClock final : public hal::Clock {
 public:
  BridgedClock(CanBridge& bridge, std::int64_t step_ns) : bridge_(bridge), step_ns_(step_ns) {}
  std::int64_t now_ns() noexcept override { return now_ns_; }
  void sleep_until(std::int64_t ns) noexcept override {
    settle();
    while (now_ns_ < ns) {
      now_ns_ = std::min(ns, now_ns_ + step_ns_);
      settle();
    }
  }

 private:
  void settle() {
    while (bridge_.poll(now_ns_) <= now_ns_) {
    }
  }

  CanBridge& bridge_;
  std::int64_t step_ns_;
  std::int64_t now_ns_ = 0;
};

/// A controller that holds the arm and pushes it about.
struct Controller {
  hal::CanDrives drives;
  hal::Clock& clock;
  hal::JointReading reading{};
  std::vector<JointVector> positions;

  Controller(const BridgeBench& bench, std::span<hal::CanBus* const> buses, hal::Clock& time)
      : drives(bench.layout, buses, bench.timing), clock(time) {}

  void start() {
    const hal::BringUpResult result = drives.bring_up(clock);
    ASSERT_EQ(result.status, hal::BringUpStatus::kOk) << describe(result.status) << ' ' << result.node;
    clock.sleep_until((clock.now_ns() / kMs + 1) * kMs);
  }
  void run(int cycles, bool heartbeats_wait = false) {
    for (int i = 0; i < cycles; ++i) {
      const std::int64_t begin_ns = clock.now_ns();
      drives.request();
      clock.sleep_until(begin_ns + drives.collect_ns());
      drives.receive(reading);
      positions.push_back(reading.position);
      hal::JointCommand command;
      command.power = hal::PowerRequest::kEnable;
      for (int joint = 0; joint < 7; ++joint)
        command.torque[joint] = 3.0 * std::sin(0.01 * i + joint) - 20.0 * reading.position[joint];
      // behind more frames than a cycle takes there is no echo yet, and nothing is sent
      EXPECT_TRUE(drives.send(command) || heartbeats_wait) << i;
      clock.sleep_until(begin_ns + kMs);
    }
  }
};

std::vector<JointVector> in_process(int cycles) {
  BridgeBench bench;
  VirtualClock clock(*bench.device);
  const std::array<hal::CanBus*, 3> buses{&bench.device->bus(0), &bench.device->bus(1), &bench.device->bus(2)};
  Controller controller(bench, buses, clock);
  controller.start();
  controller.run(cycles);
  return controller.positions;
}

std::vector<JointVector> bridged(int cycles, std::int64_t step_ns) {
  BridgeBench bench;
  const std::array<hal::CanBus*, 3> outside{&bench.pipes[0].device, &bench.pipes[1].device, &bench.pipes[2].device};
  const std::array<hal::CanBus*, 3> buses{&bench.pipes[0].controller, &bench.pipes[1].controller,
                                          &bench.pipes[2].controller};
  CanBridge bridge(*bench.device, bench.layout, bench.timing, outside);
  BridgedClock clock(bridge, step_ns);
  Controller controller(bench, buses, clock);
  controller.start();
  controller.run(cycles);
  // the controller's probe leaves some SYNCs out
  EXPECT_EQ(bridge.counters().cycles, static_cast<std::uint64_t>(cycles - hal::CanDrives::kProbeSilent));
  EXPECT_EQ(bridge.counters().left_alone, 1u);
  EXPECT_EQ(bridge.counters().not_sent + bridge.counters().dropped, 0u);
  return controller.positions;
}

TEST(CanBridge, MovesTheDeviceAsAControllerInTheProcessDoes) {
  const auto direct = in_process(1000);
  ASSERT_EQ(direct.size(), 1000u);
  EXPECT_GT((direct.back() - direct[100]).cwiseAbs().maxCoeff(), 0.01) << "it is to move";
  for (const std::int64_t step_ns : {kMs, kMs / 5}) {
    const auto over = bridged(1000, step_ns);
    ASSERT_EQ(over.size(), direct.size());
    for (std::size_t i = 0; i < direct.size(); ++i) ASSERT_EQ(over[i], direct[i]) << "cycle " << i;
  }
}

TEST(CanBridge, GoesByTheClockWhenTheControllerIsGone) {
  BridgeBench bench;
  const std::array<hal::CanBus*, 3> outside{&bench.pipes[0].device, &bench.pipes[1].device, &bench.pipes[2].device};
  const std::array<hal::CanBus*, 3> buses{&bench.pipes[0].controller, &bench.pipes[1].controller,
                                          &bench.pipes[2].controller};
  CanBridge bridge(*bench.device, bench.layout, bench.timing, outside);
  BridgedClock clock(bridge, kMs / 5);
  Controller controller(bench, buses, clock);
  controller.start();
  controller.run(100);
  for (int i = 0; i < 7; ++i) ASSERT_EQ(bench.device->nodes().drive(i).state(), PowerState::kEnabled);
  const std::int64_t killed_ns = clock.now_ns();
  clock.sleep_until(killed_ns + 3 * kMs);
  for (int i = 0; i < 7; ++i) EXPECT_EQ(bench.device->nodes().drive(i).state(), PowerState::kEnabled);
  clock.sleep_until(killed_ns + 5 * kMs);
  for (int i = 0; i < 7; ++i) EXPECT_NE(bench.device->nodes().drive(i).state(), PowerState::kEnabled) << i;
  clock.sleep_until(killed_ns + 600 * kMs);
  EXPECT_TRUE(bench.plant.velocities().isZero(0.0));
  EXPECT_EQ(bridge.counters().left_alone, 2u);  // in the controller's probe, too
  // SIGCONT: it is in step again, and no drive takes up its torque by itself
  controller.run(4, /*heartbeats_wait=*/true);
  EXPECT_EQ(bridge.counters().cycles, 103u - hal::CanDrives::kProbeSilent) << "in one no bus has its echo yet";
  EXPECT_EQ(controller.reading.age[0], 0u);
}

TEST(CanBridge, BeginsWithoutTheSyncOfABusThatIsDead) {
  BridgeBench bench;
  const std::array<hal::CanBus*, 3> outside{&bench.pipes[0].device, &bench.pipes[1].device, &bench.pipes[2].device};
  CanBridge bridge(*bench.device, bench.layout, bench.timing, outside);
  bridge.poll(0);
  bridge.poll(100 * kMs);
  (void)bench.pipes[0].controller.send(can_frame(0x80, {}));
  (void)bench.pipes[1].controller.send(can_frame(0x80, {}));
  bridge.poll(100 * kMs);
  EXPECT_EQ(bridge.counters().cycles, 0u);
  bridge.poll(100 * kMs + kMs / 4);
  EXPECT_EQ(bridge.counters().cycles, 1u);
  (void)bench.pipes[2].controller.send(can_frame(0x80, {}));
  bridge.poll(100 * kMs + kMs / 3);
  EXPECT_EQ(bridge.counters().cycles, 1u) << "it belongs to the same cycle";
}

}  // namespace
}  // namespace godobject::sim
