#include "core/pipeline/paper/constrained_motion.h"

namespace godobject {

Vector3 constrained_motion(const Vector3& unconstrained, const Vector3& u, double delta, double penetration) noexcept {
  const SplitMotion motion = split(unconstrained, u);  // (34), (35)
  const double along = unconstrained.dot(u);
  if (along >= 0.0) return unconstrained;               // (37), (38), (39): away from the surface
  if (penetration >= 0.0) return motion.perpendicular;  // (38): region A
  if (-along <= delta) return unconstrained;            // (39): region B, short of contact
  return motion.perpendicular - delta * u;              // (39): as far as contact
}

Vector3 paper_friction(const Vector3& restricted, const Vector3& perpendicular, double mu_static, double mu_kinetic,
                       double mu_viscous) noexcept {
  const double normal = restricted.norm();
  const double tangential = perpendicular.norm();
  if (!(normal > 0.0)) return Vector3::Zero();                              // line 3
  if (tangential < mu_static * normal) return -perpendicular;               // line 6
  if (!(tangential > 0.0)) return Vector3::Zero();                          // mu_s = 0 at rest
  return -(mu_kinetic * normal / tangential + mu_viscous) * perpendicular;  // lines 9 and 11
}

}  // namespace godobject
