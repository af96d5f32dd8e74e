#include "toolchain/scene_compiler/points/bounding_sphere.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Geometry>

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

/// Of the radius, for points on the sphere: far above double rounding, far below float's.
constexpr double kInsideSlack = 1e-10;
/// Squared relative area or volume of collinear or coplanar points: 1e-12, the rounding of their products.
constexpr double kDegenerate = 1e-24;
constexpr int kMostExchanges = 1000;  // ends a loop that rounding might cause; never seen above 30

/// At most four points that determine a sphere, and one more outside it.
struct Support {
  std::array<Vector3d, 5> points{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(),
                                 Vector3d::Zero()};
  std::size_t count = 0;
};

/// Finds the smallest sphere with all of at most four points on it. False if they are (nearly) dependent.
bool sphere_through(const Support& support, Sphere& sphere) {
  const auto& points = support.points;
  const Vector3d& origin = points[0];
  Vector3d offset = Vector3d::Zero();
  if (support.count == 2) {
    offset = 0.5 * (points[1] - origin);
  } else if (support.count == 3) {
    const Vector3d a = points[1] - origin;
    const Vector3d b = points[2] - origin;
    const Vector3d normal = a.cross(b);
    if (!(normal.squaredNorm() > kDegenerate * a.squaredNorm() * b.squaredNorm())) return false;
    offset = (a.squaredNorm() * b - b.squaredNorm() * a).cross(normal) / (2.0 * normal.squaredNorm());
  } else if (support.count == 4) {
    const Vector3d a = points[1] - origin;
    const Vector3d b = points[2] - origin;
    const Vector3d c = points[3] - origin;
    const double volume = a.dot(b.cross(c));
    if (!(volume * volume > kDegenerate * a.squaredNorm() * b.squaredNorm() * c.squaredNorm())) return false;
    offset =
        (a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b)) / (2.0 * volume);
  }
  sphere = {origin + offset, offset.norm()};
  return true;
}

bool contains(const Sphere& sphere, const Support& support) {
  for (std::size_t i = 0; i < support.count; ++i) {
    if (!((support.points[i] - sphere.center).norm() <= sphere.radius * (1.0 + kInsideSlack))) return false;
  }
  return true;
}

/// Returns the support's points with set bits, and first the last point.
Support subset(const Support& support, unsigned chosen) {
  Support part;
  part.points[part.count++] = support.points[support.count - 1];
  for (std::size_t i = 0; i + 1 < support.count; ++i) {
    if ((chosen >> i) & 1u) part.points[part.count++] = support.points[i];
  }
  return part;
}

/// Finds the smallest sphere around the support's points, the last of which lies on it. Keeps the points that determine
/// it. False if only rounding is left.
bool exchange(Support& support, Sphere& sphere) {
  Sphere best{Vector3d::Zero(), std::numeric_limits<double>::infinity()};
  unsigned best_chosen = 0;
  for (unsigned chosen = 0; chosen < (1u << (support.count - 1)); ++chosen) {
    if (std::popcount(chosen) > 3) continue;
    Sphere candidate;
    if (!sphere_through(subset(support, chosen), candidate)) continue;
    if (!(candidate.radius < best.radius) || !contains(candidate, support)) continue;
    best = candidate;
    best_chosen = chosen;
  }
  if (!(best.radius > sphere.radius) || !std::isfinite(best.radius)) return false;  // only rounding is left
  sphere = best;
  support = subset(support, best_chosen);
  return true;
}

}  // namespace

/// Exchanges the basis as in the simplex method, because the smallest sphere is an LP-type problem. The point farthest
/// outside enters the set of at most four points that determine the sphere. The radius grows each time, until no point
/// is outside.
Sphere bounding_sphere(std::span<const Vector3d> points) {
  Sphere sphere{points.front(), 0.0};
  Support support;
  support.points[support.count++] = points.front();
  for (int round = 0; round < kMostExchanges; ++round) {
    std::size_t furthest = 0;
    double largest = -1.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double squared = (points[i] - sphere.center).squaredNorm();
      if (squared > largest) {
        largest = squared;
        furthest = i;
      }
    }
    if (std::sqrt(largest) <= sphere.radius * (1.0 + kInsideSlack)) break;
    support.points[support.count++] = points[furthest];
    if (!exchange(support, sphere)) break;
  }
  for (const Vector3d& point : points) sphere.radius = std::max(sphere.radius, (point - sphere.center).norm());
  return sphere;
}

}  // namespace godobject::scene_compiler
