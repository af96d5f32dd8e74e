#pragma once

#include <cstdint>

#include "core/pipeline/contact/qp/contact_set.h"
#include "core/pipeline/contact/qp/meet_rows.h"

namespace godobject::detail {

/// What the cone of a contact that becomes one is shifted by.
enum class Shift : std::uint8_t { kNone, kSlip };

/// With friction, the shifts of the contacts held: adds half spaces until all rows and all cones
///     n . v - need + mu (shift - |slip|) >= 0
/// are met. A row that is violated becomes a contact, a cone gets the half space of the slip that violates it.
inline constexpr int kMostConeAdditions = 24;
Additions meet_cones(Shift entering, ContactSet& set) noexcept;

/// Whether what carried the load in the last step slipped by next to nothing of what friction held back, so that it may
/// come to rest now.
bool crawls(const ContactSet& set, const ConstrainedStep& step) noexcept;

/// Whether forces inside the cones can hold all that carries load at rest; if so they are the set. Without shifts the
/// convex problem says so for certain, redundant contacts or not; Coulomb's law may have solutions that slip beside it,
/// and rest is the one to take. At most kMostConeAdditions.
bool sticks(ContactSet& set) noexcept;

/// All contacts stick, and the tolerances explain what is left of the motion: then it is none, or rest would creep.
bool rests(const ContactSet& set) noexcept;

/// A motion that the tolerances may explain ends, if forces inside the cones can hold it. At most kMostConeAdditions.
void come_to_rest(ContactSet& set) noexcept;

}  // namespace godobject::detail
