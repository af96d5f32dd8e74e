#pragma once

#include <span>

#include <Eigen/Core>

namespace godobject::scene_compiler {

/// Radius of the sphere that an image stores about a single point: the format wants a positive one [m].
inline constexpr double kLeastPointRadius = 1e-9;

struct Sphere {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

/// Smallest sphere around `points` (at least one): minimal to about 1e-10 of its radius, and no point is further from
/// the center than `radius`. Coincident, collinear, coplanar and cospherical points are fine. Cost: some ten passes.
Sphere bounding_sphere(std::span<const Eigen::Vector3d> points);

}  // namespace godobject::scene_compiler
