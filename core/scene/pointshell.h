#pragma once

#include <cstddef>
#include <span>

#include "core/scene/format.h"
#include "core/spatial/bounding_sphere.h"
#include "godobject/pose.h"

namespace godobject {

/// The moving body's sample points with their sphere tree, in the body frame B. A view; owns nothing.
struct Pointshell {
  std::size_t size = 0;
  const float* x = nullptr;  ///< [m]; size values each
  const float* y = nullptr;
  const float* z = nullptr;
  const float* normal_x = nullptr;  ///< unit, into the body; null if the image has no normals
  const float* normal_y = nullptr;
  const float* normal_z = nullptr;
  std::span<const format::Node> nodes;  ///< pre-order; nodes[0] contains all points

  Vector3 point(std::size_t i) const noexcept {
    return {static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
  }
  Vector3 normal(std::size_t i) const noexcept {
    return {static_cast<double>(normal_x[i]), static_cast<double>(normal_y[i]), static_cast<double>(normal_z[i])};
  }
};

/// Returns the centre of the sphere around all points of a node's subtree, in B [m].
inline Vector3 center_of(const format::Node& node) noexcept {
  return {static_cast<double>(node.center[0]), static_cast<double>(node.center[1]),
          static_cast<double>(node.center[2])};
}
/// Returns the radius of that sphere [m], enlarged by the rounding of the image to single precision.
inline double radius_of(const format::Node& node) noexcept {
  constexpr double kRounding = 2e-6;
  return static_cast<double>(node.radius) * (1.0 + kRounding) + kRounding * center_of(node).cwiseAbs().sum();
}
inline BoundingSphere sphere_of(const format::Body& body) noexcept {
  return {Vector3(body.sphere_center[0], body.sphere_center[1], body.sphere_center[2]), body.sphere_radius};
}
inline BoundingSphere sphere_of(const format::Node& node) noexcept { return {center_of(node), radius_of(node)}; }

}  // namespace godobject
