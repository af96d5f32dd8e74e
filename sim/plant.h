#pragma once

#include <array>
#include <cstdint>

#include "sim/arm_dynamics.h"
#include "sim/operator_hand.h"

namespace godobject::sim {

/// Work since the start [J].
struct PlantWork {
  JointVector motor = JointVector::Zero();  ///< of each motor on its joint
  /// Of the hand on the tool, split by the axes of W: forces along x, y, z, then torques about them.
  Eigen::Matrix<double, 6, 1> hand = Eigen::Matrix<double, 6, 1>::Zero();
  /// Of the operator's arm on the hand: the target's spring and damper. With a rigid grip the hand is part of the tool,
  /// this is the sum of `hand`, and what carries the hand's weight is in both.
  double operator_arm = 0.0;
  double load = 0.0;      ///< of the load on the tool
  double friction = 0.0;  ///< of viscous and dry friction and of brakes; what they take is negative
};

/// What is put on the joints from outside for the length of a step [Nm].
struct JointLoad {
  JointVector motor = JointVector::Zero();
  JointVector brake = JointVector::Zero();  ///< largest torque that a brake holds or slows its joint with
};

/// Arm and hand, integrated by the position Verlet rule: positions drift to the middle of the step, the forces there,
/// with velocities predicted by those at its begin, act for the whole of it, positions drift on. Of second order; it
/// neither gains nor loses energy in the long run, and takes one mass matrix a step. Work is force times way: what
/// changes the kinetic energy to the last digits. Viscous friction is the arm model's.
///
/// Dry friction and brakes are Coulomb's law, exact in stick: within a step a joint either slips one way the whole
/// step, or it is brought to rest by the end of it and stays there as long as the torque that this takes is within
/// reach. So it neither creeps nor chatters. Everything is real-time safe and allocates nothing.
class Plant {
 public:
  /// Longest step; the springs of a grip and a hand's mass are stable with it.
  static constexpr std::int64_t kStep_ns = 100'000;

  /// At rest at q, the hand where the tool is, time zero. `dry_friction` [Nm].
  Plant(const ArmModel& model, const JointVector& q, const JointVector& dry_friction = JointVector::Zero(),
        const OperatorHand& hand = {}) noexcept;

  int joint_count() const noexcept { return arm_.joint_count(); }
  std::int64_t now_ns() const noexcept { return now_ns_; }

  /// One step of the integration, 1 ns to `kStep_ns`. Cost: 15,000 instructions for seven joints with
  /// a hand.
  void step(std::int64_t duration_ns, const JointLoad& load) noexcept;

  /// A wrench on the tool about M's origin, in W, until it is set anew.
  void set_tool_load(const Wrench& wrench_W) noexcept { tool_load_W_ = wrench_W; }
  void set_velocity(const JointVector& qd) noexcept { qd_ = qd; }

  const JointVector& positions() const noexcept { return q_; }
  const JointVector& velocities() const noexcept { return qd_; }
  const ArmDynamics& arm() const noexcept { return arm_; }
  ArmPosture posture() const noexcept;
  BodyState tool() const noexcept { return tool(posture(), qd_); }
  BodyState hand() const noexcept;  ///< unless a spring is between them, where the tool is
  const PlantWork& work() const noexcept { return work_; }

  /// Torques that would hold the arm, without the hand, against gravity [Nm].
  JointVector gravity_torque() const noexcept;

  /// Kinetic and potential [J]; with a rigid grip the hand's mass is in it.
  double arm_energy() const noexcept;

  /// Of the hand's springs and, unless the grip is rigid, of its mass [J].
  double hand_energy() const noexcept;

 private:
  /// Joints that are at rest, or come to it by the end of the step.
  struct Stick {
    bool is_dry = false;  ///< there is dry friction at all
    std::array<bool, kMaxJoints> held{};
    JointVector acceleration = JointVector::Zero();  ///< of the held joints
    JointVector slip_torque = JointVector::Zero();   ///< of dry friction on the others
  };
  struct Forces {
    JointVector applied;  ///< on the joints: all but dry friction's, inertial ones included
    JointVector viscous;  ///< friction's part of it
    HandWrenches hand;    ///< with what carries its weight
    Motion hand_acceleration;
  };

  BodyState tool(const ArmPosture& posture, const JointVector& qd) const noexcept;
  Forces forces(const JointVector& qd, const BodyState& hand, const BodyState& target,
                const JointVector& motor) const noexcept;
  Stick find_stick(double seconds, const JointVector& applied, const JointVector& capacity, JointVector& qdd) noexcept;
  JointVector accelerations(const JointVector& applied, const Stick& stick) const noexcept;
  double dry_work(const JointVector& applied, const Stick& stick, const JointVector& qdd,
                  const JointVector& way) const noexcept;
  void add_work(const Forces& forces, const JointVector& motor, const JointVector& way,
                const Motion& hand_way) noexcept;

  ArmDynamics arm_;
  OperatorHand hand_;
  JointVector damping_ = JointVector::Zero();
  JointVector dry_friction_;
  Wrench tool_load_W_;
  Wrench carried_W_;  ///< with a rigid grip: the hand's weight, which its own arm carries

  std::int64_t now_ns_ = 0;
  JointVector q_;
  JointVector qd_ = JointVector::Zero();
  BodyState hand_state_;  ///< with a spring grip
  PlantWork work_;

  ArmPosture posture_;  ///< in the middle of a step
  MovingJoints moving_;
  JointVector last_slip_torque_ = JointVector::Zero();
};

}  // namespace godobject::sim
