#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "godobject/god_object.h"
#include "toolchain/report/stability/loop_fault.h"
#include "toolchain/report/study/case.h"

namespace godobject::report {

inline constexpr double kPeriod = 1e-3;  ///< of the loops with one degree of freedom and of the plate [s]
inline constexpr double kPercent = 100.0;
inline constexpr double kMilli = 1e3;

struct StabilityRequest {
  std::filesystem::path devices = {};  ///< folder of the device files
  bool quick = false;
  std::uint32_t seed = 0;  ///< of random loops, postures, motions and losses
  LoopFault fault = {};    ///< for tests of the rows
  bool one_place = false;  ///< for such tests: rows with many expensive places are measured in one of them
};

/// Returns the cases with one degree of freedom, by closed forms: rows A1 to A6, A9 to A11, and random loops.
std::vector<StudyCase> axis_cases(const StabilityRequest& request);

/// Returns the cases of the time-domain passivity controller: its boundary, and its change of the force.
std::vector<StudyCase> passivity_cases(const StabilityRequest& request);

/// Returns the cases with a simulated arm in lock-step and the controller's bus: A4, A13, the delay of the schedule.
std::vector<StudyCase> arm_cases(const StabilityRequest& request);

/// Returns the largest stiffness [N/m] with which a slab comes to rest that is pressed into a plate and released: 1 kg,
/// 2 Ns/m, periods of 1 ms. A swing that has grown to a steady one is not stable. `delay` t_d [s], `damping` B [Ns/m],
/// `periods` of a run.
double stiffest_stable_plate(Solver solver, double delay, double damping, int periods,
                             const std::filesystem::path& work, const LoopFault& fault = {});

/// Returns the cases with the three solvers on a compiled plate: Z-width, k_VC,r, the passivity observer.
std::vector<StudyCase> pipeline_cases(const StabilityRequest& request);

/// Returns the inputs of a case as text, without those of files.
std::string inputs_of(const StabilityRequest& request);

}  // namespace godobject::report
