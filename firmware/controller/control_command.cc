#include "firmware/controller/control_command.h"

#include <memory>

#include <fmt/format.h>

#include "firmware/controller/session.h"
#include "firmware/controller/warning.h"
#include "firmware/machine/signals.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware {
namespace {

using command::ExitCode;
using command::Failure;

const char* const kFooter = R"(Examples:
  godobject-controller firmware/controllers/lwr.toml --scene bt.scene --duration 20 --log logs
  godobject-controller doctor firmware/controllers/lwr.toml

The loop begins once all drives answer, their joints rest within their limits and the enable switch, seen released, is held. It
pushes each joint a little, to see that it moves the right way, and renders once the contact force is small. A fault takes the
torque away and is latched: SIGUSR1 resets it once emergency stop and enable switch are released. SIGTERM, SIGINT and SIGHUP end
the run in order: exit 0.

--bus sim, the default, is a simulated device with a hand on it, in virtual time: as fast as the machine can. With
--real-time (loop.real_time) it keeps to the clock, on a thread with real-time priority as far as that is permitted.

CONTROLLER.toml, units SI; firmware/README.md explains each key:
  [scene]      image, solver, friction
  [device]     file
  [workspace]  posture, start, turn, scale
  [loop]       real_time, cpu, priority, velocity_window, compute
  [gains]      stiffness, damping, rotational, margin
  [passivity]  damping
  [limits]     force, torque, speed, speed_stop, turn, turn_stop, joint_speed, joint_speed_stop, torque_rate,
               stuck_torque
  [engage]     force, ramp
  [start]      wait, sign_test, push, motion
  [telemetry]  folder, every, bus
  [simulation] path, slower, begin

--log DIR writes DIR/telemetry.csv, a row a cycle: times, mode, fault, joint positions q, velocities qd and torques, device pose
d and god object g of the moving mesh in the scene, force f and torque t rendered at the hand in the room's directions, depth, energy
absorbed from arm and hand, damping injected. In virtual time DIR/hand.csv has the work that the simulated hand has done on the tool until then.

Exit codes: 0 done, 64 usage, 65 bad scene image or path, or an image without the solver or friction asked for, 66 an input is
missing or a file of the configuration may not be read, 69 drives or bus not available, or stopped by a fault, 74 cannot write,
77 no right to read the scene image, to a CAN interface or to real-time work, 78 bad configuration.)";

}  // namespace

ControlCommand::ControlCommand(CLI::App& app, std::string& transport) : transport_(transport) {
  app.footer(kFooter);
  file_option_ = app.add_option("CONTROLLER.toml", file_, "controller file")->type_name("");
  app.add_option("--scene", scene_, "scene image, in place of scene.image")->type_name("X.scene");
  app.add_option("--bus", transport_, "sim, or CAN interfaces such as can0,can1; default: sim")->type_name("BUS");
  app.add_option("--duration", duration_,
                 "seconds after which it ends; default: with simulation.path half a second after it, else never")
      ->check(CLI::Range(0.001, 1e7))
      ->option_text("SECONDS");
  app.add_option("--log", log_, "folder for the telemetry, in place of telemetry.folder")->type_name("DIR");
  app.add_flag("--real-time", real_time_, "simulated bus: keep to the clock, on a real-time thread, as loop.real_time");
  app.add_flag("--log-bus", log_bus_, "writes what goes over the buses to the same folder, as telemetry.bus");
}

ControllerConfig ControlCommand::read_configuration() const {
  ControllerConfig config = read_controller_file(file_);
  if (!scene_.empty()) config.scene.image = scene_;
  if (!log_.empty()) config.telemetry.folder = log_;
  if (log_bus_) config.telemetry.bus = true;
  if (config.telemetry.bus && config.telemetry.folder.empty()) {
    throw Failure(ExitCode::kUsage,
                  "what goes over the buses has no folder to be written to; give --log or telemetry.folder");
  }
  if (real_time_) config.loop.real_time = true;
  if (config.scene.image.empty()) {
    throw Failure(ExitCode::kBadConfig, fmt::format("{}: scene.image is missing; add it or give --scene", file_));
  }
  return config;
}

void ControlCommand::run() const {
  if (file_option_->count() == 0) throw CLI::RequiredError("CONTROLLER.toml");
  const auto session = std::make_unique<Session>(read_configuration(), transport_);
  RunRequests& requests = signal_requests();
  catch_end_signals();
  catch_reset_signal();
  ignore_write_signals();
  const std::string stop = session->run(duration_, requests);
  if (stop.empty()) return;
  if (!requests.end) throw Failure(ExitCode::kUnavailable, stop);
  warn(stop);
}

}  // namespace godobject::firmware
