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
  std::uint32_t predicted = 0;          ///< cycles in a row without a position that could be used, lost or jumped
  bool runs_away = false;               ///< a joint jumped twice, and on in the same direction
  bool finite = true;                   ///< every fresh position and measured torque
  bool stuck = false;                   ///< a position rests though its joint should move
};

/// Holds what the drives report against what an arm can do.
///
/// - Lost: not fresh, be it missing or late. It is predicted from the last one and the velocity, for as long as the
/// supervisor allows.
/// - A jump: a fresh position further than 1.5 v_max T from the last one accepted, for each period in between. It is
///   predicted over too. Where the next one is as far on again in the same direction it is no encoder that jumps but a
///   joint that runs away.
/// - Stuck, in either of two ways. A joint that moved at kMotion of its speed limit for kMoving cycles, and then from
/// one
///   cycle to the next not by a bit for kStill cycles: no torque stops an arm so. Or over kWindow cycles a position has
///   not changed by a bit though the controller pushed its joint by more than `stuck_torque` all the while, and another
///   joint has moved at kOtherMotion of its own limit: a hand that presses against a wall holds all of them, a joint
///   that nobody pushes may rest in a plane motion, and one that turns round in a slow motion rests for a while, too.
class PositionCheck {
 public:
  static constexpr std::uint32_t kWindow = 48;  ///< two of them, whole, are less than 100 cycles
  static constexpr double kMotion = 0.007;      ///< of the speed limit [1]
  static constexpr double kOtherMotion = 0.03;  ///< the same of another joint [1]
  static constexpr std::uint32_t kMoving = 4;
  static constexpr std::uint32_t kStill = 40;
  static constexpr double kJumpOfVelocity = 1.5;

  /// `stuck_torque`: share of a joint's torque limit, above its dry friction.
  PositionCheck(const ArmModel& arm, double stuck_torque, double period) noexcept;

  /// Takes the next reading as it is: at the start, and after a reset.
  void restart() noexcept { started_ = false; }

  /// One cycle. `qd`: joint velocities as last estimated [rad/s]; `pushed`: torques of the last cycle without what
  /// holds the arm [Nm]; `skipped`: periods that passed without a cycle since the last one. Cost: 100 ns. Real-time
  /// safe.
  void update(const hal::JointReading& reading, const JointVector& qd, const JointVector& pushed, std::uint32_t skipped,
              CheckedPositions& checked) noexcept;

 private:
  bool stops_abruptly(const hal::JointReading& reading) noexcept;
  bool rests_though_pushed(const hal::JointReading& reading, const JointVector& pushed) noexcept;

  int joint_count_;
  double period_;
  JointVector largest_step_ = JointVector::Zero();  // of a period [rad]
  JointVector stuck_torque_ = JointVector::Zero();
  JointVector speed_step_ = JointVector::Zero();  // of a period, at the speed limit [rad]
  bool started_ = false;
  JointVector accepted_ = JointVector::Zero();
  JointVector q_ = JointVector::Zero();
  std::array<std::uint32_t, kMaxJoints> periods_{};  // since the accepted position
  std::array<std::uint32_t, kMaxJoints> jumps_{};
  std::array<std::uint32_t, kMaxJoints> predicted_{};
  JointVector fresh_ = JointVector::Zero();       // the last fresh positions, accepted or not
  std::array<std::uint32_t, kMaxJoints> lost_{};  // cycles in a row without a fresh position
  /// Of one joint's fresh positions.
  struct Motion {
    std::array<double, kMoving + 1> last{};  // newest first
    std::uint32_t moving = 0;                // cycles in a row with a change
    std::uint32_t still = 0;                 // cycles in a row without
    bool abrupt = false;                     // it moved just before those
  };
  std::array<Motion, kMaxJoints> motion_;
  std::uint32_t in_window_ = 0;
  JointVector window_start_ = JointVector::Zero();
  bool moved_ = false;                    // a joint has, at kOtherMotion
  std::array<bool, kMaxJoints> rests_{};  // not a bit has changed in this window, and it was pushed
};

}  // namespace godobject::firmware
