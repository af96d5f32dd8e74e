#pragma once

#include "core/pipeline/contact/qp/contact_set.h"

/// Changes of state between the steps of Newton's method on Coulomb's law: a contact opens, slips or sticks.
namespace godobject::detail {

/// Contacts that slip in motion `m` and were not known to begin to: one half space and the kinetic ratio for each. Its
/// direction is against the force that the half spaces gave, which near rest is known far better than the slip.
void begin_to_slip(const Motion& m, ContactSet& set) noexcept;

/// On the way from the forces of the set to the new `multiplier`s, one a half space, stops where the first of them
/// vanishes and lets it go. False, without a change, if none does. A contact that is held has one force, the sum of its
/// half spaces'.
bool drop_first_to_vanish(const double* multiplier, ContactSet& set) noexcept;

/// A contact whose slip went with its force instead of against it twice in a row sticks: three half spaces hold it. One
/// that is held by a force outside of the cone begins to slip; by a pull, it opens. True if any has happened.
bool hold_or_release(ContactSet& set) noexcept;

}  // namespace godobject::detail
