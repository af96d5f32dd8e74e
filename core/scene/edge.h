#pragma once

#include <algorithm>

#include "core/scene/format.h"
#include "godobject/pose.h"

namespace godobject {

/// The value and the gradient of a function at a point.
struct ValueAndGradient {
  double value = 0.0;
  Vector3 gradient = Vector3::Zero();
};

/// Returns the distance g of format::Edge [m] and its gradient [1] at p, in the grid's frame. Real-time safe.
ValueAndGradient wedge_distance(const format::Edge& edge, const Vector3& p) noexcept;

/// Returns the weight w of format::Edge [1] and its gradient [1/m] at p, in the grid's frame. Real-time safe.
ValueAndGradient edge_weight(const format::Edge& edge, const Vector3& p) noexcept;

/// Returns the radius R of format::Edge [m] at the place t along the edge [m].
inline double edge_radius(const format::Edge& edge, double t) noexcept {
  return std::min(edge.radius, edge.end_radius + edge.slope * std::min(t - edge.begin, edge.end - t));
}

}  // namespace godobject
