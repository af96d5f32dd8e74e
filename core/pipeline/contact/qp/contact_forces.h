#pragma once

#include "core/pipeline/contact/qp/contact_set.h"
#include "core/pipeline/contact/qp/least_constraint.h"

namespace godobject::detail {

/// Returns the force of a half space of the active set.
ContactForce force_of(const ContactSet& set, int half_space) noexcept;

/// Sets the step's number of contacts: the different rows among its forces. Two rows of one point with different
/// normals are two contacts.
void count_contacts(ConstrainedStep& step) noexcept;

/// Removes the forces of a point from the step.
void drop_forces(std::uint32_t id, ConstrainedStep& step) noexcept;

/// Makes the forces of the set's half spaces those of the step, and counts the contacts.
void take_forces(const ContactSet& set, ConstrainedStep& step) noexcept;

}  // namespace godobject::detail
