#include "firmware/controller/cycle_setup.h"

namespace godobject::firmware {
namespace {

std::uint32_t cycles(double seconds) noexcept {
  return static_cast<std::uint32_t>(seconds / ControlCycle::kPeriod + 0.5);
}

}  // namespace

CycleSetup cycle_setup(const ControllerConfig& config, const SceneView& scene, const Placement& placement,
                       std::span<std::byte> memory) {
  CycleSetup setup;
  setup.scene = &scene;
  setup.memory = memory;
  setup.solver = config.scene.solver.value_or(scene.default_solver());
  setup.friction = config.scene.friction.value_or(scene.settings.friction != 0);
  setup.arm = &placement.device.model;
  setup.joint_torque = &placement.device.torque;
  setup.mapping = placement.mapping;
  setup.velocity_window = config.loop.velocity_window;
  setup.passivity = {config.passivity.damping, ControlCycle::kPeriod, placement.device.torque.rotation_length};
  const ControllerConfig::Limits& limits = config.limits;
  setup.hand = {limits.force, limits.torque, limits.speed, limits.speed_stop, limits.turn, limits.turn_stop};
  setup.stuck_torque = limits.stuck_torque;
  setup.torque = {limits.torque_rate, limits.joint_speed, limits.joint_speed_stop};
  setup.supervisor.boot_cycles = cycles(config.start.wait);
  setup.supervisor.prepare_cycles = static_cast<std::uint32_t>(1.0 / limits.torque_rate) + 5;
  setup.supervisor.engage_cycles = cycles(config.engage.ramp);
  setup.supervisor.engage_force = config.engage.force;
  setup.supervisor.sign_test = config.start.sign_test;
  setup.supervisor.sign = {config.start.push, config.start.motion};
  return setup;
}

}  // namespace godobject::firmware
