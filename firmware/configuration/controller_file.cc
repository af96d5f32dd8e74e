#include "firmware/configuration/controller_file.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/device/kinematics.h"
#include "core/device/velocity_estimator.h"
#include "firmware/configuration/pose_key.h"
#include "toolchain/command_line/solver_names.h"
#include "toolchain/files/input_file.h"
#include "toolchain/files/text_file.h"
#include "toolchain/files/toml_file.h"
#include "toolchain/files/toml_table.h"

namespace godobject::firmware {
namespace {

using files::TomlTable;

constexpr double kVelocitySpan = 3e-3;  // of the default window of velocities, chosen: four samples at 1 kHz [s]
/// A path relative to the folder of `file`; empty stays empty.
std::filesystem::path beside(const std::filesystem::path& file, const std::string& path) {
  return path.empty() ? std::filesystem::path() : file.parent_path() / path;
}

void read_scene(const TomlTable& table, const std::filesystem::path& file, ControllerConfig& config) {
  table.allow({"image", "solver", "friction"});
  config.scene.image = beside(file, table.text("image", ""));
  if (table.has("solver")) {
    const std::string name = table.text("solver");
    config.scene.solver = command::solver_of(name);
    if (!config.scene.solver) {
      table.complain("solver", fmt::format("= \"{}\" is not known; it must be contact, corrected or paper", name));
    }
  }
  if (table.has("friction")) config.scene.friction = table.flag("friction", false);
}

void read_workspace(const TomlTable& table, ControllerConfig& config) {
  table.allow({"turn", "posture", "start", "scale"});
  ControllerConfig::Workspace& workspace = config.workspace;
  if (table.has("turn")) workspace.turn = read_rotation(table, "turn");
  const ArmModel& arm = config.device.model;
  const std::vector<double> posture = table.numbers("posture", static_cast<std::size_t>(arm.joint_count), {-1e3, 1e3});
  for (std::size_t i = 0; i < posture.size(); ++i) {
    const ArmJoint& joint = arm.joints[i];
    if (posture[i] < joint.lower || posture[i] > joint.upper) {
      table.complain("posture", fmt::format("= {:g} of joint {} is beyond its limits, {:g} to {:g} rad", posture[i],
                                            i + 1, joint.lower, joint.upper));
    }
    workspace.posture[static_cast<Eigen::Index>(i)] = posture[i];
  }
  if (table.has("start")) workspace.start = read_pose(table, "start");
  workspace.scale = table.number("scale", {1e-3, 1e3}, 1.0);
}

void read_limits(const TomlTable& table, ControllerConfig::Limits& limits) {
  table.allow({"force", "torque", "speed", "speed_stop", "turn", "turn_stop", "joint_speed", "joint_speed_stop",
               "torque_rate", "stuck_torque"});
  // Largest limits: a person holds the tool. 140 N: ISO/TS 15066, quasi-static contact of the hand. 10 Nm, 5 m/s and
  // 30 rad/s: chosen, the order of what a wrist bears and of how fast a hand moves.
  const auto bearable = [&table](const char* key, double least, double most, const char* unit, double fallback) {
    const double value = table.number(key, {least, 1e6}, fallback);
    if (value > most) {
      table.complain(key, fmt::format("= {:g} {} does not protect the hand of a person; at most {:g} {}", value, unit,
                                      most, unit));
    }
    return value;
  };
  limits.force = bearable("force", 1e-3, 140.0, "N", limits.force);
  limits.torque = bearable("torque", 1e-4, 10.0, "Nm", limits.torque);
  limits.speed = bearable("speed", 1e-3, 5.0, "m/s", limits.speed);
  limits.speed_stop = bearable("speed_stop", 1.05 * limits.speed, 7.5, "m/s", 1.5 * limits.speed);
  limits.turn = bearable("turn", 1e-2, 30.0, "rad/s", limits.turn);
  limits.turn_stop = bearable("turn_stop", 1.05 * limits.turn, 45.0, "rad/s", 1.5 * limits.turn);
  limits.joint_speed = table.number("joint_speed", {0.05, 1.0}, limits.joint_speed);
  limits.joint_speed_stop =
      table.number("joint_speed_stop", {1.05 * limits.joint_speed, 1.4}, 1.25 * limits.joint_speed);
  limits.torque_rate = table.number("torque_rate", {1e-4, 0.05}, limits.torque_rate);
  limits.stuck_torque = table.number("stuck_torque", {1e-4, 0.5}, limits.stuck_torque);
}

void read_gains(const TomlTable& table, ControllerConfig::Gains& gains) {
  table.allow({"stiffness", "damping", "rotational", "margin"});
  if (table.has("stiffness")) gains.stiffness = table.number("stiffness", {1e-3, 1e6});
  if (table.has("damping")) gains.damping = table.number("damping", {0.0, 1e5});
  if (table.has("rotational")) gains.rotational = table.number("rotational", {1e-9, 100.0});
  gains.margin = table.number("margin", {1.0, 100.0}, gains.margin);
}

void read_start(const TomlTable& table, ControllerConfig::Start& start) {
  table.allow({"wait", "sign_test", "push", "motion"});
  start.wait = table.number("wait", {0.1, 60.0}, start.wait);
  start.sign_test = table.flag("sign_test", start.sign_test);
  start.push = table.number("push", {1e-3, 0.2}, start.push);
  start.motion = table.number("motion", {1e-5, 0.02}, start.motion);
}

}  // namespace

ControllerConfig read_controller_file(const std::filesystem::path& file) {
  files::require_regular_input(file);
  std::string text = files::read_text(file);
  const toml::table root = files::parse_toml(text, file.string());
  files::allow_tables(root, file,
                      {"scene", "device", "workspace", "loop", "limits", "engage", "start", "gains", "passivity",
                       "telemetry", "simulation"});
  const auto table = [&](const char* name) { return TomlTable(root, name, file); };
  ControllerConfig config;
  config.text = std::move(text);
  read_scene(table("scene"), file, config);

  const TomlTable device = table("device");
  device.allow({"file"});
  config.device = read_device_file(beside(file, device.text("file")));

  read_workspace(table("workspace"), config);

  const TomlTable loop = table("loop");
  loop.allow({"real_time", "cpu", "priority", "velocity_window", "compute", "cycle_budget"});
  config.loop.real_time = loop.flag("real_time", config.loop.real_time);
  config.loop.cpu = static_cast<int>(loop.whole_number("cpu", {-1, 1023}, config.loop.cpu));
  config.loop.priority = static_cast<int>(loop.whole_number("priority", {1, 98}, config.loop.priority));
  const double period = config.device.bus.period;
  const int window =
      std::clamp(1 + static_cast<int>(std::lround(kVelocitySpan / period)), 2, VelocityEstimator::kMaxWindow);
  config.loop.velocity_window =
      static_cast<int>(loop.whole_number("velocity_window", {2, VelocityEstimator::kMaxWindow}, window));

  const double longest = period - 0.1 * period;
  config.loop.compute = loop.number("compute", {1e-6, longest}, std::min(config.loop.compute, kComputeShare * period));
  config.device.bus.compute = config.loop.compute;
  if (loop.has("cycle_budget")) config.loop.cycle_budget = loop.number("cycle_budget", {0.0, longest}, 0.0);

  read_limits(table("limits"), config.limits);

  const TomlTable engage = table("engage");
  engage.allow({"force", "ramp"});
  config.engage.force =
      engage.number("force", {1e-3, config.limits.force}, std::min(config.engage.force, config.limits.force));
  config.engage.ramp = engage.number("ramp", {0.02, 10.0}, config.engage.ramp);

  read_start(table("start"), config.start);

  read_gains(table("gains"), config.gains);

  const TomlTable passivity = table("passivity");
  passivity.allow({"damping"});
  config.passivity.damping = passivity.number("damping", {0.0, 1e5}, config.passivity.damping);

  const TomlTable telemetry = table("telemetry");
  telemetry.allow({"folder", "every", "bus"});
  config.telemetry.folder = beside(file, telemetry.text("folder", ""));
  config.telemetry.every = static_cast<int>(telemetry.whole_number("every", {1, 1000}, config.telemetry.every));
  config.telemetry.bus = telemetry.flag("bus", config.telemetry.bus);

  const TomlTable simulation = table("simulation");
  simulation.allow({"path", "slower", "begin"});
  config.simulation.path = beside(file, simulation.text("path", ""));
  config.simulation.slower = simulation.number("slower", {1.0, 1e3}, config.simulation.slower);
  config.simulation.begin = simulation.number("begin", {0.0, 1e5}, config.simulation.begin);
  return config;
}

void set_gains(const ControllerConfig::Gains& gains, SceneView& scene) noexcept {
  format::Settings& settings = scene.settings;
  settings.stiffness = gains.stiffness.value_or(settings.stiffness);
  settings.damping = gains.damping.value_or(settings.damping);
  settings.coupling_rotation = gains.rotational.value_or(settings.coupling_rotation);
}

SceneView configured(SceneView scene, const ControllerConfig& config) noexcept {
  set_gains(config.gains, scene);
  scene.settings.period = config.device.bus.period;
  return scene;
}

Placement place(const ControllerConfig::Workspace& workspace, const Device& device, const Vector3& p_MB) {
  Placement placement{{}, {}, device};
  const Pose H_RT = forward_kinematics(device.model, workspace.posture).H_RM;  // the device file's M is T here
  // solves R_WR R_RT R_TM = R_WM at the start
  placement.H_TM.rotation = (workspace.turn * H_RT.rotation).conjugate() * workspace.start.rotation;
  placement.H_TM.rotation.normalize();
  placement.H_TM.translation = -placement.H_TM.rotation._transformVector(p_MB) / workspace.scale;
  regrip(placement.H_TM, placement.device);
  const Pose H_RM = H_RT * placement.H_TM;
  placement.mapping.scale = workspace.scale;
  placement.mapping.H_WR.rotation = workspace.turn;
  placement.mapping.H_WR.translation =
      workspace.start.translation - workspace.scale * workspace.turn._transformVector(H_RM.translation);
  return placement;
}

}  // namespace godobject::firmware
