#pragma once

#include <optional>

#include "firmware/cycle/torque_limiter.h"
#include "toolchain/report/contact_quality/cycle_fault.h"
#include "toolchain/watch/findings.h"

namespace godobject::report {

/// Faults that a test plants in the parts that the chapter checks. The default changes nothing.
struct ExtremesFault {
  CycleFault cycle = {};  ///< results of a solver
  /// The watch reports a violation. That it finds planted faults is shown in tests/watch.
  std::optional<watch::Property> violated = {};
  bool accepts_poses = false;          ///< a solver runs with a pose 1 mm aside in place of an invalid one
  double distance_gain = 1.0;          ///< of the distances that are looked up
  bool hides_flaws = false;            ///< the scene compiler reports no flaw of a mesh
  bool refuses_meshes = false;         ///< the scene compiler refuses every mesh
  firmware::TorqueLimits limits = {};  ///< of the controller; the rows always judge by 5 %
  double jump = 0.0;                   ///< sudden displacement of a led arm in the middle of its path [m]
};

}  // namespace godobject::report
