#include "core/pipeline/contact/contact_result.h"

#include <algorithm>
#include <array>

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/damping.h"
#include "core/pipeline/cycle/commit.h"
#include "core/pipeline/cycle/constraint_force.h"

namespace godobject::detail {
namespace {

/// Returns the damping force b_D on the device's velocity along the active normals, in W about the centre of mass [N,
/// Nm]. `k`: k_D k_VC,x [N/m].
Wrench damping_of(const ConstrainedStep& step, const Pose& H_WS, const Motion& velocity_W, double gyration, double k,
                  double damping_over_stiffness) noexcept {
  Wrench out;
  const Matrix3 R_WS = H_WS.rotation.toRotationMatrix();
  Vector6 damping;  // (b_D / k_D) v, in the coupling's metric [m]
  damping << R_WS.transpose() * velocity_W.translation, gyration * (R_WS.transpose() * velocity_W.rotation);
  damping *= damping_over_stiffness;
  if (damping.isZero(0.0)) return out;
  std::array<Vector6, 6> rows;
  Vector6 load = Vector6::Zero();
  for (std::uint32_t j = 0; j < step.force_count; ++j) {
    const ContactForce& force = step.forces[j];
    rows[j] << force.normal, force.point.cross(force.normal) / gyration;
    load += force.multiplier * rows[j];
  }
  const Vector6 change = damping_change(rows.data(), step.force_count, load, damping);
  out.force = k * (R_WS * change.head<3>());
  out.torque = k * gyration * (R_WS * change.tail<3>());
  return out;
}

}  // namespace

Status finish_contact(const CycleInput& input, const ContactResult& result, const ConstrainedStep& step,
                      const Parameters& q, const ContactLengths& lengths, ContactMemory& memory, ProxyState& state,
                      CycleReport& report) noexcept {
  DeviceForce force;
  // a spring to a pose of which nobody knows whether it is inside would push at random
  if (!result.unknown && !(result.H_WS == input.H_WD)) {
    const Motion stretch = coupling_stretch(input.H_WD, result.H_WS);                                // #6 (44), (45)
    const Wrench coupling = constraint_force(stretch, q.coupling_translation, q.coupling_rotation);  // (46)
    force.spring_W.force = q.stiffness * input.H_WD.rotation._transformVector(coupling.force);       // #7
    force.spring_W.torque = q.stiffness * input.H_WD.rotation._transformVector(coupling.torque);
    force.total_W = force.spring_W;
  }
  if (step.force_count > 0) {
    const Wrench damping = damping_of(step, result.H_WS, input.velocity_W, lengths.metric.gyration,
                                      q.stiffness * q.coupling_translation, q.damping / q.stiffness);
    force.total_W.force += damping.force;
    force.total_W.torque += damping.torque;
  }
  const Status status = commit(input, result.H_WS, force, result.inside, state, report);
  if (status != Status::kOk) return status;
  memory.last_step = step;
  memory.H_WD_last = input.H_WD;
  report.penetration = -std::min(result.smallest, lengths.shortest_search_radius);
  report.contacts = step.contact_count;
  report.dropped = result.dropped;
  report.substeps = std::max(1u, result.substeps);
  report.unconverged = step.unconverged;
  report.work = memory.work.spent();
  report.out_of_work = result.out_of_work;
  report.outcome = outcome_of({.held = step.force_count > 0,
                               .cut = result.cut,
                               .dropped = result.dropped > 0,
                               .infeasible = step.infeasible,
                               .inside = result.inside});
  return Status::kOk;
}

}  // namespace godobject::detail
