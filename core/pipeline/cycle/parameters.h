#pragma once

#include <cstdint>
#include <limits>

#include "core/scene/scene.h"
#include "core/spatial/bounding_sphere.h"
#include "godobject/pose.h"

namespace godobject {

/// Mass distribution of the moving body as the solvers use it; m itself drops out of every equation.
/// The body frame B lies on the principal axes, so inertia matrices are diagonals and the paper's R_BE, eq (9), is the
/// identity.
struct MassModel {
  Vector3 inertia = Vector3::Ones();          ///< diagonal of J_B / m [m^2], floored at 1e-2 of its largest
  Vector3 inverse_inertia = Vector3::Ones();  ///< [1/m^2]
  double sigma = 1.0;                         ///< eq (4): cube root of det(J_B / m) [m^2]
  Vector3 ellipsoid = Vector3::Ones();        ///< eq (11): squared semi-axes a_i^2 [m^2], clamped: a flat body has none
  double radius = 1.0;                        ///< R_max: farthest sample point from the centre of mass [m]
  BoundingSphere sphere;                      ///< around all sample points; `make` knows none better than R_max's

  /// From principal moments [m^2], ascending or not. `length` [m] stands in where the body has no extent at all.
  static MassModel make(const Vector3& principal_inertia, double radius, double length) noexcept;
};

/// Coefficients of the corrected friction: ratios, and Ns/m of slip at the contact.
struct FrictionCoefficients {
  double static_ratio = 0.0;
  double kinetic_ratio = 0.0;
  double viscous = 0.0;
};

/// Coefficients of the paper's Algorithm 1: one set for translations, one for rotations.
struct PaperFriction {
  double translation_static = 0.0;
  double translation_kinetic = 0.0;
  double rotation_static = 0.0;
  double rotation_kinetic = 0.0;
  double viscous = 0.0;  ///< share of the perpendicular motion of one cycle [1]
};

/// All that is constant during a session. SI units.
struct Parameters {
  double period = 1e-3;               ///< T [s]
  double safety_distance = 3e-3;      ///< d [m]
  double voxel_size = 2e-3;           ///< s [m]
  double margin = 2e-5;               ///< m: gap that `contact` keeps [m]
  double correction_gain = 0.2;       ///< eta of eq (28) [1]
  double stiffness = 2000.0;          ///< k_D [N/m]
  double damping = 20.0;              ///< b_D [Ns/m]
  double coupling_translation = 1.0;  ///< k_VC,x of eq (46) [1]
  double coupling_rotation = 0.025;   ///< k_VC,r of eq (46) [m^2]
  /// Points of either direction that a sub-step of `contact` looks up one by one, those that touch aside.
  std::uint32_t point_budget = std::numeric_limits<std::uint32_t>::max();
  FrictionCoefficients friction;
  PaperFriction paper_friction;
  MassModel mass;
  WorkspaceBox workspace;

  static Parameters make(const Scene& scene) noexcept;
};

}  // namespace godobject
