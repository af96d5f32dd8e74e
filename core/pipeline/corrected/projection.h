#pragma once

#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/penalty/penalty_contacts.h"

namespace godobject {

/// What the projection carries from cycle to cycle.
struct ProjectionState {
  bool slipping = false;    ///< the contact slid
  double relaxation = 1.0;  ///< share of the constrained motion that is taken, see `project`
  Motion wanted;            ///< the constrained motion before that share, in S; zero without contact
};

/// How far `corrected` lets the god object follow.
struct Projection {
  Motion motion;         ///< in S
  bool cut = false;      ///< it was shortened so as not to jump over the surface
  ProjectionState next;  ///< for the next cycle
};

/// Friction of `project`. viscous_step is mu_v / (k_D k_VC,x T) [1].
struct ProjectionFriction {
  double static_ratio = 0.0;
  double kinetic_ratio = 0.0;
  double viscous_step = 0.0;
};

/// Steps #2-#4 of `corrected` in one closed-form projection, from f_P, t_P, p_d and d alone; `friction` null: none.
///
/// With u = f/|f|, tau = t/|f| and the row w = (u, tau), the motion xi = (x, r) nearest to the unconstrained one in the
/// metric of the body's mass that keeps w xi >= eta p (region A) or w xi >= p (region B, p < 0 is the way left):
///     nu = max(0, -(w xi + g)) / a,  a = 1 + tau' Jh^-1 tau,  g = p > 0 ? -eta p : -p,  xi += nu (u, Jh^-1 tau)
/// It replaces eq (7)-(42): it removes exactly p, whatever the lever, a central contact included, and needs no
/// ellipsoid.
///
/// Friction, Coulomb and viscous, acts at rc = u x tau, the point of the force line nearest to the centre of mass.
/// Stick is tested exactly (normal and both tangents at once, 3 x 3); if the force lies outside the cone of mu_s (mu_k
/// if the contact was slipping), it slides with mu_k, by a bounded iteration.
///
/// Two things keep the linear row honest. *Relaxation*: u and tau move with the body, and a body pressed deeper than
/// J / (shift of the contact point per radian) would swing from side to side for ever; so when the wanted motion
/// reverses, half of the share taken last is taken, and the share grows back slowly otherwise. *Room*: no point moves
/// farther at once than d/2 and the way to the safety layer (region C); the caller goes on from there. Both scale the
/// motion as a whole, so a contact that sticks goes on sticking; the normal row is then restored by a translation along
/// u.
///
/// Contacts that oppose each other may leave no force to constrain by: then the motion is shortened to half of what is
/// left of the safety layer, but not below a hundredth of the layer, or the body could never leave.
Projection project(const Motion& unconstrained, const PenaltyContacts& contacts, double safety_distance, double gain,
                   const MassModel& mass, const ProjectionFriction* friction, const ProjectionState& before) noexcept;

}  // namespace godobject
