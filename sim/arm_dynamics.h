#pragma once

#include <array>

#include "core/device/arm_model.h"

namespace godobject::sim {

/// What an arm's positions alone decide. Vectors and matrices are on the axes of W and about the origin of the base A,
/// so that an arm far from W's origin loses no digits. Links count from the base; the last one carries the payload.
struct ArmPosture {
  std::array<Vector3, kMaxJoints> axis_W;         ///< of joint i: (axis, moment) is its unit twist at A,
  std::array<Vector3, kMaxJoints> moment_W;       ///< moment = origin x axis [m]
  std::array<Vector3, kMaxJoints> mass_moment_W;  ///< of link i: mass times centre of mass [kg m]
  std::array<Matrix3, kMaxJoints> inertia_W;      ///< of link i, about A [kg m^2]
  Matrix3 R_WM;
  Vector3 p_AM_W;
  JointMatrix mass;  ///< M(q), rotors included; zero from the joint count on [kg m^2]
};

/// Newton and Euler for a serial arm: the mechanics of the simulated device, with nothing of the controller's but the
/// numbers. Featherstone, *Rigid Body Dynamics Algorithms*: composite rigid bodies (ch. 6) and recursive Newton-Euler
/// (ch. 5), in coordinates fixed in space. Everything is real-time safe and allocates nothing.
class ArmDynamics {
 public:
  /// The model is one that `validate` accepts.
  explicit ArmDynamics(const ArmModel& model) noexcept;

  int joint_count() const noexcept { return joint_count_; }

  /// Cost: 0.5 us for seven joints.
  void set_posture(const JointVector& q, ArmPosture& posture) const noexcept;

  /// What holds the arm on its way at constant joint velocities qd [rad/s]: C(q, qd) qd + g(q) [Nm]; with qd = 0 it
  /// holds it against gravity. Friction is not in it. Cost: 0.25 us for seven joints.
  JointVector bias_torque(const ArmPosture& posture, const JointVector& qd) const noexcept;

  /// H_WM.
  Pose tool_pose(const ArmPosture& posture) const noexcept;

  /// Of M: its origin's velocity [m/s], angular velocity [rad/s], in W.
  Motion tool_velocity(const ArmPosture& posture, const JointVector& qd) const noexcept;

  /// J^T F [Nm] of a wrench on the tool about M's origin, in W.
  JointVector tool_torque(const ArmPosture& posture, const Wrench& wrench_W) const noexcept;

  /// [J]
  double kinetic_energy(const ArmPosture& posture, const JointVector& qd) const noexcept;
  double potential_energy(const ArmPosture& posture) const noexcept;  ///< zero with all mass at the base

 private:
  struct Link {
    double a, d, offset, sin_alpha, cos_alpha, rotor;
    LinkMass body;
  };

  int joint_count_;
  std::array<Link, kMaxJoints> links_;
  Matrix3 R_WA_;
  Vector3 p_WA_;
  Matrix3 R_FM_;
  Vector3 p_FM_;
  Vector3 gravity_W_;
};

/// Solves M x = b for the joints that move while others are held at rest: x is zero there.
class MovingJoints {
 public:
  /// Cholesky's factor of M without the rows and columns of held joints. Cost: 0.1 us.
  void factor(const JointMatrix& mass, int joint_count, const std::array<bool, kMaxJoints>& held) noexcept;
  JointVector solve(const JointVector& b) const noexcept;

 private:
  int joint_count_ = 0;
  std::array<bool, kMaxJoints> held_{};
  JointMatrix lower_;    ///< of L D L^T, without the ones on its diagonal
  JointVector inverse_;  ///< of D
};

}  // namespace godobject::sim
