#pragma once

#include <cstdint>

#include "core/pipeline/contact/qp/contact_set.h"
#include "core/pipeline/contact/qp/least_constraint.h"

namespace godobject::detail {

/// Puts the half space of the row's cone that the force stands for into the active set, as a guess.
void guess_cone(std::uint32_t row, const ContactForce& force, ContactSet& set) noexcept;

/// `least_constraint` with friction, from a set that is warm: motion and forces of the step. False: infeasible.
bool solve_with_friction(ContactSet& set, ConstrainedStep& step) noexcept;

}  // namespace godobject::detail
