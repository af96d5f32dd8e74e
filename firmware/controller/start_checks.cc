#include "firmware/controller/start_checks.h"

#include <string>

#include <fmt/format.h>

#include "firmware/configuration/gain_check.h"
#include "firmware/controller/warning.h"

namespace godobject::firmware {

void check_gains_at_start(const ControllerConfig& config, const SceneView& scene, const Device& device, double delay) {
  const double scale = config.workspace.scale;
  const LoopTiming timing{config.device.bus.period, delay, config.loop.velocity_window};
  require_stable_joints(device.model, device.torque, config.workspace.posture, timing);
  const GainReport report = check_gains(scene, device.model, config.workspace.posture, scale, timing);
  const auto felt = FeltCoupling::of(scene, scale);
  for (const std::string& line : judge_gains(report, felt, config.gains.margin)) warn(line);
  require_stable_injection(scene, device.model, config.workspace.posture, scale, timing,
                           {config.passivity.damping, device.torque.rotation_length}, config.gains.margin);
  fmt::print("{}: {:.4g} N/m and {:.4g} Nm/rad at the hand, stable up to {:.3g} times that at a delay of {:.3g} ms\n",
             device.name, felt.stiffness, felt.rotation_stiffness, report.margin, 1e3 * delay);
}

}  // namespace godobject::firmware
