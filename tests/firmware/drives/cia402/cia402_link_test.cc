#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "firmware/configuration/controller_file.h"
#include "firmware/drives/cia402/cia402_family.h"
#include "tests/sim/small_master.h"
#include "tests/support/arms.h"
#include "toolchain/command_line/failure.h"

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
    config_.device.model = test::lwr().model;
    config_.device.bus = test::layout_of(config_.device.model);
    config_.workspace.posture.setConstant(0.3);
    connect();
  }

  void connect() {
    const Placement placement = place(config_.workspace, config_.device, Vector3::Zero());
    link_ = Cia402Family(config_.device.bus)
                .connect(
                    {.transport = kSimulatedTransport, .config = &config_, .placement = &placement, .tap = &commands_});
    clock_ = link_->make_clock();
    commands_.seen.clear();
  }

  /// The commands to all nodes of a bus.
  std::vector<int> to_all(int bus) const {
    std::vector<int> found;
    for (const NetworkCommands::Command& command : commands_.seen) {
      if (command.bus == bus && command.node == 0) found.push_back(command.what);
    }
    return found;
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

  ControllerConfig config_;
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

/// Nodes of which one has not booted in time are stopped, and the message names the first of them.
TEST_F(Cia402LinkTest, NamesTheDriveThatDoesNotStartAndStopsTheOthers) {
  config_.device.bus.boot_timeout = 1e-6;
  connect();
  try {
    link_->start(*clock_, end_);
    FAIL();
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kUnavailable);
    EXPECT_EQ(std::string(failure.what()),
              fmt::format("sim0, node {}, joint 1: did not boot in time; check its supply, node number and bit rate",
                          config_.device.bus.drives[0].node));
  }
  run(5);  // reads what was sent
  for (std::size_t i = 0; i < 7; ++i) EXPECT_GE(reading_.age.at(i), 4u) << "joint " << i << " answers";
  constexpr int kReset = 0x82;  // communication
  constexpr int kStop = 0x02;
  for (int bus = 0; bus < config_.device.bus.bus_count; ++bus) {
    EXPECT_EQ(to_all(bus), (std::vector<int>{kReset, kStop})) << bus;
  }
}

/// Whoever asks for the end before the drives have started gets no drives, and that is no failure.
TEST_F(Cia402LinkTest, EndsWithoutDrivesWhenItIsAskedTo) {
  end_ = true;
  EXPECT_FALSE(link_->start(*clock_, end_));
  run(5);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_GE(reading_.age.at(i), 4u) << "joint " << i << " answers";
}

}  // namespace
}  // namespace godobject::firmware::cia402_link_test
