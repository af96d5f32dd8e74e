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

namespace godobject {

/// Runs one cycle of `corrected`: step #1 on the stored distances, one projection in place of #2-#4, no filter.
///
/// The remainder of a motion that was cut becomes the next sub-step: at most kMaxSubsteps times d/2 a cycle, 12 m/s at
/// d = 3 mm. `memory` is carried from cycle to cycle. Statuses as those of `commit`; if not kOk, `memory` is unchanged
/// too. Real-time safe.
template <bool kFriction, DistanceField Field>
Status corrected_cycle(const Field& field, const Pointshell& shell, const Parameters& q, const CycleInput& input,
                       ProjectionState& memory, ProxyState& state, CycleReport& report,
                       StepTimes* times = nullptr) noexcept {
  detail::begin(times);
  const double viscous_step = q.friction.viscous / (q.stiffness * q.coupling_translation * q.period);
  const ProjectionFriction friction{q.friction.static_ratio, q.friction.kinetic_ratio, viscous_step};
  std::uint32_t substeps = 0;
  ClosedFormResult result;
  result.H_WS = state.H_WS;
  Projection step;
  step.next = memory;
  do {
    const Motion free = unconstrained_motion(result.H_WS, input.H_WD);  // #3 (32), (33)
    const double travel = free.translation.norm() + q.mass.radius * free.rotation.norm();
    if (substeps > 0) detail::end(times, &StepTimes::solve_ns);
    result.contacts =
        penalty_contacts<DistancePenetration>(field, shell, result.H_WS, q.safety_distance, travel);  // #1 (1), (2)
    detail::end(times, &StepTimes::step1_ns);
    if (state.inside && !result.contacts.has_direction()) {
      step = Projection{};
      step.motion = free;  // deep inside, where the field has no gradient: follow the device
    } else {
      step = project(free, result.contacts, q.safety_distance, q.correction_gain, q.mass,
                     kFriction ? &friction : nullptr, step.next);  // #2-#4
    }
    const bool follows = !step.cut && result.contacts.depth <= 0.0;  // exactly the device pose, without rounding
    result.H_WS = follows ? input.H_WD : clipped_to(q.workspace, result.H_WS, result.H_WS * set_matrix(step.motion));
  } while (step.cut && ++substeps < kMaxSubsteps);
  result.cut = step.cut;
  result.substeps = std::min(substeps + 1, kMaxSubsteps);
  const Status status = finish_closed_form(input, result, q, state, report);  // #6, #7
  if (status == Status::kOk) memory = step.next;
  detail::end(times, &StepTimes::solve_ns);
  return status;
}

}  // namespace godobject
