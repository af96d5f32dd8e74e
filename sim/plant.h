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

  void add(double seconds, const PlantWork& power) noexcept;
};

/// What is put on the joints from outside for the length of a step [Nm].
struct JointLoad {
  JointVector motor = JointVector::Zero();
  JointVector brake = JointVector::Zero();  ///< largest torque that a brake holds or slows its joint with
};

/// Arm and hand, integrated: classic Runge-Kutta-Nystroem of fourth order. Viscous friction is the arm model's.
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

  /// One step of the integration, 1 ns to `kStep_ns`. Cost: 4 us for seven joints with a hand.
  void step(std::int64_t duration_ns, const JointLoad& load) noexcept;

  /// A wrench on the tool about M's origin, in W, until it is set anew.
  void set_tool_load(const Wrench& wrench_W) noexcept { tool_load_W_ = wrench_W; }
  void set_velocity(const JointVector& qd) noexcept { qd_ = qd; }

  const JointVector& positions() const noexcept { return q_; }
  const JointVector& velocities() const noexcept { return qd_; }
  const ArmDynamics& arm() const noexcept { return arm_; }
  const ArmPosture& posture() const noexcept { return posture_; }
  BodyState tool() const noexcept { return tool(posture_, qd_); }
  const BodyState& hand() const noexcept { return hand_state_; }
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
  struct Instant {
    const ArmPosture& posture;
    const JointVector& qd;
    const BodyState& hand;
    const BodyState& target;
  };
  struct Rates {
    JointVector qdd = JointVector::Zero();
    Motion hand;  ///< accelerations
    PlantWork power;
  };

  BodyState tool(const ArmPosture& posture, const JointVector& qd) const noexcept;
  JointVector applied_torque(const Instant& instant, const JointVector& motor, Rates& rates) const noexcept;
  Stick find_stick(double seconds, const JointVector& applied, const JointVector& capacity, JointVector& qdd) noexcept;
  JointVector accelerations(const ArmPosture& posture, const JointVector& applied, const Stick& stick) const noexcept;
  double dry_power(const Instant& instant, const JointVector& applied, const Stick& stick,
                   const JointVector& qdd) const noexcept;
  Rates rates(const Instant& instant, const JointVector& motor, const Stick& stick) const noexcept;

  ArmDynamics arm_;
  OperatorHand hand_;
  JointVector damping_ = JointVector::Zero();
  JointVector dry_friction_;
  Wrench tool_load_W_;
  Wrench carried_W_;  ///< with a rigid grip: the hand's weight, which its own arm carries

  std::int64_t now_ns_ = 0;
  JointVector q_;
  JointVector qd_ = JointVector::Zero();
  BodyState hand_state_;
  BodyState target_;
  ArmPosture posture_;  ///< of q_
  PlantWork work_;

  ArmPosture stage_posture_;
  MovingJoints moving_;
  JointVector last_slip_torque_ = JointVector::Zero();
};

}  // namespace godobject::sim
