#pragma once

#include "core/device/kinematics.h"

namespace godobject {

/// Joint torques [Nm] that hold the arm and its payload against gravity: the gradient of their potential energy, in one
/// pass from the tool to the base. Cost: 200 ns for seven joints. Real-time safe.
JointVector gravity_torque(const ArmModel& model, const ArmKinematics& kinematics) noexcept;

/// Mass matrix M(q) [kg m^2] by composite rigid bodies, with payload and rotor inertias. Symmetric and positive
/// definite in the arm's joints, zero elsewhere. Cost: below 1 us for seven joints. Real-time safe.
JointMatrix mass_matrix(const ArmModel& model, const ArmKinematics& kinematics) noexcept;

/// The generalized momentum of a moving arm, and the part of its change that its motion causes.
struct ArmMomentum {
  JointVector momentum = JointVector::Zero();  ///< p = M(q) qd [Nms]
  JointVector change = JointVector::Zero();    ///< dT/dq, T the kinetic energy: C(q, qd)^T qd [Nm]
};

/// Momentum of the arm at the joint velocities qd [rad/s]. With torques tau of the motors, and tau_e from outside,
/// dp/dt = tau + tau_e - gravity_torque - friction + change (Lagrange's equations). One pass over the links, without
/// the mass matrix: turning joint i by dq turns all bodies beyond it, and leaves the velocity of link i, so
/// dT/dq_i = -H_i . (S_i x V_i), with the spatial momentum H_i of all bodies beyond the joint, its unit twist S_i and
/// the twist V_i of its link. Cost: below 1 us for seven joints. Real-time safe.
ArmMomentum arm_momentum(const ArmModel& model, const ArmKinematics& kinematics, const JointVector& qd) noexcept;

}  // namespace godobject
