#pragma once

#include <cstdint>
#include <filesystem>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// Defects that were found in a mesh file, and their repair.
struct MeshReport {
  std::uint64_t file_vertices = 0;
  std::uint64_t file_faces = 0;
  std::uint64_t polygons = 0;              ///< faces with more than three corners, cut into triangles
  std::uint64_t lines_and_points = 0;      ///< faces with one or two corners, dropped
  std::uint64_t welded_vertices = 0;       ///< dropped: another vertex lies within the tolerance
  std::uint64_t degenerate_triangles = 0;  ///< dropped: no area
  std::uint64_t duplicate_triangles = 0;   ///< dropped: another triangle has the same corners
  std::uint64_t folded_triangles = 0;      ///< stored in pairs of opposite sense: a fold without volume
  std::uint64_t unreferenced_vertices = 0;
  std::uint64_t cuts_at_slits = 0;  ///< triangles cut where a vertex of others lies on their edge: see close_slits
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  std::uint64_t boundary_edges = 0;               ///< edges of one triangle
  std::uint64_t nonmanifold_edges = 0;            ///< edges of more than two triangles
  std::uint64_t turned_triangles = 0;             ///< turned round so that neighbours agree: see agree_on_sense
  std::uint64_t misoriented_edges = 0;            ///< remaining edges along which both triangles run the same way
  std::uint64_t components = 0;                   ///< connected by shared vertices
  std::int64_t euler = 0;                         ///< vertices - edges + triangles
  double weld_tolerance = 0.0;                    ///< [m]
  Eigen::Vector3d low = Eigen::Vector3d::Zero();  ///< bounding box [m]
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
};

/// Limits of a mesh. A tree over 2^25 triangles, of 80 bytes each and as much for its nodes, takes 5 GB. Beyond 1e5 m
/// single-precision coordinates, which STL and OBJ have, are 8 mm apart.
inline constexpr std::uint64_t kMaxTriangles = 1u << 25;
inline constexpr double kMaxCoordinate = 1e5;
inline constexpr std::uint64_t kMaxMeshBytes = std::uint64_t{4} << 30;  ///< of a file, which is read as a whole

/// Reads a PLY, STL or OBJ file, scales it to metres and cleans it: welds coincident vertices (within 1e-6 of the
/// bounding box's diagonal), drops degenerate and duplicate triangles and unused vertices, closes slits, and turns
/// triangles round so that neighbours agree. Coordinates of STL and OBJ files have single precision. Throws Failure
/// naming the file and the cure: kNoInput if it cannot be read, kBadData if it is larger than kMaxMeshBytes or contains
/// no usable mesh.
TriangleMesh import_mesh(const std::filesystem::path& file, double scale, MeshReport& report);

/// Does the cleaning only. `name` stands for the mesh in messages.
TriangleMesh clean_mesh(TriangleMesh mesh, const std::string& name, MeshReport& report);

}  // namespace godobject::scene_compiler
