#pragma once

#include <cstdint>
#include <vector>

#include "toolchain/scene_compiler/mesh/solid_surface.h"
#include "toolchain/scene_compiler/mesh/triangle_tree.h"

namespace godobject::scene_compiler {

/// Edges along which the solid components' triangles do not cancel.
struct OpenBoundary {
  TriangleTree edges;   ///< as flat triangles
  double length = 0.0;  ///< each edge as often as it is left over [m]
};

OpenBoundary open_boundary(const TriangleMesh& mesh, const std::vector<SolidSurface::Component>& components,
                           const std::vector<std::uint32_t>& component_of);

}  // namespace godobject::scene_compiler
