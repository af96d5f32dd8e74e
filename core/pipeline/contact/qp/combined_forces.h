#pragma once

#include "core/pipeline/contact/qp/contact_set.h"
#include "core/pipeline/contact/qp/least_constraint.h"

namespace godobject::detail {

/// The forces of up to two active sets, or of the cones of all contacts.
struct Forces {
  std::array<ContactForce, 3 * ContactSet::kMaxContacts> force;
  std::size_t count = 0;

  void add(const ContactForce& one) noexcept { force[count++] = one; }
};
static_assert(3 * ContactSet::kMaxContacts >= 2 * ActiveSet::kCapacity);

/// Replaces the forces of the step by at most six of `all` with the same sum. Returns the length of what the sum of six
/// lacks, in the coupling's metric [m]: rounding, but more if generators hardly differ. Real-time safe.
double store_sum(const Forces& all, double gyration, ConstrainedStep& step) noexcept;

/// Adds the forces of the set's half spaces to those of the step. More than six forces are replaced by at most six of
/// the same sum: a vector in the cone of generators in six dimensions is a combination of six independent ones
/// (Caratheodory). Real-time safe.
void add_forces(const ContactSet& set, ConstrainedStep& step) noexcept;

}  // namespace godobject::detail
