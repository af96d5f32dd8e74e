#include "firmware/controller/cycle_setup.h"

#include <algorithm>

#include "firmware/cycle/cycles_in.h"

namespace godobject::firmware {

CycleSetup cycle_setup(const ControllerConfig& config, const SceneView& scene, const Placement& placement,
                       std::span<std::byte> memory) {
  const double period = config.device.bus.period;
  const auto cycles = [period](double seconds) { return cycles_in(seconds, period); };
  CycleSetup setup;
  setup.period = period;
  setup.scene = &scene;
  setup.memory = memory;
  setup.solver = config.scene.solver.value_or(scene.default_solver());
  setup.friction = config.scene.friction.value_or(scene.settings.friction != 0);
  setup.arm = &placement.device.model;
  setup.joint_torque = &placement.device.torque;
  setup.mapping = placement.mapping;
  setup.velocity_window = config.loop.velocity_window;
  setup.passivity = {config.passivity.damping, period, placement.device.torque.rotation_length};
  const ControllerConfig::Limits& limits = config.limits;
  setup.hand = {limits.force, limits.torque, limits.speed, limits.speed_stop, limits.turn, limits.turn_stop};
  setup.stuck_torque = limits.stuck_torque;
  // a torque may change by its whole range at most
  const double rate = std::min(2.0, limits.torque_rate * (period / 1e-3));
  setup.torque = {rate, limits.joint_speed, limits.joint_speed_stop};
  setup.supervisor.period = period;
  setup.supervisor.boot_cycles = cycles(config.start.wait);
  setup.supervisor.prepare_cycles = static_cast<std::uint32_t>(1.0 / rate) + 5;
  setup.supervisor.engage_cycles = cycles(config.engage.ramp);
  setup.supervisor.engage_force = config.engage.force;
  setup.supervisor.limited_cycles = cycles(config.device.bus.limited_time);
  setup.supervisor.sign_test = config.start.sign_test;
  setup.supervisor.sign = {config.start.push, config.start.motion};
  return setup;
}

}  // namespace godobject::firmware
