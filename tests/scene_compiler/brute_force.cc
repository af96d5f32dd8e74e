#include "tests/scene_compiler/brute_force.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

double to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  const double t = std::clamp(ab.dot(p - a) / ab.squaredNorm(), 0.0, 1.0);
  return (a + t * ab - p).norm();
}

/// In the plane's coordinates: the height above the face, or else the distance to the nearest of the three edges.
double to_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d n = (b - a).cross(c - a).normalized();
  const auto left_of = [&](const Vector3d& u, const Vector3d& v) { return n.dot((v - u).cross(p - u)) >= 0.0; };
  if (left_of(a, b) && left_of(b, c) && left_of(c, a)) return std::abs(n.dot(p - a));
  return std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
}

}  // namespace

double BruteForce::distance(const Vector3d& p) const {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh_.triangles) {
    best = std::min(best, to_triangle(p, mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]));
  }
  return best;
}

double BruteForce::winding_number(const Vector3d& p) const {
  double sum = 0.0;
  for (const auto& t : mesh_.triangles) {
    const Vector3d a = (mesh_.vertices[t[0]] - p).normalized();
    const Vector3d b = (mesh_.vertices[t[1]] - p).normalized();
    const Vector3d c = (mesh_.vertices[t[2]] - p).normalized();
    sum += 2.0 * std::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  return sum / (4.0 * std::numbers::pi);
}

}  // namespace godobject::scene_compiler
