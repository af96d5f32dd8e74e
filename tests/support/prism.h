#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/pipeline/contact/edges/edge_gap.h"
#include "tests/support/edge_set.h"
#include "tests/support/random.h"

namespace godobject::test {

/// A convex prism: its corners, its edges with the normals of their faces, and the directions of its faces and edges.
struct Prism {
  EdgeSet edges;
  std::vector<Vector3> corners;
  std::vector<Vector3> normals;  ///< of all faces
  std::vector<Vector3> along;    ///< of all edges

  /// A prism over a polygon in the plane z = 0, counterclockwise, from z = -height / 2 to height / 2.
  static Prism over(const std::vector<Eigen::Vector2d>& polygon, double height) {
    const std::size_t n = polygon.size();
    std::vector<std::pair<Vector3, Vector3>> segments;
    std::vector<std::pair<Vector3, Vector3>> faces;  // beside each edge
    Prism prism{EdgeSet({}), {}, {Vector3::UnitZ(), -Vector3::UnitZ()}, {Vector3::UnitZ()}};
    const auto corner = [&](std::size_t k, double side) {
      return Vector3(polygon[k % n].x(), polygon[k % n].y(), 0.5 * side * height);
    };
    const auto side_of = [&](std::size_t k) {
      const Eigen::Vector2d step = polygon[(k + 1) % n] - polygon[k % n];
      return Vector3(step.y(), -step.x(), 0.0).normalized();
    };
    for (std::size_t k = 0; k < n; ++k) {
      for (const double side : {-1.0, 1.0}) {
        segments.emplace_back(corner(k, side), corner(k + 1, side));
        faces.emplace_back(side_of(k), side * Vector3::UnitZ());
        prism.corners.push_back(corner(k, side));
      }
      segments.emplace_back(corner(k, -1.0), corner(k, 1.0));
      faces.emplace_back(side_of(k + n - 1), side_of(k));
      prism.normals.push_back(side_of(k));
      prism.along.push_back((corner(k + 1, 1.0) - corner(k, 1.0)).normalized());
    }
    prism.edges = EdgeSet(segments);
    for (std::size_t i = 0; i < segments.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        prism.edges.edges()[i].normal[0][axis] = static_cast<float>(faces[i].first[axis]);
        prism.edges.edges()[i].normal[1][axis] = static_cast<float>(faces[i].second[axis]);
      }
    }
    return prism;
  }

  bool contains(const Vector3& p) const {
    for (const Vector3& normal : normals) {
      if (normal.dot(p) > highest(normal, Pose{})) return false;
    }
    return true;
  }

  double highest(const Vector3& direction, const Pose& H) const {
    const Vector3 in_body = H.rotation.conjugate() * direction;
    double most = -1e9;
    for (const Vector3& corner : corners) most = std::max(most, in_body.dot(corner));
    return most + direction.dot(H.translation);
  }
};

/// Returns the widest gap between the shadows of two convex bodies on the lines that decide whether they are apart
/// (Gottschalk, Lin and Manocha, OBBTree, 1996) [m]: negative where they overlap.
inline double separation(const Prism& moving, const Prism& still, const Pose& H) {
  double gap = -1e9;
  const auto try_line = [&](const Vector3& line) {
    const double length = line.norm();
    if (length < 1e-6) return;
    for (const double sign : {1.0, -1.0}) {
      const Vector3 way = sign / length * line;
      gap = std::max(gap, -moving.highest(-way, H) - still.highest(way, Pose{}));
    }
  };
  for (const Vector3& normal : still.normals) try_line(normal);
  for (const Vector3& normal : moving.normals) try_line(H.rotation * normal);
  for (const Vector3& a : moving.along) {
    for (const Vector3& b : still.along) try_line((H.rotation * a).cross(b));
  }
  return gap;
}

/// A point of an edge of the prism, in half of all cases near its end.
inline Vector3 random_place(Random& random, const Prism& prism) {
  const std::size_t i =
      static_cast<std::size_t>(random.integer(0, static_cast<int>(prism.edges.view().edges.size()) - 1));
  const format::SharpEdge& edge = prism.edges.view().edges[i];
  const Vector3 along = edge_end(edge, 1) - edge_end(edge, 0);
  return edge_end(edge, 0) + (random.integer(0, 1) == 0 ? random.between(0.0, 1.0) : random.between(0.0, 0.05)) * along;
}

/// Returns a pose at which two random places of edges are at most 0.3 mm apart.
inline Pose random_meeting(Random& random, const Prism& moving, const Prism& still) {
  const Vector3 p = random_place(random, moving);
  const Vector3 q = random_place(random, still);
  Pose H = Pose{} * set_matrix(random.motion(0.01, M_PI));
  H.translation = q + random.between(0.0, 3e-4) * random.direction() - H.rotation * p;
  return H;
}

/// Returns a wheel with this many corners [m].
inline Prism wheel_with(int corners) {
  std::vector<Eigen::Vector2d> circle;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * M_PI * k / corners;
    circle.emplace_back(0.01 * std::cos(angle), 0.01 * std::sin(angle));
  }
  return Prism::over(circle, 0.006);
}

/// Tells whether a corner of the prism at H lies inside the other one, and whether it is near one of its edges there.
struct CornersInside {
  bool any = false;
  bool near_an_edge = false;

  CornersInside(const Prism& prism, const Pose& H, const Prism& other, double near) {
    for (const Vector3& corner : prism.corners) {
      const Vector3 p = H * corner;
      if (!other.contains(p)) continue;
      any = true;
      for (const format::SharpEdge& edge : other.edges.view().edges) {
        const Vector3 along = edge_end(edge, 1) - edge_end(edge, 0);
        const double place = nearest_place(edge_end(edge, 0), along, along.squaredNorm(), p);
        near_an_edge =
            near_an_edge || (place > 0.0 && place < 1.0 && (edge_end(edge, 0) + place * along - p).norm() < near);
      }
    }
  }
};

}  // namespace godobject::test
