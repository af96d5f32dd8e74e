#include "core/pipeline/cycle/parameters.h"

#include <algorithm>
#include <cmath>

namespace godobject {

MassModel MassModel::make(const Vector3& principal_inertia, double radius, double length) noexcept {
  // Chosen: a needle's spin inertia is nearly zero, and u_r = J^-1 u_t would turn every torque into spin about its
  // axis. A hundredth is the spin inertia of a round rod twelve times as long as thick.
  constexpr double kInertiaFloor = 1e-2;
  constexpr double kExtentFloor = 1e-3;     // of `length`, chosen: gives points and lines an inertia above zero
  constexpr double kEllipsoidFloor = 1e-6;  // of the largest a_i^2, chosen: a flat body's axis is a thousandth of it
  const double smallest =
      std::max(kInertiaFloor * principal_inertia.maxCoeff(), kExtentFloor * length * kExtentFloor * length);

  MassModel mass;
  mass.radius = radius;
  mass.sphere = {Vector3::Zero(), radius};
  mass.inertia = principal_inertia.cwiseMax(smallest);
  mass.inverse_inertia = mass.inertia.cwiseInverse();
  mass.sigma = std::cbrt(mass.inertia.prod());                                                    // (4)
  mass.ellipsoid = 2.5 * (Vector3::Constant(principal_inertia.sum()) - 2.0 * principal_inertia);  // (11)
  mass.ellipsoid =
      mass.ellipsoid.cwiseMax(std::max(kEllipsoidFloor * mass.ellipsoid.maxCoeff(), smallest * kEllipsoidFloor));
  return mass;
}

Parameters Parameters::make(const SceneView& scene) noexcept {
  const format::Settings& s = scene.settings;
  Parameters p;
  p.period = s.period;
  p.safety_distance = s.safety_distance;
  p.voxel_size = scene.grid.voxel_size;
  p.margin = s.margin;
  p.stiffness = s.stiffness;
  p.damping = s.damping;
  p.coupling_translation = s.coupling_translation;
  p.coupling_rotation = s.coupling_rotation;
  if (s.point_budget > 0) p.point_budget = s.point_budget;
  p.friction = {s.friction_static, s.friction_kinetic, s.friction_viscous};
  p.paper_friction = {s.friction_static, s.friction_kinetic, s.paper_rotation_static, s.paper_rotation_kinetic,
                      s.paper_viscous};
  p.mass = MassModel::make(Vector3(scene.body.inertia[0], scene.body.inertia[1], scene.body.inertia[2]),
                           scene.body.radius, std::max(scene.body.radius, scene.grid.voxel_size));
  p.mass.sphere = sphere_of(scene.body);
  p.workspace = scene.workspace;
  return p;
}

}  // namespace godobject
