#pragma once

#include "core/device/arm_model.h"
#include "core/device/joint_vector.h"

namespace godobject::report {

/// The two-sided coupling of step #7 between the tool and a fixed god object.
struct Coupling {
  double stiffness = 2000.0;        ///< k_D [N/m]
  double damping = 20.0;            ///< b_D [Ns/m]
  double rotation_stiffness = 6.0;  ///< k_D k_VC,r [Nm/rad]
  double rotation_damping = 0.06;   ///< b_D k_VC,r [Nms/rad]
};

/// Moves the joints of a simulated arm slowly back and forth along `way` (unit) about q, against the coupling's spring,
/// which is sampled every millisecond and acts `delay` [s] later. Returns the work that the hand supplies in a period
/// of the motion, over the energy that 1 Nms/rad absorbs there [Nms/rad]. The delay is rounded to 0.1 ms.
double work_along(const ArmModel& model, const JointVector& q, const JointVector& way, const Coupling& coupling,
                  double delay);

}  // namespace godobject::report
