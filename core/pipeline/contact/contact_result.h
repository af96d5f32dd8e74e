#pragma once

#include <cstdint>
#include <limits>

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/contact_memory.h"
#include "core/pipeline/contact/qp/least_constraint.h"
#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/cycle/state.h"
#include "godobject/report.h"
#include "godobject/status.h"

namespace godobject::detail {

/// The result of the sub-steps of one cycle.
struct ContactResult {
  Pose H_WS;  ///< the god object
  /// Smallest stored distance of the near points at the last sub-step's start [m].
  double smallest = std::numeric_limits<double>::infinity();
  std::uint32_t substeps = 0;  ///< sub-steps with a near point
  std::uint32_t dropped{};     ///< near points without a row or without a look-up, in the last sub-step
  bool cut = false;            ///< the last motion was shortened so as not to jump over the surface
  bool inside = false;         ///< the god object has not come out yet after a start inside
  bool out_of_work = false;    ///< the budget of work ended the cycle
  bool unknown = false;        ///< `inside` only for lack of an answer: the first search has not ended
};

/// The flags of a cycle, as in ContactResult.
struct OutcomeFlags {
  bool held = false;  ///< a contact force acts on the god object
  bool cut = false;
  bool dropped = false;
  bool infeasible = false;  ///< the rows had no common solution
  bool inside = false;
};
/// Returns the outcome of the most severe flag.
constexpr Outcome outcome_of(const OutcomeFlags& flags) noexcept {
  if (flags.inside) return Outcome::kStartInside;
  if (flags.infeasible) return Outcome::kInfeasible;
  if (flags.dropped) return Outcome::kOverflow;
  if (flags.cut) return Outcome::kCut;
  return flags.held ? Outcome::kContact : Outcome::kFree;
}

/// Ends a cycle of `contact`: steps #6 and #7, `commit`, and the report. Then stores `step`, the cycle's motion and
/// forces, in `memory` for the next cycle. Statuses as those of `commit`; if not kOk, `memory` is unchanged too.
/// Real-time safe.
Status finish_contact(const CycleInput& input, const ContactResult& result, const ConstrainedStep& step,
                      const Parameters& parameters, const ContactLengths& lengths, ContactMemory& memory,
                      ProxyState& state, CycleReport& report) noexcept;

}  // namespace godobject::detail
