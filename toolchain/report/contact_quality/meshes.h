#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "godobject/pose.h"
#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

/// Generated meshes: closed, counter-clockwise seen from outside, metres.
namespace godobject::report {

using scene_compiler::TriangleMesh;

/// The surface of a union of lattice cells. `planes` are the lattice's coordinates along x, y, z, ascending;
/// `filled(i, j, k)` tells of the cell between planes i and i + 1, j and j + 1, k and k + 1. Filled cells that touch
/// must share a face.
TriangleMesh cell_solid(const std::array<std::vector<double>, 3>& planes,
                        const std::function<bool(int, int, int)>& filled);

/// A box from `low` to `high`.
TriangleMesh box_mesh(const Vector3& low, const Vector3& high);

/// Solid below the profile z = heights[i] at x = xs[i] (straight in between), above z = bottom, |y| < half_width.
TriangleMesh profile_solid(std::span<const double> xs, std::span<const double> heights, double bottom,
                           double half_width);

/// A corner of a profile turned about the z axis.
struct TurnedCorner {
  double radius;
  double z;
};

/// The profile, from axis to axis with the body to its left seen along the way (upwards on the outside), turned about
/// z in `around` steps. Only its first and last corners lie on the axis.
TriangleMesh turned_solid(std::span<const TurnedCorner> profile, int around);

/// A ball about the origin with its vertices on the sphere.
TriangleMesh ball_mesh(double radius, int rings);

/// A square sheet without thickness in the plane z = 0 about the origin: open.
TriangleMesh sheet_mesh(double half_edge);

TriangleMesh moved(TriangleMesh mesh, const Pose& motion);

/// ASCII PLY in full double precision.
void write_ply(const TriangleMesh& mesh, const std::filesystem::path& file);

}  // namespace godobject::report
