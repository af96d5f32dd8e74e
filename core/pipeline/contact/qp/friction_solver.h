#pragma once

#include <cstdint>

#include "core/pipeline/contact/qp/contact_set.h"
#include "core/pipeline/contact/qp/least_constraint.h"

namespace godobject::detail {

/// A motion that is farther from the wanted one than rest leads away if the squared distances differ by more than this
/// share of that of rest: lost gaps do not explain it [1]. Chosen.
inline constexpr double kMostByGaps = 0.001;

/// Puts the half space of the row's cone that belongs to `force` into the active set, as a guess.
void guess_cone(std::uint32_t row, const ContactForce& force, ContactSet& set) noexcept;

/// Solves `least_constraint` with friction from a warm-started set: sets the motion and forces of `step`. False: the
/// rows are infeasible. Real-time safe.
bool solve_with_friction(ContactSet& set, ConstrainedStep& step) noexcept;

}  // namespace godobject::detail
