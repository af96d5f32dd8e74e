#pragma once

#include "core/device/kinematics.h"

namespace godobject {

// Exact stability of the sampled loop, for checks at the start. These functions allocate and take milliseconds. They
// are a library of their own, `godobject::arm_stability`, and not part of the core's archive.
//
// The loop: positions are sampled every T. The input u = -K x - B v reaches the plant t_d later and is held for T; v is
// the velocity estimate of `VelocityEstimator`. The plant M qdd + D qd = u moves in continuous time. Plant, hold and
// delay are discretised exactly, also where the delay has a fraction of a period: by matrix exponentials of the parts
// of a period before and after the change of u. The loop is stable if the spectral radius of the map from one period to
// the next is below 1.

struct LoopTiming {
  double period = 1e-3;     ///< T [s]
  double delay = 1e-3;      ///< t_d: from the sample to the torque, without half a period of hold [s]
  int velocity_window = 2;  ///< N of `VelocityEstimator`; 2 is the plain difference
};

/// One degree of freedom: a mass on a virtual spring and damper.
struct AxisLoop {
  double mass = 1.0;             ///< m [kg]
  double damping = 0.0;          ///< b: damping of the device [Ns/m]
  double virtual_damping = 0.0;  ///< B [Ns/m]
  LoopTiming timing;
};

/// An arm at one posture, held by a virtual spring and damper at its tool: the virtual coupling of step #7.
struct ArmLoop {
  int joint_count = 0;
  JointMatrix mass = JointMatrix::Zero();     ///< M(q) [kg m^2]
  JointVector damping = JointVector::Zero();  ///< viscous friction of the joints [Nms/rad]
  Jacobian jacobian = Jacobian::Zero();       ///< at the point of the spring
  double stiffness = 0.0;                     ///< k [N/m]
  double rotation_stiffness = 0.0;            ///< k_r [Nm/rad]
  double tool_damping = 0.0;                  ///< B [Ns/m]
  double rotation_tool_damping = 0.0;         ///< B_r [Nms/rad]
  LoopTiming timing;
};

/// Spectral radius of the loop: its largest eigenvalue modulus. Infinity if a number is not finite, the mass matrix is
/// not positive definite or the timing is impossible. The states hold the velocities, but not the positions, of motions
/// that leave the tool at rest: without joint damping a redundant arm has a radius of 1.
double spectral_radius(const ArmLoop& loop) noexcept;

/// Largest factor on both stiffnesses with a spectral radius below 1, to a relative 1e-6. 0 if a thousandth of them is
/// already unstable, or if both are zero.
double stiffness_margin(const ArmLoop& loop) noexcept;

/// Smallest eigenvalue of D - (T/2 + t_d) J^T K J [Nms/rad]. If it is positive, the loop without virtual damping is
/// passive by the linear rule.
double passivity_excess(const ArmLoop& loop) noexcept;

/// Largest stiffness K [N/m] with a spectral radius below 1, to a relative 1e-6. 0 if no stiffness is stable.
double stability_boundary(const AxisLoop& loop) noexcept;

/// Largest damping B [Ns/m] with which the softest spring is stable, to a relative 1e-6. Ignores the loop's
/// `virtual_damping`.
double damping_boundary(const AxisLoop& loop) noexcept;

}  // namespace godobject
