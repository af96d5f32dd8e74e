#pragma once

#include <Eigen/Core>

namespace godobject::scene_compiler {

/// Returns the point of the triangle a, b, c nearest to p.
Eigen::Vector3d nearest_point_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                          const Eigen::Vector3d& c) noexcept;

/// Returns the solid angle of the triangle seen from p, positive if p sees its back (p inside) [sr].
double solid_angle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                   const Eigen::Vector3d& c) noexcept;

}  // namespace godobject::scene_compiler
