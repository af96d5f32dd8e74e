#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "firmware/configuration/controller_file.h"
#include "firmware/cycle/control_cycle.h"
#include "toolchain/report/contact_quality/cycle_fault.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::report {

/// An arm in a scene, and the limits of its torques. Scene and device must outlive the runs.
struct LedArm {
  const SceneView* scene = nullptr;
  const firmware::Device* device = nullptr;
  Solver solver = Solver::kContact;
  bool friction = false;
  firmware::TorqueLimits torque = {};
  CycleFault fault = {};  ///< of the solver that runs without a supervisor
};

/// A cycle of the controller.
struct LedCycle {
  firmware::CycleRecord record;
  JointVector sent = JointVector::Zero();  ///< [Nm]
  /// Torques that a controller which renders fully from the first cycle on would compute and send [Nm].
  JointVector computed_at_once = JointVector::Zero();
  JointVector sent_at_once = JointVector::Zero();
  Wrench F_B_W;                      ///< of the solver in that case, before any limit
  Outcome outcome = Outcome::kFree;  ///< the same
  std::uint32_t contacts = 0;        ///< the same
};

/// Runs the whole control cycle on an arm whose joints follow the poses of the moving mesh, H_WM, one per millisecond,
/// independent of the torques. The first pose is held until the drives have power. Beside it, solver, limits at the
/// hand, joint torques and torque limiter run along the same positions without a supervisor; they render too while the
/// controller still waits for the hand to come out. Throws Failure (kInternal) if the scene lacks the solver.
std::vector<LedCycle> lead(const LedArm& arm, std::span<const Pose> path);

}  // namespace godobject::report
