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
  /// Triangles from the edges to the middle of each connected set of them. Solids and caps together have an integer
  /// winding number. Subtract that of the caps to get that of the solids.
  TriangleTree caps;
  /// True if the caps are few and small beside the solids. Otherwise a sum over caps may take longer than one over the
  /// solids: caps of long slits overlap, so that no dipole stands for many of them.
  bool caps_are_small = true;
};

/// Finds the open boundary of the solid components of a mesh. `component_of`: by triangle.
OpenBoundary open_boundary(const TriangleMesh& mesh, const std::vector<SolidSurface::Component>& components,
                           const std::vector<std::uint32_t>& component_of);

}  // namespace godobject::scene_compiler
