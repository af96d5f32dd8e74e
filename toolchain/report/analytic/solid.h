#pragma once

#include <variant>
#include <vector>

#include "godobject/pose.h"
#include "toolchain/report/analytic/field.h"

namespace godobject::analytic {

/// A solid box with edges along the axes, dilated by `radius`, which rounds edges and corners.
struct Box {
  Vector3 center = Vector3::Zero();
  Vector3 half_edges = Vector3::Constant(0.1);
  double radius = 0.0;
  double distance(const Vector3& p) const noexcept { return box_distance(p - center, half_edges) - radius; }
  Vector3 gradient(const Vector3& p) const noexcept;
};

/// Solid outside a cylinder about the z axis.
struct Bore {
  double radius = 0.01;
  double distance(const Vector3& p) const noexcept { return radius - p.head<2>().norm(); }
  Vector3 gradient(const Vector3& p) const noexcept;
};

using Primitive = std::variant<HalfSpace, Ball, Box, Bore>;

/// A smooth part of a distance function.
struct Piece {
  double distance = 0.0;
  Vector3 gradient = Vector3::Zero();
};

/// The union of solid primitives in a frame O of its own. The distance is the smallest of theirs: exact outside, and
/// inside wherever the deepest primitive's nearest surface point is not covered by another one.
class Solid {
 public:
  explicit Solid(std::vector<Primitive> primitives) : primitives_(std::move(primitives)) {}

  /// Returns the same solid with frame O at H_WO.
  Solid moved(const Pose& H_WO) const;

  double distance(const Vector3& p_W) const noexcept;
  Vector3 gradient(const Vector3& p_W) const noexcept;  ///< of the nearest primitive

  /// Appends distance and gradient of each primitive. Their minimum is the distance; each is smooth near its own
  /// surface.
  void pieces(const Vector3& p_W, std::vector<Piece>& out) const;

 private:
  std::vector<Primitive> primitives_;
  Pose H_WO_;
  Pose H_OW_;
};

}  // namespace godobject::analytic
