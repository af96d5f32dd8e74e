#pragma once

#include <cstdint>
#include <filesystem>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// What was found in a mesh file and what was done about it.
struct MeshReport {
  std::uint64_t file_vertices = 0;
  std::uint64_t file_faces = 0;
  std::uint64_t polygons = 0;              ///< faces of more than three corners, cut into triangles
  std::uint64_t lines_and_points = 0;      ///< faces of one or two corners, dropped
  std::uint64_t welded_vertices = 0;       ///< dropped: another one stands within the tolerance
  std::uint64_t degenerate_triangles = 0;  ///< dropped: no area
  std::uint64_t duplicate_triangles = 0;   ///< dropped: another one has the same corners
  std::uint64_t folded_triangles = 0;      ///< kept in pairs of opposite sense: a fold without volume
  std::uint64_t unreferenced_vertices = 0;
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  std::uint64_t boundary_edges = 0;               ///< of one triangle
  std::uint64_t nonmanifold_edges = 0;            ///< of more than two triangles
  std::uint64_t misoriented_edges = 0;            ///< of two triangles that run along it the same way
  std::uint64_t components = 0;                   ///< connected by shared vertices
  std::int64_t euler = 0;                         ///< vertices - edges + triangles
  double weld_tolerance = 0.0;                    ///< [m]
  Eigen::Vector3d low = Eigen::Vector3d::Zero();  ///< bounding box [m]
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
};

/// Largest mesh that is taken, and the largest coordinate in metres.
inline constexpr std::uint64_t kMaxTriangles = 1u << 25;
inline constexpr double kMaxCoordinate = 1e5;

/// Reads a PLY, STL or OBJ file, scales it to metres and cleans it: coincident vertices welded (1e-6 of the bounding
/// box's diagonal), degenerate and duplicate triangles and loose vertices dropped. STL and OBJ pass through single
/// precision. Throws Failure naming the file and the cure: kNoInput if it cannot be read, kBadData if it holds no
/// usable mesh.
TriangleMesh import_mesh(const std::filesystem::path& file, double scale, MeshReport& report);

/// The cleaning alone; `name` is used in messages.
TriangleMesh clean_mesh(TriangleMesh mesh, const std::string& name, MeshReport& report);

}  // namespace godobject::scene_compiler
