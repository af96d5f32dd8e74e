#pragma once

#include <vector>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// A needle is a triangle that is no higher than `flat` [m] and has a side of sqrt(2) times that length at most: two
/// vertices that are no more than `flat` apart along an edge, nor across it, are no farther apart than that. Pulls one
/// end of such a side to the other one and drops the triangles that had both, until no needle is left that may go. So
/// needles go without a slit between their long sides, which close_slits cannot close.
///
/// No vertex is pulled farther than sqrt(2) flat. A needle stays if the surface would join itself. In a cluster of
/// vertices triangles about the needles may turn over. Vertices of no triangle stay in `mesh.vertices`. Returns, for
/// each vertex, whether another one was pulled to it. Cost: that of the triangles and, for each pull, of those about
/// the vertices of the needle.
std::vector<bool> collapse_needles(TriangleMesh& mesh, double flat);

}  // namespace godobject::scene_compiler
