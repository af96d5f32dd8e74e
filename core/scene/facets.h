#pragma once

#include <cstdint>
#include <span>

#include "core/scene/format.h"
#include "godobject/pose.h"

namespace godobject {

/// The value and the gradient of a function at a point.
struct ValueAndGradient {
  double value = 0.0;
  Vector3 gradient = Vector3::Zero();
};

/// Returns the unit normal of a facet's face.
inline Vector3 face_normal(const format::Facet& facet) noexcept {
  return {facet.plane[0][0], facet.plane[1][0], facet.plane[2][0]};
}

/// Sets the planes of a facet with these vertices, whose face has the unit normal `normal`.
void set_planes(format::Facet& facet, const Vector3& normal) noexcept;

/// Returns the signed distance g of format::Facet [m] and its gradient [1] at p, in the facets' frame. `numbers` are
/// those of at least one facet. On the surface the gradient is the normal of a face there.
/// Real-time safe; some 10 ns for each facet.
ValueAndGradient facet_distance(std::span<const format::Facet> facets, std::span<const std::uint32_t> numbers,
                                const Vector3& p) noexcept;

/// The same of the facets of one cell of an exact brick; p is in that cell.
ValueAndGradient facet_distance(std::span<const format::Facet> facets, const format::ExactBrick& exact, int cell,
                                const Vector3& p) noexcept;

}  // namespace godobject
