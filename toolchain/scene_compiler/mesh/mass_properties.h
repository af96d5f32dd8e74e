#pragma once

#include <span>

#include <Eigen/Core>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// How a body's mass is spread, per unit of mass, in the frame M of its mesh.
struct MassMoments {
  double volume = 0.0;                                ///< [m^3]; 0 where there is none
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   ///< centre of mass [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre of mass, J / m [m^2]
};

/// The body frame B: the centre of mass, the principal axes.
struct PrincipalAxes {
  Eigen::Matrix3d rotation_MB = Eigen::Matrix3d::Identity();  ///< right-handed; columns: axes of B in M
  Eigen::Vector3d moments = Eigen::Vector3d::Zero();          ///< of J_B / m, ascending [m^2]
};

/// Exact volume integrals of a closed mesh, uniform density. Where components overlap their density adds up. Where they
/// do not enclose a (positive) volume, `volume` is 0 and the rest has no meaning.
MassMoments moments_of_volume(const TriangleMesh& closed_mesh);

/// Equal masses at the points (at least one).
MassMoments moments_of_points(std::span<const Eigen::Vector3d> points);

/// Principal axes of J / m. Where moments are equal (to 1e-5 of the largest) any axes would do: then those nearest to
/// M's own are taken, so that a cube keeps its frame. An axis' largest component is positive, but for the third one's,
/// which makes the frame right-handed.
PrincipalAxes principal_axes(const Eigen::Matrix3d& inertia);

}  // namespace godobject::scene_compiler
