#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// The slow and plain oracle of a mesh: it tests every triangle. It shares no code with the compiler.
class BruteForce {
 public:
  explicit BruteForce(const TriangleMesh& mesh) : mesh_(mesh) {}

  double distance(const Eigen::Vector3d& p) const {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& t : mesh_.triangles) {
      best = std::min(best, to_triangle(p, mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]));
    }
    return best;
  }

  double winding_number(const Eigen::Vector3d& p) const {
    double sum = 0.0;
    for (const auto& t : mesh_.triangles) {
      const Eigen::Vector3d a = (mesh_.vertices[t[0]] - p).normalized();
      const Eigen::Vector3d b = (mesh_.vertices[t[1]] - p).normalized();
      const Eigen::Vector3d c = (mesh_.vertices[t[2]] - p).normalized();
      sum += 2.0 * std::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
    }
    return sum / (4.0 * std::numbers::pi);
  }

  double signed_distance(const Eigen::Vector3d& p) const {
    return winding_number(p) > 0.5 ? -distance(p) : distance(p);
  }

 private:
  static double to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d ab = b - a;
    const double t = std::clamp(ab.dot(p - a) / ab.squaredNorm(), 0.0, 1.0);
    return (a + t * ab - p).norm();
  }

  /// In the plane's coordinates: the height above the face, or else the distance to the nearest of the three edges.
  static double to_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c) {
    const Eigen::Vector3d n = (b - a).cross(c - a).normalized();
    const auto left_of = [&](const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
      return n.dot((v - u).cross(p - u)) >= 0.0;
    };
    if (left_of(a, b) && left_of(b, c) && left_of(c, a)) return std::abs(n.dot(p - a));
    return std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
  }

  const TriangleMesh& mesh_;
};

}  // namespace godobject::scene_compiler
