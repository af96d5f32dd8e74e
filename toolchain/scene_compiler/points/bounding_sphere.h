#pragma once

#include <span>

#include <Eigen/Core>

namespace godobject::scene_compiler {

/// Radius that an image stores for the sphere about a single point, because the format requires a positive one [m].
inline constexpr double kLeastPointRadius = 1e-9;

struct Sphere {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

/// Returns the smallest sphere around `points` (at least one), minimal to about 1e-10 of its radius. No point is
/// farther from the centre than `radius`. Coincident, collinear, coplanar and cospherical points are allowed. Cost:
/// some ten passes.
Sphere bounding_sphere(std::span<const Eigen::Vector3d> points);

}  // namespace godobject::scene_compiler
