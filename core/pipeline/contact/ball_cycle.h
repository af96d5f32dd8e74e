#pragma once

#include "core/pipeline/cycle/state.h"
#include "core/pipeline/cycle/step_times.h"
#include "core/scene/scene.h"

namespace godobject {

/// One cycle of `contact` without friction for a ball (is_ball), in three dimensions and in W: what `contact_cycle`
/// does for its one point, with the same margins, second looks and certificate, but no search and no rotation. The god
/// object turns with the device; no torque.
///
/// Guarantee: a centre whose stored distance is positive keeps it so, whatever the device does.
///
/// Bounds: kMaxSubsteps sub-steps of at most 14 attempts, each a look-up and the certificate's. In steady contact one
/// sub-step of two look-ups. Real-time safe. kNotFinite: a NaN would have left the cycle; `state` is as it was.
Status ball_cycle(const Voxelmap& field, const Parameters& q, const CycleInput& input, State& state,
                  CycleReport& report, StepTimes* times) noexcept;

}  // namespace godobject
