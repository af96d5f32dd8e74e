#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "godobject/pose.h"
#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

/// Generated meshes: closed, triangles counter-clockwise seen from outside, in metres.
namespace godobject::report {

using scene_compiler::TriangleMesh;

/// Returns the surface of a union of lattice cells. `planes` are the lattice's coordinates along x, y, z, ascending.
/// `filled(i, j, k)` tells if the cell between planes i and i + 1, j and j + 1, k and k + 1 is solid. Solid cells that
/// touch must share a face.
TriangleMesh cell_solid(const std::array<std::vector<double>, 3>& planes,
                        const std::function<bool(int, int, int)>& filled);

/// Returns a box from `low` to `high`.
TriangleMesh box_mesh(const Vector3& low, const Vector3& high);

/// Returns the solid below the profile z = heights[i] at x = xs[i] (straight in between), above z = bottom, with
/// |y| < half_width.
TriangleMesh profile_solid(std::span<const double> xs, std::span<const double> heights, double bottom,
                           double half_width);

/// A corner of a profile of a solid of revolution about the z axis.
struct TurnedCorner {
  double radius;
  double z;
};

/// Returns the solid of revolution of a profile about z in `around` steps. The profile goes from axis to axis with the
/// body on its left (upwards on the outside). Only its first and last corners lie on the axis.
TriangleMesh turned_solid(std::span<const TurnedCorner> profile, int around);

/// Returns a ball about the origin with its vertices on the sphere.
TriangleMesh ball_mesh(double radius, int rings);

/// Returns an open square sheet without thickness in the plane z = 0 about the origin.
TriangleMesh sheet_mesh(double half_edge);

TriangleMesh moved(TriangleMesh mesh, const Pose& motion);

/// Writes the mesh as ASCII PLY in full double precision.
void write_ply(const TriangleMesh& mesh, const std::filesystem::path& file);

}  // namespace godobject::report
