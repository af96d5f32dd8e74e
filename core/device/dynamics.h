#pragma once

#include "core/device/kinematics.h"

namespace godobject {

/// Joint torques [Nm] that hold the arm and its payload against gravity, the gradient of their potential energy.
/// One pass from the tool to the base. Cost: 200 ns for seven joints. Real-time safe.
JointVector gravity_torque(const ArmModel& model, const ArmKinematics& kinematics) noexcept;

/// M(q) [kg m^2] by composite rigid bodies, payload and rotor inertias included; symmetric, positive definite in the
/// joints that there are, zero elsewhere. Cost: below 1 us for seven joints. Real-time safe.
JointMatrix mass_matrix(const ArmModel& model, const ArmKinematics& kinematics) noexcept;

}  // namespace godobject
