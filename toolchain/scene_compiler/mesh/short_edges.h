#pragma once

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// Collapses the edges that are no longer than `longest` [m]: pulls one end to the other one and drops the triangles
/// that had both. So needles go without a slit between their long sides. No vertex is pulled farther than `longest`, so
/// a triangle that is higher than that does not turn over. An edge stays if the surface would join itself. Vertices of
/// no triangle stay in `mesh.vertices`. Cost: that of the edges, and of the triangles about short ones.
void collapse_short_edges(TriangleMesh& mesh, double longest);

}  // namespace godobject::scene_compiler
