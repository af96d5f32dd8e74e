#pragma once

#include <algorithm>
#include <cstdint>

#include "core/scene/sharp_edges.h"
#include "godobject/pose.h"

namespace godobject {

/// A straight edge in the still body's frame W.
struct EdgeInW {
  Vector3 end[2];     ///< [m]
  Vector3 normal[2];  ///< outward unit normals of its faces; 0 on a sheet
  double radius;      ///< of a sheet: half its thickness [m]

  /// Returns the edge of a body at pose H_WB.
  static EdgeInW at(const format::SharpEdge& edge, const Pose& H_WB) noexcept {
    return at(edge, H_WB.rotation.toRotationMatrix(), H_WB.translation);
  }
  /// The same for a rotation and a translation.
  static EdgeInW at(const format::SharpEdge& edge, const Matrix3& R_WB, const Vector3& x_WB) noexcept {
    return {{R_WB * edge_end(edge, 0) + x_WB, R_WB * edge_end(edge, 1) + x_WB},
            {R_WB * face_normal(edge, 0), R_WB * face_normal(edge, 1)},
            static_cast<double>(edge.radius)};
  }
  /// Returns an edge of the still body.
  static EdgeInW of_still(const format::SharpEdge& edge) noexcept {
    return {{edge_end(edge, 0), edge_end(edge, 1)},
            {face_normal(edge, 0), face_normal(edge, 1)},
            static_cast<double>(edge.radius)};
  }
};

/// Returns the place on a segment from `from` along `along` that is nearest to a point, as a share of its length; 0 if
/// it has none. `square`: squared length [m^2].
inline double nearest_place(const Vector3& from, const Vector3& along, double square, const Vector3& point) noexcept {
  return square > 0.0 ? std::clamp(along.dot(point - from) / square, 0.0, 1.0) : 0.0;
}

/// Returns the distance between the surfaces of two edges at their nearest points [m]: that of edge_gap for bodies that
/// are apart. Cost: some 30 ns. Real-time safe.
double edge_distance(const EdgeInW& moving, const EdgeInW& still) noexcept;

/// Which nearest point of two edges lies inside the wedge of the other edge, beside no end of that one.
enum class EdgeInside : std::uint8_t {
  kNone,
  kPoint,        ///< that of one edge, and it is no end
  kBoth,         ///< those of both edges, and none is an end: the edges overlap
  kEndOfMoving,  ///< that of the moving edge, and it is an end
  kEndOfStill,   ///< that of the still edge, and it is an end
};

/// The gap between an edge of the moving body and one of the still body.
struct EdgeGap {
  double distance = 0.0;                ///< between the surfaces at the nearest points; negative: they overlap [m]
  Vector3 normal = Vector3::Zero();     ///< unit: the gap grows as the moving edge moves along it
  Vector3 on_moving = Vector3::Zero();  ///< nearest point of the moving edge [m]
  Vector3 on_still = Vector3::Zero();   ///< nearest point of the still edge [m]
  double place = 0.0;                   ///< of `on_moving`, from end 0 to end 1 of the moving edge [1]
  /// True if neither edge lies over a face of the other one. Else that face is nearer than the edge.
  bool is_nearest = true;
  EdgeInside inside = EdgeInside::kNone;  ///< at the nearest points, as edge_gap found them

  /// Tells whether the edges overlap, or an end of one may overlap the other.
  bool may_be_turned() const noexcept {
    return distance < 0.0 || inside == EdgeInside::kEndOfMoving || inside == EdgeInside::kEndOfStill;
  }
  /// Turns the gap into that of edges which overlap by as much.
  void turn_round() noexcept {
    normal = -normal;
    distance -= 2.0 * (on_moving - on_still).norm();
    is_nearest = true;
  }
};

/// Returns the gap between the edges at their nearest points, in W.
///
/// Between two bodies that are apart the gap is the distance of the edges, less the radii of sheets. At the start
/// bodies may overlap: two edges of solids that are nearer than `deepest` [m] overlap if each lies inside the wedge of
/// the other, and neither of the nearest points is an end. Then the gap is negative. `inside` is set for edges nearer
/// than `deepest` only. Edges that meet within 1e-12 m have the normal of their common perpendicular, out of the still
/// body. Cost: some 60 ns. Real-time safe.
EdgeGap edge_gap(const EdgeInW& moving, const EdgeInW& still, double deepest = 0.0) noexcept;

}  // namespace godobject
