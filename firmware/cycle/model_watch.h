#pragma once

#include <cstdint>

#include "core/device/external_torque.h"
#include "firmware/cycle/cycles_in.h"
#include "hal/joint_drives.h"

namespace godobject::firmware {

/// Compares an arm under power with its model: the torque that acts on it from outside, and the torques that its drives
/// measure. A hand, a wrong payload and a fault all act from outside. The watch tells wrong masses from the others as
/// far as physics allows: their torque is that of weights, and it stays the same along a way.
///
/// The constants are chosen. Their comments give reasons, and what fails with other values.
class ModelWatch {
 public:
  /// Bandwidth of the observer [1/s]: a torque is seen after 20 ms, and the encoders' steps do not show.
  static constexpr double kBandwidth = 50.0;
  /// Load at the tool whose torque counts as that of wrong masses [kg]. A hand that moves the arm evenly against its
  /// viscous friction pushes with less.
  static constexpr double kLeastLoad = 0.08;
  /// Share of the external torque that a weight at the tool and a factor on all weights may leave unexplained.
  static constexpr double kUnexplained = 0.25;
  /// Change of the external torque that still counts as constant: share of its size. The torque of a weight changes by
  /// less on the ways below, and a hand that speeds up and slows down changes its own by more. With 0.15 an arm with a
  /// lighter payload, whose elbow swings, is not found.
  static constexpr double kSteady = 0.25;
  /// Ways of the tool under a constant torque of wrong masses, and the least times that they take, that are a drift:
  /// while it renders or is led out of an object, and before. A hand that swings the tool pushes evenly for a shorter
  /// time: with 300 ms in place of 400 one is stopped, and with 150 in place of 200 one that leads the tool out of a
  /// contact.
  static constexpr double kDrift = 0.1;  // [m]
  static constexpr std::uint32_t kDrift_ms = 400;
  static constexpr double kEarlyDrift = 0.01;
  static constexpr std::uint32_t kEarlyDrift_ms = 200;
  /// Time after a period without a cycle in which the estimate settles, three time constants: a late sample looks like
  /// a push [ms].
  static constexpr std::uint32_t kSettle_ms = 60;
  /// Difference between measured and sent torque that is an error: share of the joint's limit.
  static constexpr double kTorqueError = 0.1;
  /// Duration of such a difference [ms], at least kTorqueCycles. A drive may filter the torque that it measures with a
  /// time constant of 20 ms.
  static constexpr std::uint32_t kTorque_ms = 50;
  static constexpr std::uint32_t kTorqueCycles = 5;

  /// The arm outlives the watch. `period`: T [s].
  ModelWatch(const ArmModel& arm, double period) noexcept;

  /// Starts again: the arm has no power, or its positions are not known.
  void reset() noexcept;

  /// A cycle, `periods` after the last one, with the joints' positions and velocities [rad/s], the reading, and the
  /// torques sent in the cycle before. `free`: no wrench is rendered, so whatever pushes is not the scene. Cost: 3 us
  /// for seven joints. Real-time safe.
  void update(const ArmKinematics& kinematics, const JointVector& qd, const hal::JointReading& reading,
              const JointVector& sent, bool free, std::uint32_t periods = 1) noexcept;

  bool drifts() const noexcept { return drifts_; }                         ///< by `kDrift`
  bool drifts_early() const noexcept { return drifts_early_; }             ///< by `kEarlyDrift`
  int wrong_torque_joint() const noexcept { return wrong_torque_joint_; }  ///< drive does not follow; -1: none

 private:
  const JointVector& external_torque() const noexcept { return observer_.torque(); }
  bool is_weight(const ArmKinematics& kinematics) const noexcept;
  void follow_drift(const ArmKinematics& kinematics, const JointVector& qd, bool free, std::uint32_t periods) noexcept;
  /// Leaves out drives that say that they limit their torque, for which the supervisor counts, and those without a
  /// fresh sample.
  void compare_torques(const hal::JointReading& reading, const JointVector& sent) noexcept;

  const ArmModel& arm_;
  ExternalTorqueObserver observer_;
  std::uint32_t torque_cycles_;
  std::uint32_t drift_cycles_;
  std::uint32_t early_drift_cycles_;
  std::uint32_t settle_cycles_;
  std::uint32_t to_settle_ = 0;  // cycles
  bool drifts_ = false;
  bool drifts_early_ = false;
  bool drifting_ = false;
  std::uint32_t cycles_{};                    // of the drift, periods without a cycle included
  double steady_{};                           // size of the external torque where it began [Nm]
  Vector3 begin_R_ = Vector3::Zero();         // where it began [m]
  JointVector lowest_ = JointVector::Zero();  // of the torques sent lately [Nm]
  JointVector highest_ = JointVector::Zero();
  std::array<std::uint32_t, kMaxJoints> wrong_{};  // cycles in a row
  int wrong_torque_joint_ = -1;
};

}  // namespace godobject::firmware
