#pragma once

#include <cstdint>

#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/cycle/state.h"
#include "core/pipeline/penalty/penalty_contacts.h"
#include "godobject/report.h"
#include "godobject/status.h"

namespace godobject {

/// The result of the steps #1 to #5 of `paper` or `corrected`.
struct ClosedFormResult {
  Pose H_WS;                 ///< the god object's new pose, frame B in W
  PenaltyContacts contacts;  ///< of the last sub-step
  bool cut = false;          ///< the motion was shortened so as not to jump over the surface
  std::uint32_t substeps = 1;
};

/// Ends a cycle of `paper` or `corrected`: steps #6 and #7, `commit`, and the report. Statuses as those of `commit`.
/// Real-time safe.
Status finish_closed_form(const CycleInput& input, const ClosedFormResult& result, const Parameters& parameters,
                          ProxyState& state, CycleReport& report) noexcept;

}  // namespace godobject
