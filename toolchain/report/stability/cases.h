#pragma once

#include <filesystem>
#include <vector>

#include "godobject/god_object.h"
#include "toolchain/report/study/case.h"

namespace godobject::report {

struct StabilityRequest {
  std::filesystem::path devices;  ///< folder of the device files
  bool quick = false;
};

/// One degree of freedom, by the closed form: rows A1 to A6, A9 to A11, and random loops.
std::vector<StudyCase> axis_cases(bool quick);

/// The time-domain passivity controller: the boundary with it, and what it changes of the force.
std::vector<StudyCase> passivity_cases(bool quick);

/// A simulated arm in lock-step, and the controller's bus: A4, A13, the delay of the schedule.
std::vector<StudyCase> arm_cases(const StabilityRequest& request);

/// The largest stiffness [N/m] with which a slab that is let go, pressed into a plate, comes to rest: 1 kg, 2 Ns/m, 1
/// ms periods. A swing that has grown to a steady one is not stable. `delay` t_d [s], `damping` B [Ns/m], `periods` of
/// a run.
double stiffest_stable_plate(Solver solver, double delay, double damping, int periods,
                             const std::filesystem::path& work);

/// The three solvers against a compiled plate: Z-width, k_VC,r, the observer.
std::vector<StudyCase> pipeline_cases(bool quick);

}  // namespace godobject::report
