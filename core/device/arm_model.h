#pragma once

#include <array>

#include "core/device/joint_vector.h"
#include "godobject/pose.h"
#include "godobject/status.h"

namespace godobject {

using JointMatrix = Eigen::Matrix<double, kMaxJoints, kMaxJoints>;

/// Mass, centre of mass and inertia tensor about the centre of mass of a rigid body, all in the body's own frame.
struct LinkMass {
  double mass = 0.0;                  ///< [kg]
  Vector3 com = Vector3::Zero();      ///< [m]
  Matrix3 inertia = Matrix3::Zero();  ///< about `com` [kg m^2]
};

/// A revolute joint and the link that it moves. Modified Denavit-Hartenberg parameters (Craig, *Introduction to
/// Robotics*, eq (3.6)): the link's frame L_i stands in the frame of the link before at
/// Rot_x(alpha) Trans_x(a) Rot_z(offset + q) Trans_z(d), so that q turns about the z axis of L_i.
struct ArmJoint {
  double a = 0.0;       ///< [m]
  double alpha = 0.0;   ///< [rad]
  double d = 0.0;       ///< [m]
  double offset = 0.0;  ///< [rad]
  double lower = 0.0;   ///< position limits [rad]
  double upper = 0.0;
  double velocity = 0.0;  ///< greatest speed [rad/s]
  double torque = 0.0;    ///< greatest torque [Nm]
  double rotor = 0.0;     ///< the motor's inertia at the joint: rotor inertia times gear ratio squared [kg m^2]
  double damping = 0.0;   ///< the joint's own viscous friction [Nms/rad]
  LinkMass link;          ///< in L_i
};

/// A serial arm of 1 to `kMaxJoints` revolute joints. A is its base, F (flange) the frame of the last link, M the frame
/// of what it holds: the moving mesh's.
struct ArmModel {
  int joint_count = 0;
  std::array<ArmJoint, kMaxJoints> joints;
  Pose H_WA;
  Vector3 gravity_W = Vector3(0.0, 0.0, -9.81);  ///< [m/s^2]
  Pose H_FM;
  LinkMass payload;  ///< in M; without mass there is none
};

/// Whether the numbers can be an arm's. Every function on an ArmModel relies on it.
/// `kNotFinite`: one of them is not. `kArmShape`: joint count, or a rotation that is not of unit length (1e-6).
/// `kArmMass`: a link without mass, a negative payload, rotor inertia or damping, or an inertia tensor that no body
/// has: it must be symmetric, positive semidefinite, and no principal moment larger than the sum of the other two.
/// `kArmLimits`: lower limit not below the upper one, velocity or torque limit not positive.
/// Cost: at start-up, microseconds.
Status validate(const ArmModel& model) noexcept;

}  // namespace godobject
