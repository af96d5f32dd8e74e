#pragma once

#include <cstdint>
#include <vector>

#include "toolchain/scene_compiler/mesh/solid_surface.h"
#include "toolchain/scene_compiler/mesh/triangle_tree.h"

namespace godobject::scene_compiler {

/// The edges along which the triangles of the solid components do not cancel.
struct OpenBoundary {
  TriangleTree edges;   ///< as triangles without area
  double length = 0.0;  ///< each edge counts as often as its sides do not cancel [m]
  /// Triangles from the edges to the middle of each connected set of them. Solids and caps together have no boundary:
  /// around a place their winding number is whole, and that of the solids is less by that of the caps.
  TriangleTree caps;
};

OpenBoundary open_boundary(const TriangleMesh& mesh, const std::vector<SolidSurface::Component>& components,
                           const std::vector<std::uint32_t>& component_of);

}  // namespace godobject::scene_compiler
