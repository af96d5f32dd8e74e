#pragma once

#include "core/pipeline/contact/contact_memory.h"
#include "core/pipeline/contact/contact_scene.h"
#include "core/pipeline/contact/contact_substeps.h"
#include "core/pipeline/cycle/state.h"
#include "core/pipeline/cycle/step_times.h"
#include "godobject/report.h"
#include "godobject/status.h"

namespace godobject {

/// Runs one cycle of `contact`: the least-constraint motion over the contact points, in certified sub-steps; no filter.
///
/// Guarantee: a point whose stored distance is positive never gets one <= 0, whatever the device does (certificate.h).
/// No stored sharp edge of the moving body crosses one of the still body (edge_certificate.h). After a
/// first pose that penetrates, the guarantee begins when the god object has come out.
///
/// The remainder of a shortened motion becomes the next sub-step. Another sub-step also follows a motion that took a
/// contact past an edge. One more follows a motion that a second look directed, or that ended at the lowest energy
/// along its way, as at the bottom of a valley of the field, if it came nearer to the device by more than a margin.
/// Points that the point budget leaves without a look-up limit the motion to the bound of their clearance: the god
/// object may lag, which is counted, but crosses nothing.
///
/// When the budget of work is spent, the cycle ends with the motion that is certified so far. If the god object has not
/// moved, the next cycle goes on with the search, or with its lists (KeptSearch), and WorkShare shortens the motion
/// that does not fit. That limits the cost further than the counts below.
///
/// A first pose that penetrates is left along the gradients, and where these contradict each other along the motion
/// that misses them least (overlap.h), near the device. Where the field has none (deeper than the band) the god object
/// follows the device, without force, until it is free.
///
/// Statuses as those of `commit`; if not kOk, `state` and what `memory` carries to the next cycle are unchanged, except
/// that a search that would have gone on begins again.
/// `times`: step #1 contains every look-up, also those of the certificate, except those that test a rest after a second
/// look. Cost: at most kMaxSubsteps sub-steps with a near point, each with at most kMostAttempts attempts. An attempt
/// looks up each near point, and each force three times. A sub-step solves at most 6 (2 (kMostSecondLooks + 2) +
/// kMostRefills + (1 + kMostExtensions) (1 + kMostImpliedRounds)) times: once, and once more for each time that bounded
/// points become rows, both also without implied rows; in each second look with and without arcs, of which two may
/// fail; with rows of left-out points; each in one or two metrics, with and without required gains, or with slower
/// ones. Besides, kMostFreeSubsteps sub-steps without a near point, and kMostBallsOfCycle further look-ups a cycle.
/// Real-time safe.
template <bool kFriction, DistanceField Field, DistanceField BodyField>
Status contact_cycle(const ContactScene<Field, BodyField>& scene, const CycleInput& input, ContactMemory& memory,
                     ProxyState& state, CycleReport& report, StepTimes* times = nullptr) noexcept {
  detail::begin(times);
  detail::ContactSubsteps<kFriction, Field, BodyField> substeps(scene, input, state, memory, times);
  do {
    substeps.begin();                      // #3 (32), (33)
    if (substeps.is_known_free()) break;   //    without a look-up: at the device
    substeps.find_surroundings();          // #1, in place of (1), (2)
    if (substeps.is_out_of_work()) break;  // the budget is spent: stay
    if (substeps.is_free()) break;         //    no near point: at the device
    substeps.constrain();                  // #4, in place of (5)-(31), (36)-(42)
    if (substeps.is_out_of_work()) break;
    if (substeps.is_lost()) break;  //    deep inside: follow the device
    substeps.certify();             //    the motion that meets no surface
    substeps.advance();             //    to the end of that motion
  } while (substeps.remain());
  const Status status = substeps.finish(state, report);  // #6, #7 (44)-(46)
  detail::end(times, &StepTimes::solve_ns);
  return status;
}

}  // namespace godobject
