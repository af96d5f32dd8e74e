#pragma once

#include <vector>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// Collapses needles. A needle is a triangle that is no higher than `flat` [m] and has a side of sqrt(2) times that
/// length at most: two vertices are no farther apart than that if they are at most `flat` apart along an edge and
/// across it. One end of the side is pulled to the other one, and the triangles that had both are dropped, until no
/// needle is left that may go. Without this, a needle that is left out leaves a slit that close_slits cannot close.
///
/// No vertex is pulled farther than sqrt(2) flat. A needle stays if the surface would join itself. In a cluster of
/// vertices triangles about the needles may turn over. Vertices of no triangle stay in `mesh.vertices`. Returns, for
/// each vertex, whether another one was pulled to it. Cost: that of the triangles and, for each pull, of those about
/// the vertices of the needle.
std::vector<bool> collapse_needles(TriangleMesh& mesh, double flat);

}  // namespace godobject::scene_compiler
