#pragma once

#include "core/pipeline/contact/qp/contact_set.h"
#include "core/pipeline/contact/qp/least_constraint.h"

namespace godobject::detail {

/// The forces of the set's half spaces come to those of the step. More than six are replaced by six or fewer of the
/// same sum: a vector in the cone of generators in six dimensions is a combination of six that are independent
/// (Caratheodory).
void add_forces(const ContactSet& set, ConstrainedStep& step) noexcept;

}  // namespace godobject::detail
