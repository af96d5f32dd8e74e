#include "core/pipeline/friction_solver.h"

#include "core/pipeline/combined_forces.h"
#include "core/pipeline/contact_forces.h"
#include "core/pipeline/coulomb_newton.h"
#include "core/pipeline/meet_rows.h"
#include "core/pipeline/shifted_cones.h"

namespace godobject::detail {
namespace {

constexpr int kRounds = 5;

// rest, Newton's method once and in each round, the rounds' cones, the last word (more than coming to rest takes)
static_assert(kMostConeAdditions + (1 + kRounds) * kMostNewtonSteps + kRounds * kMostConeAdditions +
                  kMostRowAdditions ==
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

/// Shifts for the convex problem to go on with where Newton's method failed: none at first, then towards the slip.
void follow_shifts(bool first, ContactSet& set) noexcept {
  const Motion m = set.motion();
  for (int k = 0; k < set.contact_count(); ++k) {
    Contact& c = set.contact(k);
    c.shift = first ? 0.0 : 0.5 * (c.shift + set.slip_of(c, m).speed);
  }
  set.resolve();
}

/// Coulomb's law to the tolerance; false after the last round. The steps 1 to 3 of `least_constraint`.
bool solve_friction(ContactSet& set, const ConstrainedStep& last) noexcept {
  if (crawls(set, last) && sticks(set)) return true;
  for (int round = 0; round <= kRounds; ++round) {
    // from the second on a start for Newton's method, however it ends: cones with too small shifts may contradict each
    // other where the rows do not
    if (round > 0) meet_cones(Shift::kSlip, set);
    if (solve_coulomb(set)) return true;
    follow_shifts(round == 0, set);
  }
  return false;
}

}  // namespace

void guess_cone(std::uint32_t row, const ContactForce& force, ContactSet& set) noexcept {
  const int k = contact_of_row(row, set);
  const Vector3& normal = set.contact(k).normal;
  const Vector3 slip = force.slip - normal.dot(force.slip) * normal;
  const double length = slip.norm();
  set.active().guess(set.cone_half_space(k, length > 0.5 ? Vector3(slip / length) : Vector3::Zero()));
}

bool solve_with_friction(ContactSet& set, ConstrainedStep& step) noexcept {
  const bool converged = solve_friction(set, step);
  if (converged) come_to_rest(set);
  take_forces(set, step);
  step.follows = converged && step.force_count == 0;
  step.unconverged = !converged;
  if (converged) {
    step.motion = rests(set) ? Motion{} : set.motion();
    set.close_all();
    return true;
  }
  set.restart_from_motion();  // the normals have the last word
  const bool feasible = meet_rows(set) != Additions::kContradictory;
  add_forces(set, step);
  step.motion = set.motion();
  return feasible;
}

}  // namespace godobject::detail
