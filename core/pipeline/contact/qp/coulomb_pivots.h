#pragma once

#include "core/pipeline/contact/qp/contact_set.h"

/// The changes of state between steps of Newton's method on Coulomb's law: a contact opens, slips or sticks.
namespace godobject::detail {

/// Lets the contacts that slip in the motion `m`, but are marked as sticking, slip: each gets one half space and the
/// kinetic ratio. Its direction is that of the friction force so far, which near rest is much more precise than the
/// slip.
void begin_to_slip(const Motion& m, ContactSet& set) noexcept;

/// Moves the forces of the set towards the new `multiplier`s, one a half space, until the first one vanishes, and
/// releases that half space. False, without a change: none vanishes. The forces of a held contact count as one, their
/// sum.
bool drop_first_to_vanish(const double* multiplier, ContactSet& set) noexcept;

/// Makes a contact stick by three half spaces if its slip had the direction of its force in consecutive steps. Makes a
/// held contact slip if its force lies outside of the cone, or opens it if the force would pull. True: a contact has
/// changed.
bool hold_or_release(ContactSet& set) noexcept;

}  // namespace godobject::detail
