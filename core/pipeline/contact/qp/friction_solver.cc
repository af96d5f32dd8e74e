#include "core/pipeline/contact/qp/friction_solver.h"

#include "core/pipeline/contact/qp/combined_forces.h"
#include "core/pipeline/contact/qp/contact_forces.h"
#include "core/pipeline/contact/qp/coulomb_newton.h"
#include "core/pipeline/contact/qp/meet_rows.h"
#include "core/pipeline/contact/qp/shifted_cones.h"

namespace godobject::detail {
namespace {

constexpr int kRounds = 5;

// rest, Newton's method once and in each round, the rounds' cones; then the last word (more than coming to rest takes),
// rest again, the rows alone
static_assert(2 * kMostConeAdditions + (1 + kRounds) * kMostNewtonSteps + kRounds * kMostConeAdditions +
                  2 * kMostRowAdditions ==
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

/// The set's motion is Coulomb's.
void conclude(ContactSet& set, ConstrainedStep& step) noexcept {
  take_forces(set, step);
  step.follows = step.force_count == 0;
  step.unconverged = false;
  step.motion = rests(set) ? Motion{} : set.motion();
  set.close_all();
}

/// It is not: the normals have the last word. False: infeasible.
bool conclude_with_rows(ContactSet& set, ConstrainedStep& step) noexcept {
  take_forces(set, step);
  step.follows = false;
  step.unconverged = true;
  set.restart_from_motion();
  const bool feasible = meet_rows(set) != Additions::kContradictory;
  add_forces(set, step);
  step.motion = set.motion();
  return feasible;
}

/// The motion without friction, after conclude_with_rows. False: infeasible.
bool conclude_without_friction(ContactSet& set, ConstrainedStep& step) noexcept {
  set.restart();
  const bool feasible = meet_rows(set) != Additions::kContradictory;
  take_forces(set, step);
  step.motion = set.motion();
  return feasible;
}

/// The motion found ends farther from the wanted one than rest does, by more than what lost gaps need. In the plain
/// metric.
bool leads_away(const ContactSet& set) noexcept {
  constexpr double kNeeds = 1.001;  // of squares
  const Vector6 wanted = set.target();
  return (set.plain_motion() - wanted).squaredNorm() > kNeeds * wanted.squaredNorm();
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
  if (solve_friction(set, step)) {
    come_to_rest(set);
    conclude(set, step);
    return true;
  }
  const ContactSet::Saved found = set.save();
  const bool feasible = conclude_with_rows(set, step);
  if (!feasible || !leads_away(set)) return feasible;
  // Shifts that are not the slip's own allow forces of any size. Without them the cones may hold at rest; if not,
  // without friction no motion that meets all rows is nearer.
  set.restore(found);
  if (!sticks(set)) return conclude_without_friction(set, step);
  conclude(set, step);
  return true;
}

}  // namespace godobject::detail
