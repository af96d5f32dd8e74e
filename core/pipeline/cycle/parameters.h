#pragma once

#include <cstdint>
#include <limits>

#include "core/pipeline/cycle/work.h"
#include "core/scene/scene_view.h"
#include "core/spatial/bounding_sphere.h"
#include "godobject/pose.h"

namespace godobject {

/// The moving body's mass distribution for the solvers; the mass m itself cancels in every equation. The body frame B
/// lies on the principal axes, so inertia matrices are diagonal and the paper's R_BE, eq (9), is the identity.
struct MassModel {
  Vector3 inertia = Vector3::Ones();          ///< diagonal of J_B / m [m^2], at least 1e-2 of its largest
  Vector3 inverse_inertia = Vector3::Ones();  ///< [1/m^2]
  double sigma = 1.0;                         ///< eq (4): cube root of det(J_B / m) [m^2]
  Vector3 ellipsoid = Vector3::Ones();        ///< eq (11): squared semi-axes a_i^2 [m^2], clamped from below
  double radius = 1.0;                        ///< R_max: farthest sample point from the centre of mass [m]
  BoundingSphere sphere;  ///< around all sample points, in B; from `make`: about B's origin with R_max

  /// Returns the model for principal moments of J_B / m [m^2], in any order. `radius`: R_max [m]. `length` [m] replaces
  /// the extent of a body without any.
  static MassModel make(const Vector3& principal_inertia, double radius, double length) noexcept;
};

/// The friction coefficients of `corrected` and `contact`.
struct FrictionCoefficients {
  double static_ratio = 0.0;   ///< mu_s [1]
  double kinetic_ratio = 0.0;  ///< mu_k [1]
  double viscous = 0.0;        ///< mu_v [Ns/m] of slip at the contact
};

/// The coefficients of the paper's Algorithm 1: one set for translations, one for rotations.
struct PaperFriction {
  double translation_static = 0.0;   ///< [1]
  double translation_kinetic = 0.0;  ///< [1]
  double rotation_static = 0.0;      ///< [1]
  double rotation_kinetic = 0.0;     ///< [1]
  double viscous = 0.0;              ///< share of the perpendicular motion of one cycle [1]
};

/// The constants of a session, in SI units. The defaults are those of the scene file.
struct Parameters {
  double period = 1e-3;               ///< T [s]
  double safety_distance = 3e-3;      ///< d [m]
  double voxel_size = 2e-3;           ///< s [m]
  double margin = 2e-5;               ///< m: gap that `contact` maintains [m]
  double correction_gain = 0.2;       ///< eta of eq (28) [1]
  double stiffness = 2000.0;          ///< k_D [N/m]
  double damping = 20.0;              ///< b_D [Ns/m]
  double coupling_translation = 1.0;  ///< k_VC,x of eq (46) [1]
  double coupling_rotation = 0.025;   ///< k_VC,r of eq (46) [m^2]
  /// Most points of each direction that a sub-step of `contact` looks up exactly, beside those within the margin.
  std::uint32_t point_budget = std::numeric_limits<std::uint32_t>::max();
  /// Work of a cycle of `contact` after which it ends with the motion certified so far [units of WorkMeter].
  std::uint64_t work_budget = WorkMeter::kUnlimited;
  FrictionCoefficients friction;
  PaperFriction paper_friction;
  MassModel mass;
  WorkspaceBox workspace;  ///< in W

  /// Returns the parameters of a scene.
  static Parameters make(const SceneView& scene) noexcept;
};

}  // namespace godobject
