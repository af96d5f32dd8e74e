#pragma once

#include <filesystem>

#include "toolchain/scene_compiler/mesh/mesh_import.h"

namespace godobject::scene_compiler {

/// Reads a PLY file, ASCII or binary of either byte order, in double precision. Reads the properties x, y, z of
/// `vertex` and the list vertex_indices (or vertex_index) of `face`, and skips all others. Cuts polygons into
/// triangles. Fills the members file_vertices, file_faces, polygons and lines_and_points of `report`. Throws
/// std::runtime_error with the reason.
TriangleMesh read_ply(const std::filesystem::path& file, MeshReport& report);

}  // namespace godobject::scene_compiler
