#pragma once

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/substep_path.h"
#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/cycle/state.h"
#include "core/pipeline/cycle/work.h"
#include "core/scene/voxelmap.h"
#include "godobject/report.h"
#include "godobject/status.h"

namespace godobject {

/// Runs one cycle of `contact` without friction for a ball (is_ball), in three dimensions and in W. It is
/// `contact_cycle` for the ball's centre, with the same gap law, second looks and certificate, but without search and
/// rotation. The god object turns with the device; there is no torque.
///
/// Guarantee: a centre whose stored distance is positive never gets one <= 0, whatever the device does.
///
/// Statuses as those of `commit`. Cost: at most kMaxSubsteps sub-steps of kMostAttempts attempts, each with one look-up
/// and those of the certificate; in steady contact one sub-step of two look-ups. Real-time safe.
Status ball_cycle(const Voxelmap& field, const Parameters& parameters, const ContactLengths& lengths,
                  const CycleInput& input, SubstepPath& path, WorkMeter& work, ProxyState& state, CycleReport& report,
                  StepTimes* times) noexcept;

}  // namespace godobject
