#include "core/pipeline/contact/qp/coulomb_newton.h"

#include <cmath>

#include "core/pipeline/contact/qp/coulomb_pivots.h"
#include "core/pipeline/contact/qp/small_system.h"

namespace godobject::detail {
namespace {

constexpr int kPatience = 2;  // steps for the directions of slip to fit, before a pull is taken for one

/// The result of one step.
enum class Newton : std::uint8_t {
  kConverged,
  kSettled,  ///< the motion has converged, the directions of slip have not
  kContinue,
  kFailed,  ///< the equations are singular
};

/// The equations of one step. The unknowns are the multipliers of the half spaces, then for each slipping contact the
/// force tau across its slip, with tau = -(mu lambda / |slip|) (slip across).
struct NewtonSystem {
  static constexpr std::size_t kMost = 2 * ActiveSet::kCapacity;
  SmallSystem<kMost> equations;
  std::array<Vector6, kMost> force;  ///< change of z per unit of each unknown

  int size() const noexcept { return equations.size; }
  const Vector6& force_of(int unknown) const noexcept { return force[static_cast<std::size_t>(unknown)]; }
};

/// Writes the equations of one step from `target`.
void assemble(const ContactSet& set, const Vector6& target, NewtonSystem& system) noexcept {
  const ActiveSet& active = set.active();
  SmallSystem<NewtonSystem::kMost>& equations = system.equations;
  std::array<Vector6, ActiveSet::kCapacity> row;
  std::array<int, ActiveSet::kCapacity> across{};  // number of the unknown tau, or -1
  std::array<double, ActiveSet::kCapacity> compliance{};
  const int n = active.size();
  equations.size = n;
  for (int j = 0; j < n; ++j) {
    const auto at = static_cast<std::size_t>(j);
    const Contact& c = set.contact_of(j);
    const Vector3& slip = active[j].tag.slip;
    system.force[at] = set.space().gradient(c.normal, c.point, -c.ratio * slip, c.grip);
    row[at] = c.slips ? set.space().gradient(c.normal, c.point) : system.force[at];
    across[at] = -1;
    const double stiffness = c.ratio * active[j].multiplier;
    if (c.slips && stiffness > 0.0) {
      across[at] = equations.size++;
      compliance[at] = c.speed / stiffness;
      system.force[static_cast<std::size_t>(across[at])] = set.space().gradient(c.normal.cross(slip), c.grip);
    }
  }
  for (int j = 0; j < n; ++j) {
    const auto at = static_cast<std::size_t>(j);
    for (int k = 0; k < system.size(); ++k) equations.matrix[j][k] = row[at].dot(system.force_of(k));
    equations.rhs[j] = set.contact_of(j).required_gain - row[at].dot(target);
    if (across[at] < 0) continue;
    const int i = across[at];
    const Vector6& e = system.force_of(i);
    for (int k = 0; k < system.size(); ++k) equations.matrix[i][k] = e.dot(system.force_of(k));
    equations.matrix[i][i] += compliance[at];
    equations.rhs[i] = -e.dot(target);
  }
}

/// Sets the metric with viscous friction to the multipliers of the half spaces.
void set_viscous_metric(ContactSet& set) noexcept {
  std::array<double, ContactSet::kMaxContacts> load{};
  for (int j = 0; j < set.active().size(); ++j)
    load[static_cast<std::size_t>(set.active()[j].tag.contact)] += set.active()[j].multiplier;
  set.set_viscous_metric(load);
}

/// Turns half space `j` of a slipping contact against the slip of the motion `m`. True: it turned by more than the
/// tolerance, or differs from the slip by more than that.
bool follow_slip(const Motion& m, int j, ContactSet& set) noexcept {
  ActiveSet::Inequality& half_space = set.active().at(j);
  Contact& c = set.contact_of(j);
  const Slip slip = set.slip_of(c, m);
  // direction of this step's force: near rest it is much more precise than the slip
  const Vector3 old = half_space.tag.slip;
  const double along = slip.speed * slip.direction.dot(old);
  Vector3 pull = c.speed * old + (slip.speed * slip.direction - along * old);
  pull -= c.normal.dot(pull) * c.normal;  // rounding grows where the slip is much larger than the last one
  const Vector3 direction = pull.normalized();
  const double friction = c.ratio * half_space.multiplier;
  const double tolerance = set.metric().tolerance;
  const bool turned =
      friction * (direction - slip.direction).norm() > tolerance || friction * (direction - old).norm() > tolerance;
  half_space.tag.slip = direction;
  const double speed = slip.speed * slip.direction.dot(direction);
  c.speed = speed > 0.25 * c.speed ? speed : 0.25 * c.speed;
  c.reversals = speed < 0.0 ? c.reversals + 1 : 0;
  return turned;
}

/// Returns the squared distance of two motions in the coupling's metric [m^2].
double squared_distance(const Motion& a, const Motion& b, double gyration) noexcept {
  return (a.translation - b.translation).squaredNorm() + (gyration * (a.rotation - b.rotation)).squaredNorm();
}

/// Runs one step from the motion `m` to the next. `trusted`: the directions of slip are close enough that a pulling
/// force means an open contact.
Newton newton_step(bool trusted, Motion& m, ContactSet& set) noexcept {
  ActiveSet& active = set.active();
  const CouplingMetric& metric = set.metric();
  const bool viscous = set.friction()->viscous_step > 0.0;
  if (viscous) set_viscous_metric(set);
  const Vector6 target = set.target();
  NewtonSystem system;
  assemble(set, target, system);
  if (!system.equations.solve()) return Newton::kFailed;
  Vector6 z = target;
  for (int k = 0; k < system.size(); ++k) z += system.equations.rhs[k] * system.force_of(k);
  z = set.space().plain(z);
  const double* const multiplier = system.equations.rhs;
  if (!z.allFinite()) return Newton::kFailed;
  if (trusted && drop_first_to_vanish(multiplier, set)) return Newton::kContinue;
  // a motion that does not change has converged, whatever the direction of a slip of nanometres
  const bool settled =
      (z.head<3>() - m.translation).squaredNorm() + (z.tail<3>() - metric.gyration * m.rotation).squaredNorm() <=
      metric.tolerance * metric.tolerance;
  m = set.space().motion(z);
  // viscous friction uses the shares of the step before
  Newton result = settled || !viscous ? Newton::kConverged : Newton::kContinue;
  for (int j = 0; j < active.size(); ++j) {
    const double changed = std::fabs(multiplier[j] - active[j].multiplier);
    if (viscous && changed > metric.tolerance) result = Newton::kContinue;
    active.at(j).multiplier = multiplier[j];
    const Contact& c = set.contact_of(j);
    const double speed = set.slip_of(c, m).speed;
    if (!c.slips) {
      if (c.has_friction && speed > metric.still && !settled) result = Newton::kContinue;
    } else if (follow_slip(m, j, set) && !(settled && speed <= metric.tolerance)) {
      result = settled ? Newton::kSettled : Newton::kContinue;
    }
  }
  if (hold_or_release(set)) return Newton::kContinue;
  if (result != Newton::kContinue && drop_first_to_vanish(multiplier, set)) return Newton::kContinue;
  return result;
}

/// Tells whether the half spaces with the shifts of the motion `m` reproduce `m`.
bool confirm(const Motion& m, ContactSet& set) noexcept {
  const int size = set.active().size();
  for (int k = 0; k < set.contact_count(); ++k) {
    Contact& c = set.contact(k);
    c.shift = c.slips ? set.slip_of(c, m).speed : 0.0;
  }
  set.resolve();
  const double tolerance = set.metric().tolerance;
  return set.active().size() == size &&
         squared_distance(set.motion(), m, set.metric().gyration) <= tolerance * tolerance;
}

/// Iterates from the set's motion. False: it failed, and the caller must restore the set.
bool iterate(ContactSet& set) noexcept {
  Motion m = set.motion();
  bool trusted = false;
  for (int step = 0; step < kMostNewtonSteps && !set.work().is_spent(); ++step) {
    set.work().add(Work::kNewton);
    begin_to_slip(m, set);
    const Newton result = newton_step(trusted || step >= kPatience, m, set);
    if (result == Newton::kFailed) return false;
    trusted = result != Newton::kContinue;
    if (result == Newton::kContinue) continue;
    const ContactRows::Violated worst = set.most_violated(m);
    if (worst.row != ContactRows::kNone) {
      if (!set.enter(worst.row, m)) return false;
    } else if (result == Newton::kConverged) {
      return confirm(m, set);
    }
  }
  return false;
}

}  // namespace

bool solve_coulomb(ContactSet& set) noexcept {
  const ContactSet::Saved found = set.save();
  if (iterate(set)) return true;
  set.restore(found);
  return false;
}

}  // namespace godobject::detail
