#pragma once

#include "core/pipeline/contact/qp/contact_set.h"

namespace godobject::detail {

/// Solves Coulomb's law by Newton's method. True: the set's half spaces, with the shifts of its motion, satisfy the law
/// and all rows. False: the set is unchanged, and other shifts are needed.
///
/// Each contact slips (one half space, the force opposes the slip, the required gain is met exactly) or sticks (half
/// spaces as equalities):
///     z = z_d + sum f_j lambda_j,   g_j z = rhs_j,   f_j = n - mu d_j,   g_j = n (slipping) or f_j (sticking)
/// d_j = slip / |slip| turns with z: to first order this is a force -(mu lambda / |slip|) (slip across d_j). It becomes
/// part of the metric and vanishes at the solution; viscous friction is part of the metric, too, and remains. A contact
/// whose force would pull leaves; the row violated most enters.
///
/// Cost: at most kMostNewtonSteps steps, each an addition or a system of at most twelve equations. Real-time safe.
inline constexpr int kMostNewtonSteps = 24;
bool solve_coulomb(ContactSet& set) noexcept;

}  // namespace godobject::detail
