#include "core/pipeline/penalty/closed_form_finish.h"

#include "core/pipeline/cycle/constraint_force.h"
#include "core/pipeline/cycle/device_force.h"


// Of the closed forms, `paper` and `corrected`.
namespace godobject::detail {

Status finish(const CycleInput& input, const Pose& H_WS, const PenaltyContacts& contacts, const Projection& step,
              std::uint32_t substeps, const Parameters& parameters, State& state, CycleReport& report) noexcept {
  const Motion stretch = coupling_stretch(input.H_WD, H_WS);  // #6 (44), (45)
  const Wrench coupling =
      constraint_force(stretch, parameters.coupling_translation, parameters.coupling_rotation);  // (46)
  const DeviceForce force = device_force(coupling, input.H_WD, input.velocity_W, parameters);    // #7
  const bool finite = H_WS.is_finite() && force.total_W.force.allFinite() && force.total_W.torque.allFinite() &&
                      force.spring_W.force.allFinite() && force.spring_W.torque.allFinite();
  if (!finite) return Status::kNotFinite;

  state.H_WS = H_WS;
  state.projection = step.next;
  const double penetration = contacts.depth - parameters.safety_distance;
  // a first pose that penetrates is reported as such, however little it does
  if (state.started && penetration <= kOutside * parameters.voxel_size) state.inside = false;
  state.started = true;
  report.H_WS = H_WS;
  report.force = force;
  report.penetration = penetration;
  report.contacts = contacts.count;
  report.substeps = substeps;
  report.unconverged = false;
  if (state.inside) {
    report.outcome = Outcome::kStartInside;
  } else if (step.cut) {
    report.outcome = Outcome::kCut;
  } else {
    report.outcome = contacts.depth > 0.0 ? Outcome::kContact : Outcome::kFree;
  }
  return Status::kOk;
}

}  // namespace godobject::detail
