#include "core/pipeline/contact/contact_cycle.h"

#include "core/pipeline/contact/qp/dual_active_set.h"
#include "core/pipeline/cycle/constraint_force.h"

namespace godobject {

ContactLengths ContactLengths::make(const Parameters& q) noexcept {
  ContactLengths lengths;
  lengths.margin = q.margin;
  lengths.wanted_margin = 0.8 * q.margin;
  lengths.least_margin = 0.25 * q.margin;
  lengths.rounding = std::min(1e-6 * q.voxel_size, 0.1 * lengths.least_margin);
  lengths.shortest_reach = shortest_reach_of(q);
  lengths.longest_reach = 1.5 * q.voxel_size;
  lengths.opening = 0.01 * q.voxel_size;
  lengths.largest_gain = 0.25 * q.voxel_size;
  lengths.radius = q.mass.radius;
  lengths.sphere = q.mass.sphere;
  lengths.point_budget = q.point_budget;
  lengths.metric.gyration = std::sqrt(q.coupling_rotation / q.coupling_translation);
  lengths.metric.tolerance = std::max(1e-3 * q.margin, 1e-6 * q.voxel_size);
  lengths.metric.still = 1e-6 * q.voxel_size;
  return lengths;
}

double ContactLengths::reach_for(double way, double longest) const noexcept {
  return std::clamp(way + 3.0 * margin, std::min(shortest_reach, longest), longest);
}

namespace detail {

Selection select_rows(ContactWorkspace& workspace) noexcept {
  constexpr std::uint32_t kDeepest = ContactRows::kCapacity / 2;
  std::uint32_t count = 0;
  for (const auto* near : {&workspace.samples, &workspace.features}) {
    for (std::uint32_t k = 0; k < near->count; ++k) {
      workspace.distances[count++] = static_cast<float>(near->distance[k]);
    }
  }
  if (count <= ContactRows::kCapacity) return {std::numeric_limits<double>::infinity(), 1};
  float* const begin = workspace.distances.data();
  std::nth_element(begin, begin + kDeepest, begin + count);
  // strictly below: equal distances, as on a flat face, are spread
  const double deepest = static_cast<double>(std::nextafter(begin[kDeepest], -std::numeric_limits<float>::infinity()));
  const std::uint32_t room = ContactRows::kCapacity - kDeepest;
  return {deepest, (count + room - 1) / room};
}

double first_reach(const State& state, const CycleInput& input, const ContactLengths& lengths,
                   double longest) noexcept {
  constexpr double kMost = 2.0;
  const double last = travel(lengths.sphere, state.contact.motion);
  const double device = state.started ? farthest_way(lengths.sphere, state.H_WD, input.H_WD) : 0.0;
  return lengths.reach_for(std::min(ContactLengths::kReachOverWay * std::max(last, device), kMost * last), longest);
}

double allowed_share(const Motion& motion, const Surroundings& around, double reach, const ContactLengths& lengths,
                     bool constrained) noexcept {
  constexpr double kLargestTurn = 0.1;  // rad
  const double turn = motion.rotation.norm();
  const double way = travel(lengths.sphere, motion);
  const double room = std::max(around.left_out - lengths.margin, 0.5 * around.left_out);
  double share = way > room ? room / way : 1.0;
  if (constrained) {
    // the rows are linear in r: half of |r|^2 R_max, what they neglect, stays within half of the reach
    const double largest = std::min(kLargestTurn, std::sqrt(reach / lengths.radius));
    if (share * turn > largest) share = largest / turn;
  }
  return share;
}

namespace {

/// The damping b_D on the device's velocity along the active normals, as a change of the spring's contact forces.
/// With the normals' rows as the columns of C and the spring's loads on them, C load - (b_D / k_D) v is projected on
/// the cone of what the normals can push: the change is never larger than b_D |(v, rho omega)|, is continuous, and no
/// contact pulls. Where the loads are not the contacts' own (nobody can meet all rows) that does not hold: then there
/// is none. `k` = k_D k_VC,x.
Wrench damping(const ConstrainedStep& step, const Pose& H_WS, const Motion& velocity_W, double gyration, double k,
               double damping_over_stiffness) noexcept {
  Wrench out;
  const Matrix3 R_WS = H_WS.rotation.toRotationMatrix();
  Vector6 asked;  // (b_D / k_D) v
  asked << R_WS.transpose() * velocity_W.translation, gyration * (R_WS.transpose() * velocity_W.rotation);
  asked *= damping_over_stiffness;
  if (asked.isZero(0.0)) return out;
  std::array<Vector6, 6> row;
  Vector6 load = Vector6::Zero();
  for (std::uint32_t j = 0; j < step.force_count; ++j) {
    const ContactForce& force = step.forces[j];
    row[j] << force.normal, force.point.cross(force.normal) / gyration;
    load += force.multiplier * row[j];
  }
  struct NoTag {};
  DualActiveSet<NoTag> set;
  set.start(asked - load);
  const double tolerance = 1e-12 * (asked.norm() + load.norm());
  for (int round = 0; round < 4 * DualActiveSet<NoTag>::kCapacity; ++round) {
    DualActiveSet<NoTag>::Inequality worst;
    double violation = tolerance;
    for (std::uint32_t j = 0; j < step.force_count; ++j) {
      const double here = -row[j].dot(set.z());
      if (!(here > violation)) continue;
      violation = here;
      worst.gradient = row[j];
    }
    if (!(violation > tolerance) || !set.add(worst)) break;
  }
  // The loads alone are projected on 0, and of two points the projections' residuals are no farther apart than they.
  // Rows that contradict each other but for their rounding carry loads whose sum is rounding only; a projection from
  // there is none.
  constexpr double kRoundedUp = 1.0 + 1e-9;
  const Vector6 change = set.z() - asked;
  if (!(change.norm() <= kRoundedUp * asked.norm())) return out;
  out.force = k * (R_WS * change.head<3>());
  out.torque = k * gyration * (R_WS * change.tail<3>());
  return out;
}

}  // namespace

Status finish(const CycleInput& input, const ContactResult& result, bool inside, const Parameters& q, State& state,
              CycleReport& report) noexcept {
  DeviceForce force;
  const bool coupled = !(result.H_WS == input.H_WD);
  if (coupled) {
    const Motion stretch = coupling_stretch(input.H_WD, result.H_WS);                                // #6 (44), (45)
    const Wrench coupling = constraint_force(stretch, q.coupling_translation, q.coupling_rotation);  // (46)
    force.spring_W.force = q.stiffness * input.H_WD.rotation._transformVector(coupling.force);       // #7
    force.spring_W.torque = q.stiffness * input.H_WD.rotation._transformVector(coupling.torque);
    force.total_W = force.spring_W;
  }
  if (result.step.force_count > 0) {
    const double gyration = std::sqrt(q.coupling_rotation / q.coupling_translation);
    const Wrench damped = damping(result.step, result.H_WS, input.velocity_W, gyration,
                                  q.stiffness * q.coupling_translation, q.damping / q.stiffness);
    force.total_W.force += damped.force;
    force.total_W.torque += damped.torque;
  }
  bool finite = result.H_WS.is_finite();
  if (coupled || result.step.force_count > 0) {  // else there is no force
    finite &= force.total_W.force.allFinite() && force.total_W.torque.allFinite() && force.spring_W.force.allFinite() &&
              force.spring_W.torque.allFinite();
  }
  if (!finite) return Status::kNotFinite;

  report.outcome = result.step.force_count > 0 ? Outcome::kContact : Outcome::kFree;
  if (result.cut) report.outcome = Outcome::kCut;
  if (result.dropped > 0) report.outcome = Outcome::kOverflow;
  if (result.step.infeasible) report.outcome = Outcome::kInfeasible;
  if (inside) report.outcome = Outcome::kStartInside;
  state.H_WS = result.H_WS;
  state.H_WD = input.H_WD;
  state.contact = result.step;
  state.inside = inside;
  state.started = true;
  report.H_WS = result.H_WS;
  report.force = force;
  report.penetration = -std::min(result.smallest, ContactLengths::shortest_reach_of(q));
  report.contacts = result.step.contact_count;
  report.dropped = result.dropped;
  report.substeps = std::max(1u, result.substeps);
  report.unconverged = result.step.unconverged;
  return Status::kOk;
}

}  // namespace detail
}  // namespace godobject
