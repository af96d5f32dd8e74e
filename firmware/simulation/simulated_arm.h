#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware/configuration/controller_file.h"
#include "sim/joint_motor.h"
#include "sim/plant.h"

namespace godobject::firmware {

/// The simulated arm of a controller file at the workspace's posture, and a hand that follows simulation.path or holds
/// the tool at rest. Drives, which are not part of it, move it in time.
class SimulatedArm {
 public:
  /// Reads simulation.path if there is one. Throws command::Failure: kNoInput or kBadData if it cannot be read or has
  /// an invalid pose, kBadConfig if its first pose is not the tool's.
  SimulatedArm(const ControllerConfig& config, const Placement& placement);

  SimulatedArm(const SimulatedArm&) = delete;
  SimulatedArm& operator=(const SimulatedArm&) = delete;

  sim::Plant& plant() noexcept { return plant_; }

  /// The hand pulls the moving mesh to H_WM in the scene, with this velocity of the mesh's origin in the scene, from
  /// now on and in place of simulation.path.
  void steer_hand(const Pose& H_WM, const Motion& velocity_W) noexcept;
  std::span<const sim::JointHardwareParameters> hardware() const noexcept { return hardware_; }

  int joint_count() const noexcept { return plant_.joint_count(); }
  std::int64_t now_ns() const noexcept { return plant_.now_ns(); }
  double path_seconds() const noexcept { return sim::OperatorHand::kRow * static_cast<double>(path_.size()); }
  double hand_work() const noexcept { return plant_.work().hand.sum(); }  ///< work on the tool since the start [J]

 private:
  WorkspaceMappingParameters mapping_;
  Pose H_MT_;               // T: the tool frame of the device file
  std::vector<Pose> path_;  // H_RT of the tool frame of the device file, 1 ms apart
  std::array<sim::JointHardwareParameters, kMaxJoints> hardware_;
  sim::Plant plant_;
};

}  // namespace godobject::firmware
