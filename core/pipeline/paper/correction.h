#pragma once

#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/penalty/penalty_contacts.h"

namespace godobject {

/// The result of step #2 of `paper`: the motion that removes the penetration, and the constrained directions. In S.
struct Correction {
  Vector3 u_x = Vector3::Zero();  ///< constrained direction of translation, eq (5); zero if there is no force
  Vector3 u_r = Vector3::Zero();  ///< constrained axis of rotation, eq (5); zero if there is no torque
  Motion delta;                   ///< Delta x_p [m], Delta r_p [rad] of eq (7): removes p or, if p < 0, reaches contact
  double penetration = 0.0;       ///< p of eq (6) [m]: p_d - d
  double lever = 0.0;             ///< delta of eq (6) [m]
  double rotation_radius = 0.0;   ///< r of eq (13) [m]
  double distribution = 0.0;      ///< lambda of eq (27) [1]
};

/// Returns the correction by equations (5)-(27) as printed, in S. `safety_distance`: d [m]. Corrected: (14) and a clamp
/// in (11). Known errors that remain for comparison: (12), (16), (20)-(27), see core/README.md. Every division is
/// guarded: without force there is no constraint, without torque no rotation. Real-time safe.
Correction correction(const PenaltyContacts& contacts, double safety_distance, const MassModel& mass) noexcept;

}  // namespace godobject
