#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/pipeline/god_object.h"
#include "firmware/configuration/controller_file.h"
#include "firmware/cycle/control_cycle.h"

namespace godobject::report {

/// An arm in a scene, and how the controller limits its torques. What is pointed to outlives the runs.
struct LedArm {
  const Scene* scene = nullptr;
  const firmware::Device* device = nullptr;
  Solver solver = Solver::kContact;
  bool friction = false;
  firmware::TorqueLimits torque = {};
};

/// A cycle of the controller.
struct LedCycle {
  firmware::CycleRecord record;
  JointVector sent = JointVector::Zero();  ///< [Nm]
  /// What a controller that renders everything from the first cycle on would compute and send [Nm].
  JointVector computed_at_once = JointVector::Zero();
  JointVector sent_at_once = JointVector::Zero();
  Wrench F_B_W;                      ///< of the solver in that case, before any limit
  Outcome outcome = Outcome::kFree;  ///< the same
  std::uint32_t contacts = 0;        ///< the same
};

/// The whole control cycle on an arm whose joints follow the poses of the moving mesh in the scene, H_WM, a millisecond
/// apart, whatever torques are sent. The first pose is held until the drives have power. Beside it, along the same
/// positions: solver, limits at the hand, joint torques and torque limiter without a supervisor, which holds nothing
/// back where the controller still waits for the hand to come out. Throws Failure (kInternal) where the scene lacks the
/// solver.
std::vector<LedCycle> lead(const LedArm& arm, std::span<const Pose> path);

}  // namespace godobject::report
