#pragma once

#include <cstdint>

#include "godobject/pose.h"

namespace godobject {

/// The force of step #7 for the device to display, in W about the moving body's centre of mass. [N, Nm]
struct DeviceForce {
  Wrench spring_W;  ///< the virtual coupling's spring: k_D f_VC, k_D t_VC
  Wrench total_W;   ///< spring and damping b_D: the force to display
};

/// The outcome of a cycle. Of several that apply, the later one in the order kFree, kContact, kCut, kOverflow,
/// kInfeasible, kStartInside is reported.
enum class Outcome : std::uint8_t {
  kFree,         ///< no contact holds the god object; with `contact` it is at the device pose
  kContact,      ///< contacts constrain the god object
  kStartInside,  ///< the first pose penetrated, and the god object has not come out yet; `contact` with a
                 ///< budget of work: or its first search has not ended, then without force
  kCut,         ///< the motion was shortened so as not to jump over the surface; the remainder waits for the next cycle
  kOverflow,    ///< `contact`: near points or edges that matter found no room, or exceeded the point budget
  kBadInput,    ///< the input was refused; the god object stayed and the force is zero
  kInfeasible,  ///< `contact`: the constraints had no common solution; no gap was allowed to shrink
};

/// Returns the outcome as one word: `free contact start_inside cut overflow bad_input infeasible`. Never null.
const char* name(Outcome outcome) noexcept;

/// The result of one cycle.
struct CycleReport {
  Pose H_WS;          ///< the god object S after the cycle: its body frame (centre of mass, principal axes) in W
  DeviceForce force;  ///< for the device
  /// `paper`, `corrected`: p = p_d - d of step #1, before the last sub-step's motion [m]. `contact`: minus the smallest
  /// stored distance of a near point at the start of the last sub-step [m]; distances above an eighth of a voxel count
  /// as that. If points were dropped, or with a point budget if the way was free, points that were not looked up may be
  /// nearer. 0 after `follow` and after a refusal.
  double penetration = 0.0;
  std::uint32_t contacts = 0;  ///< points with V > 0; `contact`: rows that carry a force (one point may have two)
  /// `contact`: near points as in kOverflow (of those without a row, groups), last sub-step
  std::uint32_t dropped = 0;
  std::uint32_t substeps = 0;  ///< of this cycle; `contact`: those with a near point, 1 if there was none
  bool unconverged = false;    ///< `contact`: friction is not Coulomb's to the tolerance; the gaps hold all the same
  /// `contact`: the work of the cycle [units], as in GodObject::set_work_budget. It does not depend on the clock, so
  /// that a replay repeats it. 0 with other solvers and after `follow`.
  std::uint64_t work = 0;
  /// `contact`: the budget of work ended the cycle. The god object may lag; `penetration` and `dropped` are those of
  /// the points that were looked up.
  bool out_of_work = false;
  bool outside = false;  ///< the device is outside of the workspace; its faces push back once it has been inside
  Outcome outcome = Outcome::kFree;  ///< outcome of the cycle
};

/// An optional stopwatch: the times of step #1 and of steps #2-#7 in one cycle, all sub-steps and attempts summed. The
/// core has no clock of its own: set `now_ns`. `update` rewrites the other members in each cycle that it runs.
///
/// With `contact` the look-ups of the certificate count as step #1. Each interval contains one reading of the clock:
/// one interval of step #1 and one of the other steps in `paper`; one of each a sub-step in `corrected`; in `contact`
/// one of each a sub-step and one of each for every attempt at a motion.
struct StepTimes {
  std::int64_t (*now_ns)() noexcept = nullptr;  ///< returns the time on a monotonic clock [ns]; not null
  std::int64_t step1_ns = 0;                    ///< time in step #1 [ns]
  std::int64_t solve_ns = 0;                    ///< time in steps #2-#7 [ns]
  std::int64_t since_ns = 0;                    ///< begin of the current interval; for the core's own use [ns]
};

}  // namespace godobject
