#include <poll.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <ctime>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "firmware/configuration/controller_file.h"
#include "firmware/configuration/scene_file.h"
#include "firmware/drives/cia402/can_buses.h"
#include "firmware/machine/signals.h"
#include "firmware/simulation/simulated_arm.h"
#include "hal/cia402/bus_plan.h"
#include "hal/linux/monotonic_clock.h"
#include "sim/can_bridge.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/command_line/run.h"

namespace {

using namespace godobject;
using command::ExitCode;
using command::Failure;
using firmware::ControllerConfig;

const char* const kFooter = R"(Examples:
  godobject-simdevice firmware/controllers/lwr.toml --bus vcan0,vcan1,vcan2 &
  godobject-controller firmware/controllers/lwr.toml --bus vcan0,vcan1,vcan2

Simulates arm, drives, operator's panel and hand as CANopen nodes; use the same file for the controller. Each SYNC of the
controller advances the arm by one period. Without SYNC the arm follows the clock, so the drives' deadlines expire. The run ends
at SIGTERM, SIGINT, SIGHUP or after --duration and then prints its figures.

Exit codes: 0 done, 64 usage, 65 bad data, 66 no such input, 69 an interface is missing, 77 no right, 78 bad configuration)";

constexpr std::int64_t kLongestWait_ns = 100'000'000;  // chosen: signals and --duration are noticed within 0.1 s
/// The operator holds the enable switch no earlier than this after the panel has started. Chosen: the controller, which
/// starts the panel with the drives, waits for the switch soon after, also where it is traced or its machine is busy.
constexpr std::int64_t kOperatorNotices_ns = 300'000'000;

struct Options {
  std::string controller;
  std::string scene;
  std::string bus;
  double enable_after = 3.0;
  std::optional<double> duration;
};

/// Waits until a frame has arrived, at most `ns`.
void wait_for_frames(const firmware::CanBuses& wires, std::int64_t ns) {
  std::array<pollfd, hal::kMaxBuses> descriptors{};
  const std::size_t count = wires.buses().size();
  for (std::size_t i = 0; i < count; ++i) descriptors[i] = {wires.socket(i).descriptor(), POLLIN, 0};
  const timespec most{0, std::clamp<std::int64_t>(ns, 0, kLongestWait_ns)};
  if (::ppoll(descriptors.data(), count, &most, nullptr) <= 0) return;
  for (std::size_t i = 0; i < count; ++i) {
    // an interface that is down makes ppoll return at once each time
    const timespec moment{0, 100'000};
    if ((descriptors[i].revents & (POLLERR | POLLHUP)) != 0) ::nanosleep(&moment, nullptr);
  }
}

void print_report(const sim::CanDevice& device, const sim::CanBridge& bridge, const firmware::SimulatedArm& arm) {
  const sim::BridgeCounters& counters = bridge.counters();
  fmt::print("{} cycles, {:.3f} s of the arm; {} frames sent, {} not sent; {} received, {} dropped\n", counters.cycles,
             1e-9 * static_cast<double>(arm.now_ns()), counters.forwarded, counters.not_sent, counters.received,
             counters.dropped);
  fmt::print("controller silent: {} times\n", counters.left_alone);
  for (int i = 0; i < arm.joint_count(); ++i) {
    const sim::Cia402Slave& drive = device.nodes().drive(i);
    fmt::print("joint {}: {} commands, {} trips, {}\n", i + 1, drive.commands(), drive.trips(), name(drive.state()));
  }
  fmt::print("work of the hand on the tool: {:.6g} J\n", arm.hand_work());
}

void simulate(const Options& options) {
  ControllerConfig config = firmware::read_controller_file(options.controller);
  if (!options.scene.empty()) config.scene.image = options.scene;
  if (config.scene.image.empty()) {
    throw Failure(ExitCode::kBadConfig,
                  fmt::format("{}: scene.image is missing; add it or give --scene", options.controller));
  }
  const hal::BusLayout& layout = config.device.bus;
  const firmware::CanBuses wires(firmware::split_names(options.bus), layout);
  for (const std::string& line : wires.warnings()) fmt::print(stderr, "godobject-simdevice: {}\n", line);
  const firmware::SceneFile image(config.scene.image);
  const SceneView scene = image.scene();
  const firmware::Placement placement = firmware::place(config.workspace, config.device, scene.H_MB.translation);
  const auto arm = std::make_unique<firmware::SimulatedArm>(config, placement);
  const sim::CanScript script{.hold_from_ns = static_cast<std::int64_t>(1e9 * options.enable_after), .faults = {}};
  const auto device = std::make_unique<sim::CanDevice>(arm->plant(), layout, arm->hardware(), script);
  const auto bridge = std::make_unique<sim::CanBridge>(*device, layout, hal::plan_buses(layout).timing, wires.buses());

  firmware::catch_end_signals();
  const std::atomic<bool>& ended = firmware::signal_requests().end;
  hal::MonotonicClock clock;
  const std::int64_t end_ns =
      options.duration ? clock.now_ns() + static_cast<std::int64_t>(1e9 * *options.duration) : sim::kNever;
  sim::CanNodes& nodes = device->nodes();
  const sim::CanopenNode& panel = nodes.node(nodes.node_count() - 1);  // or a drive, where there is no panel
  std::int64_t stopped_ns = 0;                                         // the panel was last seen not operational
  while (!ended.load(std::memory_order_relaxed) && clock.now_ns() < end_ns) {
    const std::int64_t wanted_ns = bridge->poll(clock.now_ns());
    if (panel.nmt_state() != hal::canopen::kNmtOperational) stopped_ns = nodes.now_ns();
    nodes.hold_enable_switch(nodes.now_ns() >= stopped_ns + kOperatorNotices_ns);
    wait_for_frames(wires, wanted_ns - clock.now_ns());
  }
  print_report(*device, *bridge, *arm);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Simulates the arm on CAN: drives, operator's panel and hand for a controller in another process.",
               "godobject-simdevice");
  app.footer(kFooter);
  Options options;
  app.add_option("CONTROLLER", options.controller, "controller file, CONTROLLER.toml")->required()->option_text(" ");
  app.add_option("--bus", options.bus, "CAN interfaces, bus 0 first, such as vcan0,vcan1,vcan2")
      ->required()
      ->option_text("NAMES");
  app.add_option("--scene", options.scene, "scene image, instead of scene.image")->option_text("FILE");
  app.add_option(
         "--enable-after", options.enable_after,
         fmt::format(
             "time of the arm in seconds from which the operator holds the enable switch, {:g} s after the start "
             "of the panel at the earliest; default: {:g}",
             1e-9 * static_cast<double>(kOperatorNotices_ns), options.enable_after))
      ->check(CLI::Range(0.0, 1e6))
      ->option_text("SECONDS");
  app.add_option("--duration", options.duration, "seconds until the run ends; default: no limit")
      ->check(CLI::Range(0.001, 1e7))
      ->option_text("SECONDS");
  return command::run(app, argc, argv, [&] { simulate(options); });
}
