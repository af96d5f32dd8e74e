#pragma once

#include <cstdint>

#include "core/pipeline/contact/qp/dual_active_set.h"

namespace godobject::detail {

/// Returns the change of the contact forces by damping along the active normals, in the coupling's metric [m].
///
/// With the rows C and the sum of the forces C lambda (`load`), the damped forces are the projection of C lambda -
/// `damping` on the cone of the rows. `damping` is the device's velocity times b_D / k_D. The change is never larger
/// than `damping`, adds no power, is continuous, and no contact pulls. If the load is not of these rows (infeasible
/// rows), no such projection exists and the change is zero. `rows`: `count` rows, at most six. Real-time safe.
Vector6 damping_change(const Vector6* rows, std::uint32_t count, const Vector6& load, const Vector6& damping) noexcept;

}  // namespace godobject::detail
