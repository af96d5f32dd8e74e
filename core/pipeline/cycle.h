#pragma once

#include <algorithm>
#include <cstdint>

#include "core/pipeline/constrained_motion.h"
#include "core/pipeline/constraint_force.h"
#include "core/pipeline/correction.h"
#include "core/pipeline/device_force.h"
#include "core/pipeline/least_constraint.h"
#include "core/pipeline/parameters.h"
#include "core/pipeline/penalty_contacts.h"
#include "core/pipeline/projection.h"
#include "core/pipeline/proxy_filter.h"
#include "core/pipeline/workspace_limit.h"
#include "core/status.h"

namespace godobject {

/// What the operator's side gives to one cycle: the body's pose on the device and its velocity, in W.
struct CycleInput {
  Pose H_WD;          ///< frame B of the moving body as the device holds it, its origin in the workspace
  Motion velocity_W;  ///< of D's origin [m/s] and angular [rad/s]; damping only
};

/// How a cycle went; one word a row of a replay.
enum class Outcome : std::uint8_t {
  kFree,         ///< no contact: the god object is the device pose
  kContact,      ///< constrained
  kStartInside,  ///< the first pose penetrated, and the god object is still on its way out
  kCut,          ///< a motion was shortened so as not to jump over the surface
  kOverflow,     ///< more near points than a workspace holds or the budget allows (contact solver)
  kBadInput,     ///< the device pose was no pose; the god object was held
  kInfeasible,   ///< constraints without a solution (contact solver)
};

/// `free contact start_inside cut overflow bad_input infeasible`
const char* name(Outcome outcome) noexcept;

/// Carried from cycle to cycle; written once, at the end of a cycle that went well.
struct State {
  Pose H_WS;                   ///< the god object
  bool started = false;        ///< a cycle has been finished
  bool inside = false;         ///< it started in penetration and has not come out
  ProjectionState projection;  ///< of `corrected`
  ConstrainedStep contact;     ///< of `contact`: its last motion and what held it
  Pose H_WD;                   ///< of `contact`: the device
};

/// What a cycle leaves for others to look at.
struct CycleReport {
  Pose H_WS;          ///< god object after the cycle, frame B
  DeviceForce force;  ///< for the device, in W about the centre of mass
  /// p = p_d - d of step #1, before the cycle's motion [m]; `contact`: minus the smallest stored distance,
  /// known as far as it is below an eighth of a voxel
  double penetration = 0.0;
  std::uint32_t contacts = 0;  ///< points with V > 0; `contact`: rows that carry a force, two of one point are two
  std::uint32_t dropped = 0;   ///< `contact`: near points for which rows or the budget did not suffice, last sub-step
  std::uint32_t substeps = 0;  ///< `contact`: with something near; 1 where nothing was
  bool unconverged = false;    ///< contact: friction is not Coulomb's to the tolerance; gaps are kept all the same
  bool outside = false;        ///< the device is outside of the workspace: it is pushed back, once it has been inside
  Outcome outcome = Outcome::kFree;
};

/// Optional stopwatch: how long step #1 and steps #2-#7 of one cycle took, all its sub-steps and attempts together
/// (`contact`: the look-ups of the certificate count as step #1). The core has no clock of its own. Each stretch of
/// time holds one reading of the clock: one of step #1 and one of the rest in `paper`; one of both a sub-step in
/// `corrected`; in `contact` one of both a sub-step and one of both for each of its attempts at a motion.
struct StepTimes {
  std::int64_t (*now_ns)() noexcept = nullptr;
  std::int64_t step1_ns = 0;
  std::int64_t solve_ns = 0;
  std::int64_t since_ns = 0;  ///< begin of the stretch that runs
};

/// The god object leaves `inside` once it is less than this deep; corrections approach the surface, they do not reach
/// it. [voxels]
inline constexpr double kOutside = 0.1;

/// Of one cycle of `corrected` or `contact`.
inline constexpr std::uint32_t kMaxSubsteps = 8;

namespace detail {

inline void begin(StepTimes* times) noexcept {
  if (times == nullptr) return;
  times->step1_ns = times->solve_ns = 0;
  times->since_ns = times->now_ns();
}

/// Ends a stretch of time and begins the next.
inline void end(StepTimes* times, std::int64_t StepTimes::*spent) noexcept {
  if (times == nullptr) return;
  const std::int64_t now_ns = times->now_ns();
  times->*spent += now_ns - times->since_ns;
  times->since_ns = now_ns;
}

/// Steps #6 and #7, the finite check, and the only place where `state` changes.
Status finish(const CycleInput& input, const Pose& H_WS, const PenaltyContacts& contacts, const Projection& step,
              std::uint32_t substeps, const Parameters& parameters, State& state, CycleReport& report) noexcept;

}  // namespace detail

// clang-format off: equation numbers stand in a column of their own

/// One cycle of `paper`: equations (1)-(48) as printed but for the few mended ones (core/README.md). #8 is the
/// caller's. kNotFinite: a NaN or Inf would have left the cycle; state and report are unchanged. Real-time safe.
template <bool kFriction, DistanceField Field>
Status paper_cycle(const Field& field, const Pointshell& shell, const Parameters& q, const CycleInput& input,
                   State& state, CycleReport& report, StepTimes* times = nullptr) noexcept {
  detail::begin(times);
  const auto contacts =
      penalty_contacts<LayerPenetration>(field, shell, state.H_WS, q.safety_distance, 0.0);  // #1 (1), (2)
  detail::end(times, &StepTimes::step1_ns);

  Pose H_WS = input.H_WD;  // region C
  if (contacts.depth > 0.0) {
    const Correction c = correction(contacts, q.safety_distance, q.mass);  // #2 (3)-(27)
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
      const SplitMotion x = split(free.translation, u_x);
      const SplitMotion r = split(free.rotation, u_r);
      const PaperFriction& mu = q.paper_friction;
      const Vector3 x_restricted = x.parallel - split(step.translation, u_x).parallel;  //    (40)
      const Vector3 r_restricted = r.parallel - split(step.rotation, u_r).parallel;
      step.translation +=
          paper_friction(x_restricted, x.perpendicular, mu.translation_static, mu.translation_kinetic, mu.viscous);
      step.rotation +=
          paper_friction(r_restricted, r.perpendicular, mu.rotation_static, mu.rotation_kinetic, mu.viscous);
    }                                                       //    (47), (48)
    const Pose H_WS_unfiltered = H_WSc * set_matrix(step);  //    (41), (42)
    H_WS = kept_within(q.workspace, state.H_WS,
                       filter_proxy(state.H_WS, H_WS_unfiltered, input.H_WD, q.period));  // #5 (43)
  }
  const Status status = detail::finish(input, H_WS, contacts, Projection{}, 1, q, state, report);  // #6, #7 (44)-(46)
  detail::end(times, &StepTimes::solve_ns);
  return status;
}

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
