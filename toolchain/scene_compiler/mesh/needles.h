#pragma once

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// A needle is a triangle that is no higher than `flat` [m] and has a side of sqrt(2) times that length at most: where
/// a vertex is that near to another one, neither along an edge nor across it are they more than `flat` apart. Pulls one
/// end of such a side to the other one and drops the triangles that had both, until no needle is left that may go. So
/// needles go without a slit between their long sides, which close_slits cannot close.
///
/// No vertex is pulled farther than sqrt(2) flat. A needle stays if another triangle higher than `flat` would turn over
/// or if the surface would join itself. Vertices of no triangle stay in `mesh.vertices`. Cost: that of the triangles
/// and, for each pull, of those about both ends.
void collapse_needles(TriangleMesh& mesh, double flat);

}  // namespace godobject::scene_compiler
