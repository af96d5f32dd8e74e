#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "toolchain/scene_compiler/mesh/body_mesh.h"
#include "toolchain/scene_compiler/mesh/surface_sample.h"

namespace godobject::scene_compiler {

/// The pieces of a body's surface, buried ones included. Solids: the triangles. Shells: both faces, half the thickness
/// off each triangle, and the sectors of cylinders that round rims and creases. The pieces of spheres around a shell's
/// vertices are left out, because their area is of the order of the thickness squared.
class SurfacePatches {
 public:
  /// Stores a reference: `body` must outlive this object.
  explicit SurfacePatches(const BodyMesh& body);

  double area() const { return cumulated_area_.empty() ? 0.0 : cumulated_area_.back(); }  ///< of all pieces [m^2]

  /// Returns the point at the share `at` (0 .. 1) of the total area, pieces in order, at u and v (0 .. 1) within its
  /// piece. Uniform numbers give uniform points. Normals are interpolated over faces that meet at less than the crease
  /// angle.
  SurfaceSample draw(double at, double u, double v) const;

  std::size_t size() const { return patches_.size(); }
  double area(std::size_t piece) const {
    return cumulated_area_[piece] - (piece > 0 ? cumulated_area_[piece - 1] : 0.0);
  }

  /// Returns the point of a piece at u and v (0 .. 1). Equal areas of the unit square map to equal areas of the piece.
  SurfaceSample at(std::size_t piece, double u, double v) const;

 private:
  struct Patch {
    enum class Kind : std::uint8_t { kSolid, kShellFront, kShellBack, kRound };
    Kind kind;
    std::uint32_t index;  ///< triangle or round
  };
  /// A sector of a cylinder around an edge.
  struct Round {
    std::uint32_t low, high;  ///< vertices
    Eigen::Vector3d outward;  ///< middle of the sector
    double half_angle;        ///< [rad]
  };

  void add(const Patch& patch, double area);
  void add_triangles();
  void add_rounds();
  SurfaceSample draw_on_triangle(const Patch& patch, double u, double v) const;
  SurfaceSample draw_on_round(const Round& round, double u, double v) const;

  const BodyMesh& body_;
  std::vector<std::array<Eigen::Vector3d, 3>> corner_normals_;
  std::vector<Round> rounds_;
  std::vector<Patch> patches_;
  std::vector<double> cumulated_area_;
};

}  // namespace godobject::scene_compiler
