#pragma once

#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/cycle/state.h"
#include "core/pipeline/cycle/step_times.h"
#include "core/pipeline/cycle/unconstrained_motion.h"
#include "core/pipeline/cycle/workspace_limit.h"
#include "core/pipeline/paper/constrained_motion.h"
#include "core/pipeline/paper/correction.h"
#include "core/pipeline/paper/proxy_filter.h"
#include "core/pipeline/penalty/closed_form_finish.h"
#include "core/pipeline/penalty/penalty_contacts.h"

namespace godobject {

// clang-format off: equation numbers stand in a column of their own

/// Runs one cycle of `paper`: equations (1)-(48) as printed, with the corrections that core/README.md lists. Step #8 is
/// the caller's. Statuses as those of `commit`; if not kOk, state and report are unchanged. Real-time safe.
template <bool kFriction, DistanceField Field>
Status paper_cycle(const Field& field, const Pointshell& shell, const Parameters& q, const CycleInput& input,
                   ProxyState& state, CycleReport& report, StepTimes* times = nullptr) noexcept {
  detail::begin(times);
  ClosedFormResult result;
  result.contacts =
      penalty_contacts<LayerPenetration>(field, shell, state.H_WS, q.safety_distance, 0.0);  // #1 (1), (2)
  detail::end(times, &StepTimes::step1_ns);

  result.H_WS = input.H_WD;  // region C
  if (result.contacts.depth > 0.0) {
    const Correction c = correction(result.contacts, q.safety_distance, q.mass);  // #2 (3)-(27)
    const bool region_A = c.penetration >= 0.0;
    const double eta = region_A ? q.correction_gain : 0.0;
    const Pose H_pen = set_matrix({eta * c.delta.translation, eta * c.delta.rotation});  //    (28)
    const Pose H_WSc = state.H_WS * H_pen;                                               //    (29)
    const Vector3 u_x = H_pen.rotation.conjugate()._transformVector(c.u_x);              //    (30)
    const Vector3 u_r = H_pen.rotation.conjugate()._transformVector(c.u_r);
    const Motion free = unconstrained_motion(H_WSc, input.H_WD);                                       // #3 (32), (33)
    Motion step{constrained_motion(free.translation, u_x, c.delta.translation.norm(), c.penetration),  // #4 (36)-(39)
                constrained_motion(free.rotation, u_r, c.delta.rotation.norm(), c.penetration)};
    if constexpr (kFriction) {
      const Vector3 x_across = split(free.translation, u_x).perpendicular;  //    (35)
      const Vector3 r_across = split(free.rotation, u_r).perpendicular;
      // (40): exactly zero where all of the motion is allowed; a rounding error would bring the viscous friction about
      const Vector3 x_restricted = free.translation - step.translation;
      const Vector3 r_restricted = free.rotation - step.rotation;
      const PaperFriction& mu = q.paper_friction;
      step.translation +=
          paper_friction(x_restricted, x_across, mu.translation_static, mu.translation_kinetic, mu.viscous);
      step.rotation += paper_friction(r_restricted, r_across, mu.rotation_static, mu.rotation_kinetic, mu.viscous);
    }                                                       //    (47), (48)
    const Pose H_WS_unfiltered = H_WSc * set_matrix(step);  //    (41), (42)
    result.H_WS = clipped_to(q.workspace, state.H_WS,
                             filter_proxy(state.H_WS, H_WS_unfiltered, input.H_WD, q.period));  // #5 (43)
  }
  const Status status = finish_closed_form(input, result, q, state, report);  // #6, #7 (44)-(46)
  detail::end(times, &StepTimes::solve_ns);
  return status;
}

// clang-format on

}  // namespace godobject
