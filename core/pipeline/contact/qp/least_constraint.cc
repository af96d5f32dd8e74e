#include "core/pipeline/contact/qp/least_constraint.h"

#include <algorithm>

#include "core/pipeline/contact/qp/contact_forces.h"
#include "core/pipeline/contact/qp/contact_set.h"
#include "core/pipeline/contact/qp/friction_solver.h"
#include "core/pipeline/contact/qp/meet_rows.h"
#include "core/pipeline/cycle/scene_traits.h"

namespace godobject {
namespace {

using detail::Additions;
using detail::ContactSet;

static_assert(detail::kMostRowAdditions == kMostAdditions);

/// Returns the row of the force's point. A second look may give the point several rows; then the one whose normal is
/// closest.
std::uint32_t row_of(const ContactForce& force, const ContactRows& rows) noexcept {
  std::uint32_t best = ContactRows::kNone;
  double best_fit = 0.0;
  for (std::uint32_t row = rows.find(force.id, 0); row < rows.count; row = rows.find(force.id, row + 1)) {
    const double fit = rows.normal(row).dot(force.normal);
    if (best != ContactRows::kNone && !(fit > best_fit)) continue;
    best = row;
    best_fit = fit;
  }
  return best;
}

/// Guesses the forces of the last step, where their points still have rows.
void warm_start(const ConstrainedStep& step, ContactSet& set) noexcept {
  for (std::uint32_t i = 0; i < step.force_count; ++i) {
    const ContactForce& force = step.forces[i];
    const std::uint32_t row = row_of(force, set.rows());
    if (row == ContactRows::kNone) continue;
    if constexpr (kSceneTraits.friction) {
      if (set.friction() != nullptr) {
        detail::guess_cone(row, force, set);
        continue;
      }
    }
    set.active().guess(set.row_half_space(row));
  }
  set.active().resolve();
  if constexpr (kSceneTraits.friction) {
    if (set.friction() != nullptr) set.close_idle();
  }
}

/// Solves the problem without friction. False: infeasible.
bool solve_frictionless(ContactSet& set, ConstrainedStep& step) noexcept {
  const bool feasible = detail::meet_rows(set) != Additions::kContradictory;
  detail::take_forces(set, step);
  step.motion = set.motion();
  step.follows = step.force_count == 0;
  return feasible;
}

/// Solves the problem with or without friction. False: infeasible.
bool solve(ContactRows& rows, const Motion& wanted, const CouplingMetric& metric, const ContactFriction* friction,
           const Motion& last, WorkMeter& work, ConstrainedStep& step) noexcept {
  work.add(Work::kSolve);
  work.add(Work::kScan, step.force_count * rows.count / 4);
  ContactSet set(rows, wanted, metric, friction, last, work);
  warm_start(step, set);
  const auto solved = [&]() noexcept {
    if constexpr (kSceneTraits.friction) {
      if (friction != nullptr) return detail::solve_with_friction(set, step);
    }
    return solve_frictionless(set, step);
  };
  const bool feasible = solved();
  step.iterations = set.additions();
  return feasible;
}

bool is_zero(const Motion& motion) noexcept { return motion.translation.isZero(0.0) && motion.rotation.isZero(0.0); }

Motion sum(const Motion& a, const Motion& b, double sign) noexcept {
  return {a.translation + sign * b.translation, a.rotation + sign * b.rotation};
}

/// Adds the gap increases of a motion, times `sign`, to the required gains.
void shift_gains(const Motion& motion, double sign, ContactRows& rows) noexcept {
  for (std::uint32_t i = 0; i < rows.count; ++i) {
    const double gain = rows.normal(i).dot(motion.translation + motion.rotation.cross(rows.point(i)));
    rows.required_gain[i] += static_cast<float>(sign * gain);
  }
}

/// Solves the problem with friction against the slip of the whole cycle. False: it was not solved, or leads farther
/// from the wanted motion than rest is, by more than lost gaps require; then the step is as before.
bool solve_for_whole_slip(ContactRows& rows, const Motion& wanted, const CouplingMetric& metric,
                          const ContactFriction& friction, const Motion& last, WorkMeter& work,
                          ConstrainedStep& step) noexcept {
  const ConstrainedStep before = step;
  work.add(Work::kScan, 4 * rows.count);
  shift_gains(friction.slid, 1.0, rows);
  const bool feasible = solve(rows, sum(wanted, friction.slid, 1.0), metric, &friction, last, work, step);
  shift_gains(friction.slid, -1.0, rows);
  step.motion = sum(step.motion, friction.slid, -1.0);
  const double farther = metric.squared(sum(wanted, step.motion, -1.0)) - metric.squared(wanted);
  const Motion followed = sum(wanted, {friction.beyond, Vector3::Zero()}, -1.0);
  if (feasible && !step.unconverged && farther <= detail::kMostByGaps * metric.squared(followed)) return true;
  step = before;
  step.infeasible = step.unconverged = false;
  return false;
}

}  // namespace

void least_constraint(ContactRows& rows, const Motion& wanted, const CouplingMetric& metric,
                      const ContactFriction* friction, const Motion& last, WorkMeter& work,
                      ConstrainedStep& step) noexcept {
  step.infeasible = false;
  step.unconverged = false;
  if (rows.count == 0) {
    step = ConstrainedStep{};
    step.motion = wanted;
    step.follows = true;
    return;
  }
  if constexpr (kSceneTraits.friction) {
    if (friction != nullptr && !is_zero(friction->slid) &&
        solve_for_whole_slip(rows, wanted, metric, *friction, last, work, step)) {
      return;
    }
  }
  if (solve(rows, wanted, metric, friction, last, work, step)) return;
  // infeasible rows drop their required gap increase; then the zero motion meets all rows
  for (std::uint32_t i = 0; i < rows.count; ++i) rows.required_gain[i] = std::min(rows.required_gain[i], 0.0f);
  step.force_count = 0;
  solve(rows, wanted, metric, friction, last, work, step);
  step.infeasible = true;
}

}  // namespace godobject
