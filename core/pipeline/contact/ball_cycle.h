#pragma once

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/cycle/state.h"
#include "core/scene/voxelmap.h"
#include "godobject/report.h"
#include "godobject/status.h"

namespace godobject {

/// One cycle of `contact` without friction for a ball (is_ball), in three dimensions and in W: `contact_cycle` for its one
/// point, with the same gap law, second looks and certificate, but without search and rotation. The god object turns with
/// the device; there is no torque.
///
/// Guarantee: a centre whose stored distance is positive keeps it so, whatever the device does.
///
/// Cost: at most kMaxSubsteps sub-steps of kMostAttempts attempts, each a look-up and the certificate's; in steady contact
/// one sub-step of two look-ups. Real-time safe. Statuses as those of `commit`.
Status ball_cycle(const Voxelmap& field, const Parameters& parameters, const ContactLengths& lengths,
                  const CycleInput& input, ProxyState& state, CycleReport& report, StepTimes* times) noexcept;

}  // namespace godobject
