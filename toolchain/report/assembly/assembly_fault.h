#pragma once

#include <optional>

#include "godobject/report.h"
#include "toolchain/report/contact_quality/cycle_fault.h"

namespace godobject::report {

/// A fault that a test plants in the solver, but not in the theory that judges it. The default changes nothing.
struct AssemblyFault {
  CycleFault cycle = {};                ///< in the results of each cycle
  double friction_gain = 1.0;           ///< of the coefficient that the solver uses
  double turn_gain = 1.0;               ///< of the part's rotation in each cycle
  std::optional<Outcome> outcome = {};  ///< of each cycle, in place of its own
};

}  // namespace godobject::report
