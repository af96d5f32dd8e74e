#pragma once

#include <cstdint>

#include "godobject/pose.h"

namespace godobject {

/// What step #7 would have the device display, in W about the moving body's centre of mass. [N, Nm]
struct DeviceForce {
  Wrench spring_W;  ///< k_D f_VC, k_D t_VC
  Wrench total_W;   ///< with the damping b_D
};

/// How a cycle went; one word a row of a replay.
enum class Outcome : std::uint8_t {
  kFree,         ///< no contact: the god object is the device pose
  kContact,      ///< constrained
  kStartInside,  ///< the first pose penetrated, and the god object is still on its way out
  kCut,          ///< a motion was shortened so as not to jump over the surface
  kOverflow,     ///< more near points than a workspace holds or the budget allows (contact solver)
  kBadInput,     ///< the device pose was no pose; the god object was held
  kInfeasible,   ///< constraints without a solution (contact solver)
};

/// `free contact start_inside cut overflow bad_input infeasible`
const char* name(Outcome outcome) noexcept;

/// What a cycle leaves for others to look at.
struct CycleReport {
  Pose H_WS;          ///< god object after the cycle, frame B
  DeviceForce force;  ///< for the device, in W about the centre of mass
  /// p = p_d - d of step #1, before the cycle's motion [m]; `contact`: minus the smallest stored distance,
  /// known as far as it is below an eighth of a voxel
  double penetration = 0.0;
  std::uint32_t contacts = 0;  ///< points with V > 0; `contact`: rows that carry a force, two of one point are two
  std::uint32_t dropped = 0;   ///< `contact`: near points for which rows or the budget did not suffice, last sub-step
  std::uint32_t substeps = 0;  ///< `contact`: with something near; 1 where nothing was
  bool unconverged = false;    ///< contact: friction is not Coulomb's to the tolerance; gaps are kept all the same
  bool outside = false;        ///< the device is outside of the workspace: it is pushed back, once it has been inside
  Outcome outcome = Outcome::kFree;  ///< how the cycle went
};

/// Optional stopwatch: how long step #1 and steps #2-#7 of one cycle took, all its sub-steps and attempts together
/// (`contact`: the look-ups of the certificate count as step #1). The core has no clock of its own. Each stretch of
/// time holds one reading of the clock: one of step #1 and one of the rest in `paper`; one of both a sub-step in
/// `corrected`; in `contact` one of both a sub-step and one of both for each of its attempts at a motion.
struct StepTimes {
  std::int64_t (*now_ns)() noexcept = nullptr;  ///< the caller's monotonic clock
  std::int64_t step1_ns = 0;                    ///< time of step #1
  std::int64_t solve_ns = 0;                    ///< time of steps #2-#7
  std::int64_t since_ns = 0;                    ///< begin of the stretch that runs
};

}  // namespace godobject
