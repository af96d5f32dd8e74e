#pragma once

#include <cstdint>

#include "core/pipeline/contact/qp/dual_active_set.h"

namespace godobject::detail {

/// Damping along the active normals, as a change of the contact forces: with the rows C and the forces' sum C lambda
/// (`load`), the vector C lambda - `asked` is projected on the cone of what the rows can push, where `asked` is the device's
/// velocity times b_D / k_D, all in the coupling's metric. The change is never larger than `asked`, is continuous, and no
/// contact pulls. Where the loads are not the contacts' own (infeasible rows) that does not hold: then the change is zero.
/// `rows`: `count` unit rows, at most six. Real-time safe.
Vector6 damping_change(const Vector6* rows, std::uint32_t count, const Vector6& load, const Vector6& asked) noexcept;

}  // namespace godobject::detail
