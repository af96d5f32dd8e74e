#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::report {

/// A straight piece of a mesh's section.
using Segment = std::array<Eigen::Vector2d, 2>;

/// Returns the section of a mesh with the half-plane that begins at the z axis, at an angle from x to y [rad], in its
/// coordinates (radius, z) [m].
std::vector<Segment> axial_section(const scene_compiler::TriangleMesh& mesh, double angle);

/// Returns the section of a mesh with the plane at height z, in the coordinates (x, y) [m].
std::vector<Segment> level_section(const scene_compiler::TriangleMesh& mesh, double z);

}  // namespace godobject::report
