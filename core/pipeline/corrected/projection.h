#pragma once

#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/penalty/penalty_contacts.h"

namespace godobject {

/// The state that the projection carries from cycle to cycle.
struct ProjectionState {
  bool slipping = false;    ///< the contact slipped
  double relaxation = 1.0;  ///< share of the constrained motion that was taken, see `project` [1]
  Motion wanted;            ///< the constrained motion before relaxation, in S; zero without contact
};

/// The result of `project`.
struct Projection {
  Motion motion;         ///< of the god object, in S [m, rad]
  bool cut = false;      ///< the motion was shortened so as not to jump over the surface
  ProjectionState next;  ///< for the next cycle
};

/// The friction coefficients of `project`.
struct ProjectionFriction {
  double static_ratio = 0.0;   ///< mu_s [1]
  double kinetic_ratio = 0.0;  ///< mu_k [1]
  double viscous_step = 0.0;   ///< mu_v / (k_D k_VC,x T) [1]
};

/// Returns the constrained motion of `corrected`: steps #2-#4 in one closed-form projection, from f_P, t_P, p_d and d
/// alone. `unconstrained`: in S; `safety_distance`: d [m]; `gain`: eta [1]; `friction` null: none; `before`: the state
/// of the last sub-step. Real-time safe.
///
/// With u = f/|f|, tau = t/|f| and the row w = (u, tau), the result is the motion xi = (x, r) that is nearest to the
/// unconstrained one in the metric of the body's mass and satisfies w xi >= eta p (region A) or w xi >= p (region B,
/// where -p > 0 is the remaining distance):
///     nu = max(0, -(w xi + g)) / a,  a = 1 + tau' Jh^-1 tau,  g = p > 0 ? -eta p : -p,  xi += nu (u, Jh^-1 tau)
/// The projection replaces eq (7)-(42). With eta = 1 it removes exactly p for every lever, also for a central contact.
/// It needs no ellipsoid.
///
/// Friction, Coulomb and viscous, acts at rc = u x tau, the point of the force line nearest to the centre of mass.
/// Stick is tested exactly (normal and both tangents at once, 3 x 3). If the force lies outside the cone of mu_s (mu_k
/// if the contact was slipping), the contact slips with mu_k; a bounded iteration finds that motion.
///
/// Two measures account for the linearisation of the row. *Relaxation*: u and tau move with the body. A body pressed
/// deeper than J / (shift of the contact point per radian) would swing from side to side without end. So when the
/// wanted motion reverses, the share that is taken is halved; otherwise it grows back slowly. *Room*: no point is
/// displaced by more than d/2, in region C by more than d/2 plus the distance to the safety layer; the caller continues
/// from there. Both scale the whole motion, so a sticking contact still sticks. A translation along u then restores the
/// normal row.
///
/// Contacts that oppose each other may leave no direction to constrain. Then the motion is shortened to half of the
/// remaining safety layer, but not below a hundredth of the layer; otherwise the body could never leave.
Projection project(const Motion& unconstrained, const PenaltyContacts& contacts, double safety_distance, double gain,
                   const MassModel& mass, const ProjectionFriction* friction, const ProjectionState& before) noexcept;

}  // namespace godobject
