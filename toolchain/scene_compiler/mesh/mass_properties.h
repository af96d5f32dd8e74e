#pragma once

#include <span>

#include <Eigen/Core>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// Mass distribution of a body per unit of mass, in the frame M of its mesh.
struct MassMoments {
  double volume = 0.0;                                ///< [m^3]; 0 if the mesh encloses none
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   ///< centre of mass [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre of mass, J / m [m^2]
};

/// The body frame B: origin at the centre of mass, axes along the principal axes.
struct PrincipalAxes {
  Eigen::Matrix3d rotation_MB = Eigen::Matrix3d::Identity();  ///< right-handed; columns: axes of B in M
  Eigen::Vector3d moments = Eigen::Vector3d::Zero();          ///< of J_B / m, ascending [m^2]
};

/// Returns the exact volume integrals of a closed mesh of uniform density. The densities of overlapping components add
/// up. If the components enclose no positive volume, `volume` is 0 and the other members have no meaning.
MassMoments moments_of_volume(const TriangleMesh& closed_mesh);

/// Returns the centre of mass of the enclosed volume; of an open mesh, that of its surface. In the mesh's frame [m].
/// `closed`: as MeshEdges::closed tells.
Eigen::Vector3d centre_of_mass(const TriangleMesh& mesh, bool closed);

/// Returns the moments of equal masses at the points (at least one).
MassMoments moments_of_points(std::span<const Eigen::Vector3d> points);

/// Returns the principal axes of J / m. If moments are equal (to 1e-5 of the largest), the axes nearest to M's own are
/// chosen: a cube keeps its frame. The largest component of the first two axes is positive. The third axis makes the
/// frame right-handed.
PrincipalAxes principal_axes(const Eigen::Matrix3d& inertia);

}  // namespace godobject::scene_compiler
