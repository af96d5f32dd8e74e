#pragma once

#include <filesystem>
#include <vector>

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

/// The three solvers against a compiled plate: Z-width, k_VC,r, the observer.
std::vector<StudyCase> pipeline_cases(bool quick);

}  // namespace godobject::report
