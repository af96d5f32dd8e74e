#include "firmware/simulation/simulated_arm.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/device/kinematics.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/files/pose_path.h"

namespace godobject::firmware {
namespace {

using command::ExitCode;
using command::Failure;

/// Turns a pose H_WM of the mesh in the scene into its pose H_RM in the room.
Pose in_room(const Pose& H_WM, const WorkspaceMappingParameters& mapping) {
  const Pose& H_WR = mapping.H_WR;
  const Vector3 p_RM_W = H_WM.translation - H_WR.translation;
  return {(H_WR.rotation.conjugate() * H_WM.rotation).normalized(),
          H_WR.rotation.conjugate()._transformVector(p_RM_W) / mapping.scale};
}

/// The path in `slower` times its duration, still 1 ms a pose.
std::vector<Pose> slowed(const std::vector<Pose>& path, double slower) {
  const auto rows = static_cast<std::size_t>(slower * static_cast<double>(path.size() - 1)) + 1;
  std::vector<Pose> longer;
  longer.reserve(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    const double at = static_cast<double>(i) / slower;
    const auto before = static_cast<std::size_t>(at);
    const Pose& a = path[before];
    const Pose& b = path[std::min(before + 1, path.size() - 1)];
    const double share = at - static_cast<double>(before);
    longer.push_back({a.rotation.slerp(share, b.rotation), a.translation + share * (b.translation - a.translation)});
  }
  return longer;
}

std::vector<Pose> read_path(const ControllerConfig& config, const Placement& placement) {
  const Pose rest = forward_kinematics(config.device.model, config.workspace.posture).H_RM;
  if (config.simulation.path.empty()) return {rest};
  std::vector<Pose> path = files::read_pose_path(config.simulation.path, sim::OperatorHand::kRow).poses;
  for (const Pose& pose : path) {
    if (!pose.is_finite() || !(pose.rotation.norm() > 0.999 && pose.rotation.norm() < 1.001)) {
      throw Failure(ExitCode::kBadData, fmt::format("{}: has a row with an invalid pose; check its quaternions",
                                                    config.simulation.path.string()));
    }
  }
  const Pose H_MT = placement.H_TM.inverse();
  for (Pose& pose : path) pose = in_room(pose, placement.mapping) * H_MT;
  // tolerances chosen: across them the hand's spring (300 N/m, 3 Nm/rad) pulls with 3 N and 0.15 Nm
  const double gap = (path.front().translation - rest.translation).norm();
  if (gap > 0.01 || path.front().rotation.angularDistance(rest.rotation) > 0.05) {
    throw Failure(
        ExitCode::kBadConfig,
        fmt::format("{}: begins {:.3g} m and {:.3g} rad from the tool; set workspace.start to its first pose",
                    config.simulation.path.string(), gap, path.front().rotation.angularDistance(rest.rotation)));
  }
  return slowed(path, config.simulation.slower);
}

sim::HandParameters hand() {
  sim::HandParameters parameters;
  parameters.grip = sim::Grip::kSpring;
  return parameters;
}

}  // namespace

SimulatedArm::SimulatedArm(const ControllerConfig& config, const Placement& placement)
    : mapping_(placement.mapping),
      H_MT_(placement.H_TM.inverse()),
      path_(read_path(config, placement)),
      hardware_(sim::usual_hardware(config.device.model)),
      plant_(config.device.model, config.workspace.posture, JointVector::Zero(),
             sim::OperatorHand(hand(), path_, std::llround(1e9 * config.simulation.begin))) {}

void SimulatedArm::steer_hand(const Pose& H_WM, const Motion& velocity_W) noexcept {
  const Pose H_RM = in_room(H_WM, mapping_);
  const Quaternion R_RW = mapping_.H_WR.rotation.conjugate();
  sim::BodyState target{H_RM * H_MT_, {}};
  target.velocity.rotation = R_RW._transformVector(velocity_W.rotation);
  const Vector3 p_MT_R = target.pose.translation - H_RM.translation;
  target.velocity.translation =
      R_RW._transformVector(velocity_W.translation) / mapping_.scale + target.velocity.rotation.cross(p_MT_R);
  plant_.steer_hand(target);
}

}  // namespace godobject::firmware
