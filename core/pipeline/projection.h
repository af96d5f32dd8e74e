#pragma once

#include "core/pipeline/parameters.h"
#include "core/pipeline/penalty_contacts.h"

namespace godobject {

/// How far `corrected` let the god object follow.
struct Projection {
  Motion motion;          ///< from S(k-1), in S
  bool cut = false;       ///< it was shortened so as not to jump over the surface
  bool slipping = false;  ///< friction's state for the next cycle: the contact slides
};

/// Coefficients of `project` that friction adds. viscous_step is mu_v / (k_D k_VC,x T) [1].
struct ProjectionFriction {
  double static_ratio = 0.0;
  double kinetic_ratio = 0.0;
  double viscous_step = 0.0;
};

/// Steps #2-#4 of `corrected` in one closed-form projection, from f_P, t_P, p_d and d alone.
///
/// With u = f/|f|, tau = t/|f| and the row w = (u, tau), the motion xi = (x, r) nearest to the unconstrained one in the
/// metric of the body's mass that keeps w xi >= eta p (region A) or w xi >= p (region B, p < 0 is the way left):
///     nu = max(0, -(w xi + g)) / a,  a = 1 + tau' Jh^-1 tau,  g = p > 0 ? -eta p : -p,  xi += nu (u, Jh^-1 tau)
/// It replaces eq (7)-(42): it removes exactly p, whatever the lever, a central contact included, and needs no
/// ellipsoid. Region C (p_d < 0): the motion is shortened to |x| + R_max |r| <= -p_d + d/2: it may enter the safety
/// layer, not the body. Opposing contacts may leave no force to constrain by: then the motion is shortened to what the
/// safety layer still holds.
Projection project(const Motion& unconstrained, const PenaltyContacts& contacts, double safety_distance, double gain,
                   const MassModel& mass) noexcept;

/// The same with Coulomb and viscous friction at rc = u x tau, the point of the force line nearest to the centre of
/// mass. Stick is tested exactly (normal and both tangents at once, 3 x 3); if the force lies outside the cone of mu_s
/// (mu_k if `was_slipping`), the contact slides with mu_k.
Projection project_with_friction(const Motion& unconstrained, const PenaltyContacts& contacts, double safety_distance,
                                 double gain, const MassModel& mass, const ProjectionFriction& friction,
                                 bool was_slipping) noexcept;

}  // namespace godobject
