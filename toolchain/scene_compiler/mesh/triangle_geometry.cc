#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace godobject::scene_compiler {

using Eigen::Vector3d;

Vector3d nearest_point_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                                   const Vector3d& c) noexcept {
  // The signs of barycentric terms give the Voronoi region of p (Ericson, Real-Time Collision Detection, 5.1.5).
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const Vector3d ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + (d1 / (d1 - d3)) * ab;
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  const double scale = 1.0 / (va + vb + vc);
  return a + (vb * scale) * ab + (vc * scale) * ac;
}

double triangle_area(const Vector3d& a, const Vector3d& b, const Vector3d& c) noexcept {
  return 0.5 * (b - a).cross(c - a).norm();
}

bool is_higher(const Vector3d& a, const Vector3d& b, const Vector3d& c, double height) noexcept {
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  return (b - a).cross(c - a).norm() > height * longest;
}

void SolidAngle::add(const Vector3d& a, const Vector3d& b, const Vector3d& c) noexcept {
  const Vector3d u = a - p_;
  const Vector3d v = b - p_;
  const Vector3d w = c - p_;
  const double lu = u.norm();
  const double lv = v.norm();
  const double lw = w.norm();
  const double imaginary = u.dot(v.cross(w));
  const double real = lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv;
  const double modulus = std::sqrt(real * real + imaginary * imaginary);
  if (!(modulus > 0.0)) return;  // p is a corner
  const double next_real = (real_ * real - imaginary_ * imaginary) / modulus;
  const double next_imaginary = (real_ * imaginary + imaginary_ * real) / modulus;
  // Arguments are in (-pi, pi]. Two of one sign that leave this range come out with the other sign.
  const bool both_negative = imaginary_ < 0.0 && imaginary < 0.0;
  const bool both_positive = imaginary_ >= 0.0 && imaginary >= 0.0;
  const bool is_full_turn = next_imaginary == 0.0 && next_real > 0.0 && real_ < 0.0;  // pi and pi
  if (both_positive && (next_imaginary < 0.0 || is_full_turn)) ++turns_;
  if (both_negative && (next_imaginary > 0.0 || (next_imaginary == 0.0 && next_real < 0.0))) --turns_;
  real_ = next_real;
  imaginary_ = next_imaginary + 0.0;  // no -0, whose argument beside a negative number is -pi
}

double SolidAngle::sum() const noexcept {
  return 2.0 * (std::atan2(imaginary_, real_) + 2.0 * std::numbers::pi * turns_);
}

}  // namespace godobject::scene_compiler
