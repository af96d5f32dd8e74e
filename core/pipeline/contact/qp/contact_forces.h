#pragma once

#include "core/pipeline/contact/qp/contact_set.h"
#include "core/pipeline/contact/qp/least_constraint.h"

namespace godobject::detail {

/// The force of the half space.
ContactForce force_of(const ContactSet& set, int half_space) noexcept;

/// Two rows of one point, seen from two sides, are two.
void count_contacts(ConstrainedStep& step) noexcept;

/// The forces of the set's half spaces are those of the step, and their points its contacts.
void take_forces(const ContactSet& set, ConstrainedStep& step) noexcept;

}  // namespace godobject::detail
