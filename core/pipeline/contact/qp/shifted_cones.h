#pragma once

#include <cstdint>

#include "core/pipeline/contact/qp/contact_set.h"
#include "core/pipeline/contact/qp/meet_rows.h"

namespace godobject::detail {

/// The shift of a contact that enters: none, or its slip in the current motion.
enum class Shift : std::uint8_t { kNone, kSlip };

/// Adds half spaces, with friction and fixed shifts, until all rows and all cones
///     n . v - required gain + mu (shift - |slip|) >= 0
/// are met. A violated row becomes a contact; a violated cone gets the half space of the current slip. A cone counts as
/// met within `tolerance` times that of the rows [1]; the half spaces of a small one have nearly the slip's direction.
/// Cost: at most kMostConeAdditions additions. Real-time safe.
inline constexpr int kMostConeAdditions = 24;
inline constexpr double kConeTolerance = 0.01;  // cones are in double precision, and rest is exact
Additions meet_cones(Shift entering, ContactSet& set, double tolerance = kConeTolerance) noexcept;

/// Tells whether the loaded points of the last step hardly slipped, compared with the motion that friction prevented,
/// so that they may come to rest now.
bool crawls(const ContactSet& set, const ConstrainedStep& step) noexcept;

/// Tells whether forces inside the cones can hold all loaded points at rest; then they are the set. Without shifts the
/// convex problem decides this exactly, also with redundant contacts. Coulomb's law may have other solutions that slip;
/// rest is chosen. At most kMostConeAdditions.
bool sticks(ContactSet& set) noexcept;

/// Tells whether all contacts stick and the motion is within the tolerance. The caller must then return the zero
/// motion; otherwise the body would creep.
bool rests(const ContactSet& set) noexcept;

/// Brings a motion within the tolerance to rest, if forces inside the cones can hold the body. At most
/// kMostConeAdditions.
void come_to_rest(ContactSet& set) noexcept;

}  // namespace godobject::detail
