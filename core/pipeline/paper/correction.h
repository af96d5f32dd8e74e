#pragma once

#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/penalty/penalty_contacts.h"

namespace godobject {

/// Step #2 of `paper`: how the god object leaves its penetration, and the directions it is constrained in.
struct Correction {
  Vector3 u_x = Vector3::Zero();  ///< constrained direction of translation, eq (5); zero if there is no force
  Vector3 u_r = Vector3::Zero();  ///< constrained axis of rotation, eq (5); zero if there is no torque
  Motion delta;                   ///< Delta x_p [m], Delta r_p [rad] of eq (7): removes p, or (p < 0) reaches contact
  double penetration = 0.0;       ///< p of eq (6) [m]: p_d - d
  double lever = 0.0;             ///< delta of eq (6) [m]
  double rotation_radius = 0.0;   ///< r of eq (13) [m]
  double distribution = 0.0;      ///< lambda of eq (27) [1]
};

/// Equations (5)-(27) as printed, in S. Mended: (14) and a clamp in (11); kept although wrong: (12), (16), (20)-(27),
/// see core/README.md. Every division is guarded: without force nothing is constrained, without torque nothing turns.
Correction correction(const PenaltyContacts& contacts, double safety_distance, const MassModel& mass) noexcept;

}  // namespace godobject
