#pragma once

#include <Eigen/Core>

namespace godobject::scene_compiler {

/// Returns the point of the triangle a, b, c nearest to p.
Eigen::Vector3d nearest_point_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                          const Eigen::Vector3d& c) noexcept;

/// Returns the area of a triangle [m^2].
double triangle_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) noexcept;

/// Tells whether the triangle a, b, c is higher than `height` above its longest side [m].
bool is_higher(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, double height) noexcept;

/// The solid angle of many triangles seen from a point p [sr], positive for a triangle whose back p sees (p inside of a
/// closed surface: 4 pi in all). Half of a triangle's angle is the argument of a complex number (van Oosterom and
/// Strackee 1983). Arguments add up in a product, so that all triangles need one arc tangent.
class SolidAngle {
 public:
  explicit SolidAngle(const Eigen::Vector3d& p) noexcept : p_(p) {}

  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) noexcept;
  double sum() const noexcept;

 private:
  Eigen::Vector3d p_;
  double real_ = 1.0;
  double imaginary_ = 0.0;
  int turns_ = 0;  ///< the sum of the arguments is that of the product and so many full turns
};

}  // namespace godobject::scene_compiler
