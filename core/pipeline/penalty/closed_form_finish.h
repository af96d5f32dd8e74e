#pragma once

#include <cstdint>

#include "core/pipeline/corrected/projection.h"
#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/cycle/state.h"
#include "core/pipeline/penalty/penalty_contacts.h"
#include "godobject/report.h"
#include "godobject/status.h"

namespace godobject {

/// The god object leaves `inside` once it is less than this deep; corrections approach the surface, they do not reach
/// it. [voxels]
inline constexpr double kOutside = 0.1;

namespace detail {

/// Steps #6 and #7, the finite check, and the only place where `state` changes.
Status finish(const CycleInput& input, const Pose& H_WS, const PenaltyContacts& contacts, const Projection& step,
              std::uint32_t substeps, const Parameters& parameters, State& state, CycleReport& report) noexcept;

}  // namespace detail
}  // namespace godobject
