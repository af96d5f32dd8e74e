#pragma once

#include <array>

#include "core/device/joint_vector.h"
#include "godobject/pose.h"
#include "godobject/status.h"

namespace godobject {

using JointMatrix = Eigen::Matrix<double, kMaxJoints, kMaxJoints>;

/// Mass, centre of mass and inertia tensor of a rigid body, in the body's own frame.
struct LinkMass {
  double mass = 0.0;                  ///< [kg]
  Vector3 com = Vector3::Zero();      ///< centre of mass [m]
  Matrix3 inertia = Matrix3::Zero();  ///< about `com` [kg m^2]
};

/// A revolute joint and the link that it moves. Modified Denavit-Hartenberg parameters (Craig, *Introduction to
/// Robotics*, eq (3.6)): the pose of the link's frame L_i in the frame of the link before is
/// Rot_x(alpha) Trans_x(a) Rot_z(offset + q) Trans_z(d), so q turns about the z axis of L_i.
struct ArmJoint {
  double a = 0.0;       ///< [m]
  double alpha = 0.0;   ///< [rad]
  double d = 0.0;       ///< [m]
  double offset = 0.0;  ///< [rad]
  double lower = 0.0;   ///< position limits [rad]
  double upper = 0.0;
  double velocity = 0.0;  ///< speed limit [rad/s]
  double torque = 0.0;    ///< torque limit [Nm]
  double rotor = 0.0;     ///< motor inertia at the joint: rotor inertia times gear ratio squared [kg m^2]
  double damping = 0.0;   ///< viscous friction of the joint [Nms/rad]
  LinkMass link;          ///< in L_i
};

/// A serial arm of 1 to `kMaxJoints` revolute joints in the room R. A is its base, F (flange) the frame of the last
/// link, M the frame of the held body: the moving mesh.
struct ArmModel {
  int joint_count = 0;
  std::array<ArmJoint, kMaxJoints> joints;
  Pose H_RA;                                     ///< base in the room
  Vector3 gravity_R = Vector3(0.0, 0.0, -9.81);  ///< [m/s^2]
  Pose H_FM;                                     ///< held body in the flange
  LinkMass payload;                              ///< of the held body, in M; mass 0: none
};

/// Checks that the numbers describe a possible arm. Every function on an ArmModel relies on this check.
/// `kNotFinite`: a number is not finite. `kArmShape`: the joint count, or a rotation that is not of unit length (1e-6).
/// `kArmMass`: a link without mass, a negative payload, rotor inertia or damping, or an impossible inertia tensor: it
/// must be symmetric and positive semidefinite, with no principal moment larger than the sum of the other two, all to a
/// millionth of its largest element.
/// `kArmLimits`: lower limit not below the upper one, velocity or torque limit not positive.
/// Cost: at start-up, microseconds.
Status validate(const ArmModel& model) noexcept;

}  // namespace godobject
