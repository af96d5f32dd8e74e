#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

#include "firmware/configuration/controller_file.h"
#include "firmware/drives/cia402/cia402_family.h"
#include "tests/sim/small_master.h"
#include "tests/support/arms.h"

namespace godobject::firmware::cia402_link_test {
namespace {

/// Notes the commands of network management that were on the buses.
class NetworkCommands final : public hal::FrameTap {
 public:
  struct Command {
    int bus;
    int what;
    int node;
  };

  void on_frame(int bus, const hal::ReceivedFrame& received) noexcept override {
    const hal::CanFrame& frame = received.frame;
    if (frame.id == 0x000 && frame.length == 2) seen.push_back({bus, frame.data[0], frame.data[1]});
  }

  std::vector<Command> seen;
};

/// The light-weight robot on simulated drives, connected as for a run.
class Cia402LinkTest : public testing::Test {
 protected:
  Cia402LinkTest() {
    ControllerConfig config;
    config.device.model = test::lwr().model;
    config.device.bus = test::layout_of(config.device.model);
    config.workspace.posture.setConstant(0.3);
    const Placement placement = place(config.workspace, config.device, Vector3::Zero());
    link_ =
        Cia402Family(config.device.bus)
            .connect({.transport = kSimulatedTransport, .config = &config, .placement = &placement, .tap = &commands_});
    clock_ = link_->make_clock();
  }

  void run(int cycles) {
    hal::JointDrives& drives = link_->drives();
    clock_->sleep_until((clock_->now_ns() / 1'000'000 + 1) * 1'000'000);
    for (int k = 0; k < cycles; ++k) {
      const std::int64_t begin_ns = clock_->now_ns();
      drives.request();
      clock_->sleep_until(begin_ns + drives.collect_ns());
      drives.receive(reading_);
      drives.send({});
      clock_->sleep_until(begin_ns + 1'000'000);
    }
  }

  NetworkCommands commands_;
  std::unique_ptr<DriveLink> link_;
  std::unique_ptr<hal::Clock> clock_;
  hal::JointReading reading_;
  std::atomic<bool> end_{false};
};

/// The drives answer from the start on until the end; then each bus has got one command for all its nodes.
TEST_F(Cia402LinkTest, StopsTheNodesItHasStarted) {
  ASSERT_TRUE(link_->start(*clock_, end_));
  run(20);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(reading_.age.at(i), 0u) << i;
    EXPECT_EQ(reading_.state.at(i), hal::DriveState::kOff) << i;
  }
  commands_.seen.clear();
  link_->stop();
  run(10);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_GE(reading_.age.at(i), 9u) << "joint " << i << " still answers";
  ASSERT_EQ(commands_.seen.size(), link_->bus_names().size());
  for (int bus = 0; bus < static_cast<int>(commands_.seen.size()); ++bus) {
    const auto of_bus = [bus](const NetworkCommands::Command& command) {
      return command.bus == bus && command.what == 0x02 && command.node == 0;  // stop, all nodes
    };
    EXPECT_EQ(std::count_if(commands_.seen.begin(), commands_.seen.end(), of_bus), 1) << bus;
  }
}

}  // namespace
}  // namespace godobject::firmware::cia402_link_test
