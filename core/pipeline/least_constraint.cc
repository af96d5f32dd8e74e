#include "core/pipeline/least_constraint.h"

#include <algorithm>

#include "core/pipeline/contact_forces.h"
#include "core/pipeline/contact_set.h"
#include "core/pipeline/coulomb_newton.h"
#include "core/pipeline/shifted_cones.h"

namespace godobject {
namespace {

using detail::Additions;
using detail::Contact;
using detail::ContactSet;

constexpr int kRounds = 5;

static_assert(detail::kMostRowAdditions == kMostAdditions);
// rest, Newton's method once and in each round, the rounds' cones, the last word (more than coming to rest takes)
static_assert(detail::kMostConeAdditions + (1 + kRounds) * detail::kMostNewtonSteps +
                  kRounds * detail::kMostConeAdditions + detail::kMostRowAdditions ==
              kMostFrictionAdditions);

/// The contact of the row, opened with the shift of the last motion if it is not yet.
int contact_of_row(std::uint32_t row, ContactSet& set) noexcept {
  for (int k = 0; k < set.contact_count(); ++k) {
    if (set.contact(k).row == row) return k;
  }
  const int k = set.open(row);
  set.contact(k).shift = set.slip_of(set.contact(k), set.last()).speed;
  return k;
}

/// The row of the force's point; of several, which a second look at an obstacle gives it, the one whose normal fits
/// best.
std::uint32_t row_of(const ContactForce& force, const ContactRows& rows) noexcept {
  const std::uint32_t* const end = rows.id + rows.count;
  std::uint32_t best = ContactRows::kNone;
  double best_fit = 0.0;
  for (const std::uint32_t* id = std::find(rows.id, end, force.id); id != end; id = std::find(id + 1, end, force.id)) {
    const auto row = static_cast<std::uint32_t>(id - rows.id);
    const double fit = rows.normal(row).dot(force.normal);
    if (best != ContactRows::kNone && !(fit > best_fit)) continue;
    best = row;
    best_fit = fit;
  }
  return best;
}

/// The forces of the last step as a guess, as far as their points still have rows.
void warm_start(const ConstrainedStep& step, ContactSet& set) noexcept {
  for (std::uint32_t i = 0; i < step.force_count; ++i) {
    const ContactForce& force = step.forces[i];
    const std::uint32_t row = row_of(force, set.rows());
    if (row == ContactRows::kNone) continue;
    if (set.friction() == nullptr) {
      set.active().guess(set.row_half_space(row));
      continue;
    }
    const int k = contact_of_row(row, set);
    const Vector3& normal = set.contact(k).normal;
    const Vector3 slip = force.slip - normal.dot(force.slip) * normal;
    const double length = slip.norm();
    set.active().guess(set.cone_half_space(k, length > 0.5 ? Vector3(slip / length) : Vector3::Zero()));
  }
  set.active().resolve();
  if (set.friction() != nullptr) set.close_idle();
}

/// Shifts for the convex problem to go on with where Newton's method failed: none at first, then towards the slip.
void follow_shifts(bool first, ContactSet& set) noexcept {
  const Motion m = set.motion();
  for (int k = 0; k < set.contact_count(); ++k) {
    Contact& c = set.contact(k);
    c.shift = first ? 0.0 : 0.5 * (c.shift + set.slip_of(c, m).speed);
  }
  set.resolve();
}

/// False: infeasible.
bool solve_frictionless(ContactSet& set, ConstrainedStep& step) noexcept {
  const bool feasible = detail::meet_rows(set) != Additions::kContradictory;
  detail::take_forces(set, step);
  step.motion = set.motion();
  step.follows = step.force_count == 0;
  return feasible;
}

/// Coulomb's law to the tolerance; false after the last round. The steps 1 to 3 of `least_constraint`.
bool solve_friction(ContactSet& set, const ConstrainedStep& last) noexcept {
  if (detail::crawls(set, last) && detail::sticks(set)) return true;
  for (int round = 0; round <= kRounds; ++round) {
    // from the second on a start for Newton's method, however it ends: cones with too small shifts may contradict each
    // other where the rows do not
    if (round > 0) detail::meet_cones(detail::Shift::kSlip, set);
    if (detail::solve_coulomb(set)) return true;
    follow_shifts(round == 0, set);
  }
  return false;
}

/// False: infeasible.
bool solve_with_friction(ContactSet& set, ConstrainedStep& step) noexcept {
  const bool converged = solve_friction(set, step);
  if (converged) detail::come_to_rest(set);
  detail::take_forces(set, step);
  step.follows = converged && step.force_count == 0;
  step.unconverged = !converged;
  if (converged) {
    step.motion = detail::rests(set) ? Motion{} : set.motion();
    set.close_all();
    return true;
  }
  set.restart_from_motion();  // the normals have the last word
  const bool feasible = detail::meet_rows(set) != Additions::kContradictory;
  detail::add_forces(set, step);
  step.motion = set.motion();
  return feasible;
}

/// False: infeasible.
bool solve(ContactRows& rows, const Motion& wanted, const CouplingMetric& metric, const ContactFriction* friction,
           const Motion& last, ConstrainedStep& step) noexcept {
  ContactSet set(rows, wanted, metric, friction, last);
  warm_start(step, set);
  const bool feasible = friction == nullptr ? solve_frictionless(set, step) : solve_with_friction(set, step);
  step.iterations = set.additions();
  return feasible;
}

}  // namespace

void least_constraint(ContactRows& rows, const Motion& wanted, const CouplingMetric& metric,
                      const ContactFriction* friction, const Motion& last, ConstrainedStep& step) noexcept {
  step.infeasible = false;
  step.unconverged = false;
  if (rows.count == 0) {
    step = ConstrainedStep{};
    step.motion = wanted;
    step.follows = true;
    return;
  }
  if (solve(rows, wanted, metric, friction, last, step)) return;
  // what nobody can meet together need not be gained; the motion zero is then one that meets all rows
  for (std::uint32_t i = 0; i < rows.count; ++i) rows.need[i] = std::min(rows.need[i], 0.0f);
  step.force_count = 0;
  solve(rows, wanted, metric, friction, last, step);
  step.infeasible = true;
}

}  // namespace godobject
