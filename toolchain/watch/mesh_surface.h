#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "toolchain/watch/oracle.h"

namespace godobject::watch {

/// A triangle mesh as an exact oracle: distance to the nearest triangle, sign by the angle-weighted normal of the
/// nearest face, edge or vertex (Baerentzen and Aanaes, IEEE TVCG 11, 2005). Of an open mesh the sign means nothing. It
/// shares no code with the scene compiler.
class MeshSurface final : public Oracle {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// Counter-clockwise seen from outside, oriented.
  MeshSurface(std::vector<Vector3> vertices, std::vector<Triangle> triangles);

  double distance(const Vector3& p) const override;
  double distance_within(const Vector3& p, double most) const override;
  Vector3 gradient(const Vector3& p) const override;
  double lipschitz() const override { return 1.0; }

  /// Tells whether the segment meets a triangle.
  bool meets(const Vector3& p0, const Vector3& p1) const;

  const std::vector<Vector3>& vertices() const { return vertices_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  struct Box {
    Vector3 low, high;
    std::uint32_t first = 0, count = 0;  ///< of order_; count 0: inner node, children at 2 k + 1 and 2 k + 2
  };
  struct Nearest {
    Vector3 point;
    const Vector3* normal = nullptr;  ///< outward, of the feature that holds the point; not unit; null: no point
    double squared = 0.0;
  };

  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);
  /// Only triangles count that are nearer than the root of `within`; without one the result's `squared` is `within`.
  Nearest nearest(const Vector3& p, double within = std::numeric_limits<double>::infinity()) const;
  static double signed_distance(const Nearest& near, const Vector3& p);
  Nearest nearest_of(std::uint32_t triangle, const Vector3& p) const;
  bool triangle_meets(std::uint32_t triangle, const Vector3& p0, const Vector3& d) const;

  std::vector<Vector3> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<Vector3> face_normals_;                 ///< unit
  std::vector<std::array<Vector3, 3>> edge_normals_;  ///< of the edge opposite to corner i: sum of both faces'
  std::vector<Vector3> vertex_normals_;               ///< angle-weighted
  std::vector<std::uint32_t> order_;
  std::vector<Box> boxes_;
};

/// The surface at a distance from a mesh: a solid grown all round, as the centre of a ball meets it, or a sheet made
/// thick.
class GrownSurface final : public Oracle {
 public:
  /// `distance` >= 0 [m]; a sheet gets twice that thickness.
  GrownSurface(MeshSurface mesh, double distance, bool is_sheet)
      : mesh_(std::move(mesh)), grown_by_(distance), is_sheet_(is_sheet) {}

  double distance(const Vector3& p) const override {
    const double to_mesh = mesh_.distance(p);
    return (is_sheet_ ? std::abs(to_mesh) : to_mesh) - grown_by_;
  }
  double distance_within(const Vector3& p, double most) const override {
    const double to_mesh = mesh_.distance_within(p, most + grown_by_);
    return (is_sheet_ ? std::abs(to_mesh) : to_mesh) - grown_by_;
  }
  Vector3 gradient(const Vector3& p) const override {
    const bool is_behind = is_sheet_ && mesh_.distance(p) < 0.0;
    return is_behind ? Vector3(-mesh_.gradient(p)) : mesh_.gradient(p);
  }
  double lipschitz() const override { return 1.0; }

 private:
  MeshSurface mesh_;
  double grown_by_;
  bool is_sheet_;
};

}  // namespace godobject::watch
