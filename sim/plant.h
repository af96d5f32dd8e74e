#pragma once

#include <array>
#include <cstdint>

#include "sim/arm_dynamics.h"
#include "sim/operator_hand.h"

namespace godobject::sim {

/// Work of each part since the start [J].
struct PlantWork {
  JointVector motor = JointVector::Zero();  ///< of the motors on their joints
  /// Of the hand on the tool, by axes of R: forces along x, y, z, then torques about them.
  Eigen::Matrix<double, 6, 1> hand = Eigen::Matrix<double, 6, 1>::Zero();
  /// Of the operator's arm on the hand, through the target's spring and damper. With a rigid grip the hand is part of
  /// the tool: then this is the sum of `hand`, and both contain the work that carries the hand's weight.
  double operator_arm = 0.0;
  double load = 0.0;      ///< of `set_tool_load` on the tool
  double friction = 0.0;  ///< of viscous friction, dry friction and brakes; negative
};

/// Joint torques from outside, constant for a step [Nm].
struct JointLoad {
  JointVector motor = JointVector::Zero();
  JointVector brake = JointVector::Zero();  ///< largest torque of the brakes
};

/// The simulated arm and hand. Integration: position Verlet. Positions drift to the middle of the step; the forces
/// there, with velocities predicted from those at the beginning, act for the whole step; positions drift on. The method
/// is of second order, does not gain or lose energy in the long run, and takes one mass matrix a step. Work is force
/// times displacement, which equals the change of kinetic energy to the last digits. Viscous friction is the arm
/// model's.
///
/// Dry friction and brakes follow Coulomb's law, exactly in stick: within a step a joint either slips in one direction,
/// or friction brings it to rest by the end of the step and holds it there as long as the needed torque is within its
/// limit. So a joint neither creeps nor chatters. All functions are real-time safe and do not allocate.
class Plant {
 public:
  /// Longest step. Chosen, far below the bound 2 / omega of position Verlet: the stiffest default spring alone, a grip
  /// of 50 Nm/rad on a hand of 1e-3 kg m^2, has omega = 224 rad/s and a bound of 8.9 ms.
  static constexpr std::int64_t kStep_ns = 100'000;

  /// The arm at rest at q [rad], the hand at the tool, time zero. `dry_friction`: of the joints [Nm].
  Plant(const ArmModel& model, const JointVector& q, const JointVector& dry_friction = JointVector::Zero(),
        const OperatorHand& hand = {}) noexcept;

  int joint_count() const noexcept { return arm_.joint_count(); }
  std::int64_t now_ns() const noexcept { return now_ns_; }

  /// One step of the integration, 1 ns to `kStep_ns`. Cost: 15,000 instructions for seven joints with a hand.
  void step(std::int64_t duration_ns, const JointLoad& load) noexcept;

  /// Puts a wrench on the tool, until the next call.
  void set_tool_load(const Wrench& F_M_R) noexcept { tool_load_R_ = F_M_R; }
  void set_velocity(const JointVector& qd) noexcept { qd_ = qd; }
  /// As OperatorHand::steer.
  void steer_hand(const BodyState& target) noexcept { hand_.steer(target); }

  const JointVector& positions() const noexcept { return q_; }
  const JointVector& velocities() const noexcept { return qd_; }
  const ArmDynamics& arm() const noexcept { return arm_; }
  ArmPosture posture() const noexcept;
  BodyState tool() const noexcept { return tool(posture(), qd_); }
  BodyState hand() const noexcept;  ///< without a spring grip the tool's state
  const PlantWork& work() const noexcept { return work_; }

  /// Torques that hold the arm without the hand against gravity [Nm].
  JointVector gravity_torque() const noexcept;

  /// Kinetic and potential energy of the arm [J]; with a rigid grip including the hand's mass.
  double arm_energy() const noexcept;

  /// Energy of the hand's springs and, unless the grip is rigid, of its mass [J].
  double hand_energy() const noexcept;

 private:
  /// Joints that are at rest or reach it by the end of the step.
  struct Stick {
    bool is_dry = false;  ///< a joint has dry friction or a brake
    std::array<bool, kMaxJoints> held{};
    JointVector acceleration = JointVector::Zero();  ///< acceleration of the held joints
    JointVector slip_torque = JointVector::Zero();   ///< dry friction on the other joints
  };
  struct Forces {
    JointVector applied;  ///< torques on the joints, with inertial ones, without dry friction
    JointVector viscous;  ///< viscous friction's part of them
    HandWrenches hand;    ///< with the force that carries the hand's weight
    Motion hand_acceleration;
  };

  BodyState tool(const ArmPosture& posture, const JointVector& qd) const noexcept;
  Forces forces(const JointVector& qd, const BodyState& hand, const BodyState& target,
                const JointVector& motor) const noexcept;
  Stick find_stick(double seconds, const JointVector& applied, const JointVector& capacity, JointVector& qdd) noexcept;
  JointVector accelerations(const JointVector& applied, const Stick& stick) const noexcept;
  double dry_work(const JointVector& applied, const Stick& stick, const JointVector& qdd,
                  const JointVector& displacement) const noexcept;
  void add_work(const Forces& forces, const JointVector& motor, const JointVector& displacement,
                const Motion& hand_displacement) noexcept;

  ArmDynamics arm_;
  OperatorHand hand_;
  JointVector damping_ = JointVector::Zero();
  JointVector dry_friction_;
  Wrench tool_load_R_;
  Wrench carried_R_;  ///< with a rigid grip: the hand's weight, which the operator's arm carries

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
