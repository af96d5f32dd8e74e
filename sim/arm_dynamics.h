#pragma once

#include <array>

#include "core/device/arm_model.h"

namespace godobject::sim {

/// Geometry and mass matrix of an arm at one posture. Vectors and matrices are on the axes of the room R and about the
/// origin of the base A, so an arm far from R's origin loses no digits. Links count from the base; the last one carries
/// the payload.
struct ArmPosture {
  std::array<Vector3, kMaxJoints> axis_R;         ///< axis of joint i; (axis, moment) is its unit twist at A
  std::array<Vector3, kMaxJoints> moment_R;       ///< moment = origin x axis [m]
  std::array<Vector3, kMaxJoints> mass_moment_R;  ///< mass of link i times its centre of mass [kg m]
  std::array<Matrix3, kMaxJoints> inertia_R;      ///< inertia of link i about A [kg m^2]
  Matrix3 R_RM;
  Vector3 p_AM_R;
  JointMatrix mass;  ///< M(q), rotors included; zero from the joint count on [kg m^2]
};

/// Dynamics of the simulated arm by Newton and Euler. It shares numbers with the controller, but no code. Featherstone,
/// *Rigid Body Dynamics Algorithms*: composite rigid bodies (ch. 6) and recursive Newton-Euler (ch. 5), in coordinates
/// fixed in space. All functions are real-time safe and do not allocate.
class ArmDynamics {
 public:
  /// `model`: accepted by `validate`.
  explicit ArmDynamics(const ArmModel& model) noexcept;

  int joint_count() const noexcept { return joint_count_; }

  /// Fills `posture` for the positions q [rad]. Cost: 0.5 us for seven joints.
  void set_posture(const JointVector& q, ArmPosture& posture) const noexcept;

  /// Joint torques C(q, qd) qd + g(q) [Nm] that keep the joint velocities qd [rad/s] constant, without friction. With
  /// qd = 0 they hold the arm against gravity. Cost: 0.25 us for seven joints.
  JointVector bias_torque(const ArmPosture& posture, const JointVector& qd) const noexcept;

  /// H_RM: the pose of the tool.
  Pose tool_pose(const ArmPosture& posture) const noexcept;

  /// Velocity of M's origin [m/s] and angular velocity of the tool [rad/s], on the axes of R.
  Motion tool_velocity(const ArmPosture& posture, const JointVector& qd) const noexcept;

  /// Joint torques J^T F_M_R [Nm] of a wrench on the tool.
  JointVector tool_torque(const ArmPosture& posture, const Wrench& F_M_R) const noexcept;

  /// Energies [J]. The potential energy is zero with all mass at the base.
  double kinetic_energy(const ArmPosture& posture, const JointVector& qd) const noexcept;
  double potential_energy(const ArmPosture& posture) const noexcept;

 private:
  struct Link {
    double a, d, offset, sin_alpha, cos_alpha, rotor;
    LinkMass body;
  };

  int joint_count_;
  std::array<Link, kMaxJoints> links_;
  Matrix3 R_RA_;
  Vector3 p_RA_;
  Matrix3 R_FM_;
  Vector3 p_FM_;
  Vector3 gravity_R_;
};

/// Solves M x = b for the moving joints while the others are held: x is zero for held joints.
class MovingJoints {
 public:
  /// Factors M = L D L^T without the rows and columns of held joints. Cost: 0.1 us.
  void factor(const JointMatrix& mass, int joint_count, const std::array<bool, kMaxJoints>& held) noexcept;
  JointVector solve(const JointVector& b) const noexcept;

 private:
  int joint_count_ = 0;
  std::array<bool, kMaxJoints> held_{};
  JointMatrix lower_;    ///< L without the ones on its diagonal
  JointVector inverse_;  ///< inverse of D
};

}  // namespace godobject::sim
