#pragma once

#include <filesystem>

#include "toolchain/scene_compiler/mesh/mesh_import.h"

namespace godobject::scene_compiler {

/// Reads a PLY file, ASCII or binary of either byte order, in full double precision: the properties x, y, z of
/// `vertex`, the list vertex_indices (or vertex_index) of `face`; everything else is skipped. Polygons are cut into
/// triangles. Fills the file_, polygons and lines_and_points fields of `report`. Throws std::runtime_error saying what
/// is wrong.
TriangleMesh read_ply(const std::filesystem::path& file, MeshReport& report);

}  // namespace godobject::scene_compiler
