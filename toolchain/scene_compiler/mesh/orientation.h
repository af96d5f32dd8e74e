#pragma once

#include <cstdint>

#include "toolchain/scene_compiler/mesh/mesh_edges.h"
#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// Turns triangles round so that neighbours agree: the two triangles at an edge run along it in opposite directions.
/// Triangles that are connected by edges of two triangles form a patch. Of its two senses the one that held for more
/// area stays. A patch without two sides, as a Moebius strip, is unchanged. `edges` are those of the mesh, and not
/// those of the result. Returns the number of turned triangles. Cost: linear.
std::uint64_t agree_on_sense(TriangleMesh& mesh, const MeshEdges& edges);

}  // namespace godobject::scene_compiler
