#pragma once

#include <array>
#include <cstdint>

#include "core/device/arm_model.h"
#include "hal/joint_drives.h"

namespace godobject::firmware {

/// What is known of the joints' positions in a cycle.
struct CheckedPositions {
  JointVector q = JointVector::Zero();  ///< fresh, or predicted where they are not or cannot be [rad]
  std::uint32_t lost = 0;               ///< cycles in a row without a fresh position, of the worst joint
  std::uint32_t jumps = 0;              ///< fresh positions in a row that cannot be, of the worst joint
  bool finite = true;                   ///< every fresh position and measured torque
  bool stuck = false;                   ///< a position rests though its joint should move
};

/// Holds what the drives report against what an arm can do.
///
/// - A position that is not fresh is predicted from the last one and the velocity, for as long as the supervisor
/// allows.
/// - A jump: a fresh position further than 1.5 v_max T from the last one accepted, for each period in between. It is
///   predicted over too.
/// - Stuck: over kWindow cycles one joint's position has not changed by a bit, though the controller pushed it by more
///   than `stuck_torque` all the while, and another joint has moved. A hand that presses against a wall holds all of
///   them; a joint that nobody pushes may rest while others move, as in any plane motion.
class PositionCheck {
 public:
  static constexpr std::uint32_t kWindow = 48;  ///< two of them, whole, are less than 100 cycles
  static constexpr double kOtherMotion = 1e-3;  ///< of another joint in a window [rad]
  static constexpr double kStuckTorque = 0.02;  ///< share of the joint's torque limit
  static constexpr double kJumpOfVelocity = 1.5;

  PositionCheck(const ArmModel& arm, double period) noexcept;

  /// Takes the next reading as it is: at the start, and after a reset.
  void restart() noexcept { started_ = false; }

  /// One cycle. `qd`: joint velocities as last estimated [rad/s]; `pushed`: torques of the last cycle without what
  /// holds the arm [Nm]; `skipped`: periods that passed without a cycle since the last one. Cost: 100 ns. Real-time
  /// safe.
  void update(const hal::JointReading& reading, const JointVector& qd, const JointVector& pushed, std::uint32_t skipped,
              CheckedPositions& checked) noexcept;

 private:
  bool find_stuck(const hal::JointReading& reading, const JointVector& pushed) noexcept;

  int joint_count_;
  double period_;
  JointVector largest_step_ = JointVector::Zero();  // of a period [rad]
  JointVector stuck_torque_ = JointVector::Zero();
  bool started_ = false;
  JointVector accepted_ = JointVector::Zero();
  JointVector q_ = JointVector::Zero();
  std::array<std::uint32_t, kMaxJoints> periods_{};  // since the accepted position
  std::array<std::uint32_t, kMaxJoints> jumps_{};
  std::uint32_t in_window_ = 0;
  JointVector window_start_ = JointVector::Zero();
  std::array<bool, kMaxJoints> rests_{};  // not a bit has changed in this window, and it was pushed
};

}  // namespace godobject::firmware
