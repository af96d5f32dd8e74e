#pragma once

#include <algorithm>

#include "core/scene/format.h"
#include "godobject/pose.h"

namespace godobject {

/// A value at a point and its gradient there.
struct ValueAndGradient {
  double value = 0.0;
  Vector3 gradient = Vector3::Zero();
};

/// g of format::Edge [m] at p, in the grid's frame. Real-time safe.
ValueAndGradient wedge_distance(const format::Edge& edge, const Vector3& p) noexcept;

/// w of format::Edge [1, 1/m]. Real-time safe.
ValueAndGradient edge_weight(const format::Edge& edge, const Vector3& p) noexcept;

/// R of format::Edge at t [m].
inline double edge_radius(const format::Edge& edge, double t) noexcept {
  return std::min(edge.radius, edge.end_radius + edge.slope * std::min(t - edge.begin, edge.end - t));
}

}  // namespace godobject
