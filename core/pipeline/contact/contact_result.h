#pragma once

#include <cstdint>

#include "core/pipeline/contact/contact_memory.h"
#include "core/pipeline/contact/qp/least_constraint.h"
#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/cycle/state.h"
#include "godobject/report.h"
#include "godobject/status.h"

namespace godobject::detail {

/// The result of the sub-steps of one cycle.
struct ContactResult {
  Pose H_WS;                   ///< the god object
  double smallest = 0.0;       ///< stored distance of the near points at the last sub-step's start [m]
  std::uint32_t substeps = 0;  ///< sub-steps with a near point
  std::uint32_t dropped = 0;   ///< near points without a row or without a look-up, in the last sub-step
  bool cut = false;            ///< the last motion was shortened so as not to jump over the surface
  bool inside = false;         ///< the god object still penetrates after a start inside
};

/// Flags that `outcome_of` orders: the most severe one is the cycle's outcome.
struct OutcomeFlags {
  bool held = false;  ///< a contact force holds the god object back
  bool cut = false;
  bool dropped = false;
  bool infeasible = false;
  bool inside = false;
};
constexpr Outcome outcome_of(const OutcomeFlags& flags) noexcept {
  if (flags.inside) return Outcome::kStartInside;
  if (flags.infeasible) return Outcome::kInfeasible;
  if (flags.dropped) return Outcome::kOverflow;
  if (flags.cut) return Outcome::kCut;
  return flags.held ? Outcome::kContact : Outcome::kFree;
}

/// Steps #6 and #7 of `contact`, and `commit`; then `memory` carries `step`, the cycle's motion and forces, on.
/// Statuses as those of `commit`; if not kOk, `memory` is unchanged too. Real-time safe.
Status finish_contact(const CycleInput& input, const ContactResult& result, const ConstrainedStep& step,
                      const Parameters& parameters, ContactMemory& memory, ProxyState& state,
                      CycleReport& report) noexcept;

}  // namespace godobject::detail
