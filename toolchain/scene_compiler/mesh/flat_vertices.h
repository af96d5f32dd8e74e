#pragma once

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// Removes vertices within flat faces and along straight edges of a mesh, as far as its triangles allow it: each is
/// pulled to a neighbour. So few large triangles remain of a finely divided face. No vertex moves, and the surface that
/// remains lies within `flat` [m] of the given one. Vertices with an edge that is open or has more
/// than two triangles stay, and so do all vertices in `mesh.vertices`. Cost: some sweeps over the vertices.
void remove_flat_vertices(TriangleMesh& mesh, double flat);

}  // namespace godobject::scene_compiler
