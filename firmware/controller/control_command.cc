#include "firmware/controller/control_command.h"

#include <cstdlib>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "firmware/controller/session.h"
#include "firmware/controller/warning.h"
#include "firmware/drives/drive_family.h"
#include "firmware/machine/signals.h"
#include "godobject/version.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/command_line/source_commit.h"

namespace godobject::firmware {
namespace {

using command::ExitCode;
using command::Failure;

const char* const kControlFooter = R"(Examples:
  godobject-controller firmware/controllers/lwr.toml --scene bt.scene --duration 20 --log logs
  godobject-controller doctor firmware/controllers/lwr.toml

Start: all drives answer, and their joints rest within their limits. The operator releases the enable switch and holds it. The
controller pushes each joint a little to check that it moves in the right direction. Rendering begins once the contact force is
small. A fault takes the power away and is latched. After emergency stop and enable switch are released, SIGUSR1 resets it.
SIGTERM, SIGINT and SIGHUP end the run in order: exit 0.

--bus sim, the default, simulates arm, drives and hand in virtual time, as fast as the machine can. With --real-time
(loop.real_time) the simulation keeps to the clock, on a thread with real-time priority as far as that is permitted.

CONTROLLER.toml, in SI units; firmware/README.md explains each key:
  [scene]      image, solver, friction
  [device]     file
  [workspace]  posture, start, turn, scale
  [loop]       real_time, cpu, priority, velocity_window, compute, cycle_budget
  [gains]      stiffness, damping, rotational, margin
  [passivity]  damping
  [limits]     force, torque, speed, speed_stop, turn, turn_stop, joint_speed, joint_speed_stop, torque_rate,
               stuck_torque
  [engage]     force, ramp
  [start]      wait, sign_test, push, motion
  [telemetry]  folder, every, bus
  [simulation] path, slower, begin

--log DIR gives each run a folder of its own, named by its start in UTC: DIR/20261130T143055Z. Earlier runs stay. DIR/latest
links to the newest run, and DIR/telemetry.csv to its telemetry.csv. This has one row a cycle: times; mode; fault; joint
positions q, velocities qd and torques; device pose d and god object g of the moving mesh in the scene; force f and torque t on
the hand along the axes of the room; depth; energy absorbed from arm and hand; damping injected. In virtual time hand.csv has
the work of the simulated hand on the tool since the start. Users outside the group may not read these files.

A stop by a fault is recorded: the 30 s before it and up to 60 s after it, with each cycle and all frames. The record is in the
folder incident of the run. Without --log a real arm's is in $STATE_DIRECTORY/incidents, $XDG_STATE_HOME/godobject/incidents or
~/.local/state/godobject/incidents, and a simulated arm has none. --incidents DIR names another folder. godobject-controller
explain FOLDER says what happened.

Exit codes: 0 done, 64 usage, 65 bad scene image or path, or an image without the requested solver or friction, 66 an input is
missing or a configuration file cannot be read, 69 drives or bus not available, or stopped by a fault, 74 cannot write, 77 no
right to read the scene image, to a CAN interface or to real-time work, 78 bad configuration.)";

/// The folder in which the programs of this service, or of this user, keep their state; empty: there is none.
std::filesystem::path state_folder() {
  const auto variable = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::string(value == nullptr ? "" : value);
  };
  const std::string of_service = variable("STATE_DIRECTORY");
  if (!of_service.empty()) return of_service.substr(0, of_service.find(':'));
  const std::string of_user = variable("XDG_STATE_HOME");
  if (!of_user.empty()) return std::filesystem::path(of_user) / "godobject";
  const std::string home = variable("HOME");
  return home.empty() ? std::filesystem::path() : std::filesystem::path(home) / ".local/state/godobject";
}

}  // namespace

ControlCommand::ControlCommand(CLI::App& app, std::string& transport) : transport_(transport) {
  app.footer(kControlFooter);
  file_option_ = app.add_option("CONTROLLER.toml", file_, "controller file")->type_name("");
  app.add_option("--scene", scene_, "scene image, instead of scene.image")->type_name("X.scene");
  app.add_option("--bus", transport_, "sim, or CAN interfaces such as can0,can1; default: sim")->type_name("BUS");
  app.add_option("--duration", duration_,
                 "seconds until the run ends; default: half a second after simulation.path, else no limit")
      ->check(CLI::Range(0.001, 1e7))
      ->option_text("SECONDS");
  app.add_option("--log", log_, "folder for the logs, instead of telemetry.folder")->type_name("DIR");
  app.add_option("--incidents", incidents_,
                 "folder for the records of stops; default: beside the logs, of a real arm the state folder")
      ->type_name("DIR");
  app.add_flag("--real-time", real_time_, "simulation: keep to the clock, on a real-time thread, as loop.real_time");
  app.add_flag("--log-bus", log_bus_, "also logs the frames on the buses to that folder, as telemetry.bus");
}

ControllerConfig ControlCommand::read_configuration() const {
  ControllerConfig config = read_controller_file(file_);
  if (!scene_.empty()) config.scene.image = scene_;
  if (!log_.empty()) config.telemetry.folder = log_;
  if (log_bus_) config.telemetry.bus = true;
  config.telemetry.program =
      fmt::format("godobject-controller {}, commit {}", GODOBJECT_VERSION, command::kSourceCommit);
  choose_incidents(config.telemetry);
  if (config.telemetry.bus && config.telemetry.folder.empty()) {
    throw Failure(ExitCode::kUsage, "--log-bus has no folder to write to; add --log DIR or telemetry.folder");
  }
  if (real_time_) config.loop.real_time = true;
  if (config.scene.image.empty()) {
    throw Failure(ExitCode::kBadConfig, fmt::format("{}: scene.image is missing; add it or give --scene", file_));
  }
  return config;
}

/// Stops of a real arm are recorded in any case.
void ControlCommand::choose_incidents(ControllerConfig::Telemetry& telemetry) const {
  telemetry.incidents = incidents_;
  if (!incidents_.empty() || !telemetry.folder.empty() || transport_ == kSimulatedTransport) return;
  telemetry.needs_incidents = false;
  const std::filesystem::path state = state_folder();
  if (!state.empty()) telemetry.incidents = state / "incidents";
  if (state.empty()) warn("a stop will not be recorded: this user has no HOME; name a folder by --incidents");
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
