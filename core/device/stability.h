#pragma once

#include "core/device/kinematics.h"

namespace godobject {

// Exact stability of the sampled loop. Start-up and configuration checks only: this allocates and takes milliseconds;
// it is a library of its own, `godobject::arm_stability`, and no part of the core's archive.
//
// The loop: positions are sampled every T; u = -K x - B v goes to the plant t_d later and is held for T, where v is the
// velocity estimate of `VelocityEstimator`. The plant M qdd + D qd = u moves in continuous time. Plant, hold and delay,
// a fraction of a period included, are discretised exactly (matrix exponentials of the parts of a period before and
// after the change of u); the loop is stable if the spectral radius of what takes one period to the next is below 1.

struct LoopTiming {
  double period = 1e-3;     ///< T [s]
  double delay = 1e-3;      ///< t_d: from the sample to the torque, without the hold's half period [s]
  int velocity_window = 2;  ///< N of `VelocityEstimator`; 2 is the plain difference
};

/// One degree of freedom: a mass on a virtual spring and damper.
struct AxisLoop {
  double mass = 1.0;             ///< m [kg]
  double damping = 0.0;          ///< b, of the device [Ns/m]
  double virtual_damping = 0.0;  ///< B [Ns/m]
  LoopTiming timing;
};

/// An arm at one posture, held by a virtual spring and damper at its tool: the coupling of step #7.
struct ArmLoop {
  int joint_count = 0;
  JointMatrix mass = JointMatrix::Zero();     ///< M(q) [kg m^2]
  JointVector damping = JointVector::Zero();  ///< of the joints [Nms/rad]
  Jacobian jacobian = Jacobian::Zero();       ///< at the point of the spring
  double stiffness = 0.0;                     ///< k [N/m]
  double rotation_stiffness = 0.0;            ///< k_r [Nm/rad]
  double tool_damping = 0.0;                  ///< B [Ns/m]
  double rotation_tool_damping = 0.0;         ///< B_r [Nms/rad]
  LoopTiming timing;
};

/// Largest eigenvalue modulus of the loop; infinity where a number is not finite, the mass matrix not positive
/// definite or the timing impossible. Positions of motions that leave the tool at rest are left out, their velocities
/// are not: without joint damping a redundant arm has a radius of 1.
double spectral_radius(const ArmLoop& loop) noexcept;

/// Largest factor by which both stiffnesses may be multiplied before the spectral radius reaches 1, to 1e-6 of it;
/// 0 if a thousandth of them is already unstable or there are none.
double stiffness_margin(const ArmLoop& loop) noexcept;

/// Smallest eigenvalue of D - (T/2 + t_d) J^T K J [Nms/rad]: where it is positive the loop without virtual damping is
/// passive, by the linear rule.
double passivity_excess(const ArmLoop& loop) noexcept;

/// Largest K [N/m] with a spectral radius below 1, to 1e-6 of it; 0 if no stiffness is stable.
double stability_boundary(const AxisLoop& loop) noexcept;

/// Largest B [Ns/m] with which the softest spring is stable, to 1e-6 of it (`virtual_damping` of the loop is not used).
double damping_boundary(const AxisLoop& loop) noexcept;

}  // namespace godobject
