#include "core/pipeline/penalty/closed_form_finish.h"

#include "core/pipeline/cycle/commit.h"
#include "core/pipeline/cycle/constraint_force.h"
#include "core/pipeline/cycle/device_force.h"

namespace godobject {
namespace {

/// A god object that started inside counts as outside once it is less than this deep [voxels]: corrections remove a
/// share of the depth in each cycle and never all of it. Chosen: the depth to which `corrected` holds a single contact
/// (test Corrected.StaysOutOfAFloorWithinATenthOfAVoxel).
constexpr double kOutside = 0.1;

}  // namespace

Status finish_closed_form(const CycleInput& input, const ClosedFormResult& result, const Parameters& parameters,
                          ProxyState& state, CycleReport& report) noexcept {
  const Motion stretch = coupling_stretch(input.H_WD, result.H_WS);  // #6 (44), (45)
  const Wrench coupling =
      constraint_force(stretch, parameters.coupling_translation, parameters.coupling_rotation);  // (46)
  const DeviceForce force = device_force(coupling, input.H_WD, input.velocity_W, parameters);    // #7
  const double penetration = result.contacts.depth - parameters.safety_distance;
  // a first pose that penetrates is reported even if it does so by less
  const bool came_out = state.started && penetration <= kOutside * parameters.voxel_size;
  const bool inside = state.inside && !came_out;
  if (const Status status = commit(input, result.H_WS, force, inside, state, report); status != Status::kOk) {
    return status;
  }
  report.penetration = penetration;
  report.contacts = result.contacts.count;
  report.dropped = 0;
  report.substeps = result.substeps;
  report.unconverged = false;
  report.work = 0;
  report.out_of_work = false;
  report.outcome = result.contacts.depth > 0.0 ? Outcome::kContact : Outcome::kFree;
  if (result.cut) report.outcome = Outcome::kCut;
  if (inside) report.outcome = Outcome::kStartInside;
  return Status::kOk;
}

}  // namespace godobject
