#pragma once

#include "core/pipeline/contact/qp/contact_set.h"
#include "core/pipeline/contact/qp/least_constraint.h"

namespace godobject::detail {

/// Adds the forces of the set's half spaces to those of the step. More than six forces are replaced by at most six of
/// the same sum: a vector in the cone of generators in six dimensions is a combination of six independent ones
/// (Caratheodory). Real-time safe.
void add_forces(const ContactSet& set, ConstrainedStep& step) noexcept;

}  // namespace godobject::detail
