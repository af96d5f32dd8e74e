#pragma once

#include <cstdint>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// Closes slits: places where a vertex lies on the edge of a triangle that lacks it, so that this edge and the edges
/// beside it have one triangle each although the surface has no hole. Programs for design export them where faces were
/// divided on one side only. The triangle is cut at the vertex, unless that would turn or flatten a piece of it or give
/// an edge a third triangle. Each cut moves the surface by `tolerance` [m] at most. Returns the number of cuts. Cost:
/// that of finding the mesh's edges.
std::uint64_t close_slits(TriangleMesh& mesh, double tolerance);

}  // namespace godobject::scene_compiler
