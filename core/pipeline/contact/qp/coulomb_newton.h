#pragma once

#include "core/pipeline/contact/qp/contact_set.h"

namespace godobject::detail {

/// Newton's method on Coulomb's law itself, for contacts that each slip (one half space, the force opposes the slip,
/// the gap is met exactly) or stick (half spaces as equalities):
///     z = z_d + sum f_j lambda_j,   g_j z = rhs_j,   f_j = n - mu d_j,   g_j = n (slipping) or f_j (sticking)
/// d_j = slip / |slip| turns with z: to first order a force -(mu lambda / |slip|) (slip across d_j), which goes into
/// the metric and vanishes at the solution; so goes viscous friction, which stays. A contact whose force would pull
/// leaves, the row violated most enters.
///
/// True if it ended where all is met: the half spaces, with the shifts that belong to the motion, are then the set.
/// False: the set is as it was, in need of other shifts. At most kMostNewtonSteps additions, and as many systems of at
/// most twelve equations.
inline constexpr int kMostNewtonSteps = 24;
bool solve_coulomb(ContactSet& set) noexcept;

}  // namespace godobject::detail
