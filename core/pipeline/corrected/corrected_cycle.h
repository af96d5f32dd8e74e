#pragma once

#include <algorithm>
#include <cstdint>

#include "core/pipeline/corrected/projection.h"
#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/cycle/state.h"
#include "core/pipeline/cycle/step_times.h"
#include "core/pipeline/cycle/unconstrained_motion.h"
#include "core/pipeline/cycle/workspace_limit.h"
#include "core/pipeline/penalty/closed_form_finish.h"
#include "core/pipeline/penalty/penalty_contacts.h"
#include "godobject/report.h"
#include "godobject/status.h"

namespace godobject {

// clang-format off: equation numbers stand in a column of their own

/// One cycle of `corrected`: step #1 on the stored distances, one projection in place of #2-#4, no filter. A motion
/// that had to be cut is gone on with, up to kMaxSubsteps times d/2: 12 m/s at d = 3 mm. As above otherwise.
template <bool kFriction, DistanceField Field>
Status corrected_cycle(const Field& field, const Pointshell& shell, const Parameters& q, const CycleInput& input,
                       State& state, CycleReport& report, StepTimes* times = nullptr) noexcept {
  detail::begin(times);
  const double viscous_step = q.friction.viscous / (q.stiffness * q.coupling_translation * q.period);
  const ProjectionFriction friction{q.friction.static_ratio, q.friction.kinetic_ratio, viscous_step};
  std::uint32_t substeps = 0;
  Pose H_WS = state.H_WS;
  Projection step;
  step.next = state.projection;
  PenaltyContacts contacts;
  do {
    const Motion free = unconstrained_motion(H_WS, input.H_WD);  // #3 (32), (33)
    const double travel = free.translation.norm() + q.mass.radius * free.rotation.norm();
    if (substeps > 0) detail::end(times, &StepTimes::solve_ns);
    contacts = penalty_contacts<DistancePenetration>(field, shell, H_WS, q.safety_distance, travel);  // #1 (1), (2)
    detail::end(times, &StepTimes::step1_ns);
    if (state.inside && !contacts.has_direction()) {
      step = Projection{};
      step.motion = free;  // swallowed, and the field does not say where out is: with the device
    } else {
      step = project(free, contacts, q.safety_distance, q.correction_gain, q.mass, kFriction ? &friction : nullptr,
                     step.next);  // #2-#4
    }
    const bool follows = !step.cut && contacts.depth <= 0.0;  // the device pose itself, without rounding
    H_WS = follows ? input.H_WD : kept_within(q.workspace, H_WS, H_WS * set_matrix(step.motion));
  } while (step.cut && ++substeps < kMaxSubsteps);
  const Status status =
      detail::finish(input, H_WS, contacts, step, std::min(substeps + 1, kMaxSubsteps), q, state, report);  // #6, #7
  detail::end(times, &StepTimes::solve_ns);
  return status;
}

// clang-format on

}  // namespace godobject
