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
/// The constants are chosen. Each comment gives the range that the tests of tests/firmware and tests/closed_loop pass
/// with, or the reason.
class ModelWatch {
 public:
  /// Bandwidth of the observer [1/s]: a torque is seen after 20 ms, and the encoders' steps do not show.
  static constexpr double kBandwidth = 50.0;
  /// External torque of a joint that counts as a push: share of its torque limit. The model's friction and the hand's
  /// own weight stay below.
  static constexpr double kPush = 0.05;
  /// Load at the tool whose torque counts as that of wrong masses [kg]. A hand that moves the arm evenly against its
  /// viscous friction pushes with less.
  static constexpr double kLeastLoad = 0.08;
  /// Share of the external torque that a weight at the tool and a factor on all weights may leave unexplained.
  static constexpr double kUnexplained = 0.25;
  /// Change of the external torque that still counts as constant: share of its size.
  static constexpr double kSteady = 0.25;
  /// Way of the tool under a constant torque of wrong masses that is a drift [m]. A hand's push changes earlier.
  static constexpr double kDrift = 0.1;
  /// Difference between measured and sent torque that is an error: share of the joint's limit.
  static constexpr double kTorqueError = 0.1;
  /// Duration of such a difference [ms]. A drive's current loop and its bus take less.
  static constexpr std::uint32_t kTorque_ms = 20;

  /// The arm outlives the watch. `period`: T [s].
  ModelWatch(const ArmModel& arm, double period) noexcept;

  /// Starts again: the arm has no power, or its positions are not known.
  void reset() noexcept;

  /// A cycle with the joints' positions and velocities [rad/s], the reading, and the torques sent in the cycle before.
  /// `free`: no wrench is rendered, so whatever pushes is not the scene. Cost: 3 us for seven joints. Real-time safe.
  void update(const ArmKinematics& kinematics, const JointVector& qd, const hal::JointReading& reading,
              const JointVector& sent, bool free) noexcept;

  const JointVector& external_torque() const noexcept { return observer_.torque(); }  ///< [Nm]
  int pushed_joint() const noexcept { return pushed_joint_; }                         ///< -1: none
  bool is_weight() const noexcept { return is_weight_; }  ///< the external torque is that of wrong masses
  bool drifts() const noexcept { return drifts_; }        ///< it has moved the tool by `kDrift`
  int wrong_torque_joint() const noexcept { return wrong_torque_joint_; }  ///< drive does not follow; -1: none

 private:
  void find_weight(const ArmKinematics& kinematics) noexcept;
  void follow_drift(const ArmKinematics& kinematics, const JointVector& qd, bool free) noexcept;
  void compare_torques(const hal::JointReading& reading, const JointVector& sent) noexcept;

  const ArmModel& arm_;
  ExternalTorqueObserver observer_;
  std::uint32_t torque_cycles_;
  int pushed_joint_ = -1;
  bool is_weight_ = false;
  bool drifts_ = false;
  bool drifting_ = false;
  double steady_{};                           // size of the external torque where the way began [Nm]
  Vector3 begin_R_ = Vector3::Zero();         // of the way [m]
  JointVector lowest_ = JointVector::Zero();  // of the torques sent lately [Nm]
  JointVector highest_ = JointVector::Zero();
  std::array<std::uint32_t, kMaxJoints> wrong_{};  // cycles in a row
  int wrong_torque_joint_ = -1;
};

}  // namespace godobject::firmware
