#pragma once

#include <array>
#include <cstdint>

#include "core/device/arm_model.h"
#include "hal/joint_drives.h"

namespace godobject::firmware {

/// The checked joint positions of a cycle.
struct CheckedPositions {
  JointVector q = JointVector::Zero();  ///< fresh, or predicted where a position is lost or impossible [rad]
  std::uint32_t lost = 0;               ///< cycles in a row without a fresh position, of the worst joint
  std::uint32_t jumps = 0;              ///< impossible fresh positions in a row, of the worst joint
  std::uint32_t predicted = 0;          ///< cycles in a row without a usable position, lost or jumped
  bool runs_away = false;               ///< a joint jumped twice in the same direction
  bool finite = true;                   ///< all fresh positions and measured torques are finite
  bool stuck{};                         ///< a position does not change although its joint should move
  int lost_joint = -1;                  ///< joint of `lost`; this and the next: -1: none
  int jump_joint = -1;                  ///< joint of `jumps`
  int not_finite_joint = -1;            ///< a joint with a reading that is not finite
  int stuck_joint = -1;                 ///< joint of `stuck`
};

/// Checks the drives' readings against the motion that an arm is capable of.
///
/// - Lost: a position is not fresh, missing or late. It is predicted from the last one and the velocity, for as long as
///   the supervisor allows.
/// - Jump: a fresh position is further than kJumpOfVelocity v_max T from the last accepted one, for each period between
///   them. It is predicted, too. If the next position is as far again in the same direction, the encoder does not jump:
///   the joint runs away.
/// - Stuck, first way: a joint moved at kMotion of its speed limit for kMoving samples and then, from one sample to the
///   next, did not change by a bit for kStill samples. No torque stops an arm like this. A sample is one cycle in each
///   millisecond, or each cycle if the period is longer.
/// - Stuck, second way: over kWindow samples a position did not change by a bit although the controller pushed its
/// joint by
///   more than `stuck_torque` all the time, and another joint moved at kOtherMotion of its own limit. The second
///   condition excludes correct readings at rest: a hand that presses against a wall holds all joints, and a joint that
///   turns round in a slow motion rests for a while.
///
/// The constants are chosen. Each comment gives the range that tests/closed_loop and tests/firmware pass with, all
/// others unchanged, and the effect of the next value tried.
class PositionCheck {
 public:
  /// Samples. 24 to 48. Two whole windows must end within the 100 cycles that the fault table allows; 60 is too late.
  static constexpr std::uint32_t kWindow = 48;
  /// Share of the speed limit. 0.007 alone of those tried: 0.003 reports joints that come to rest by themselves, 0.015
  /// misses the stuck encoder of the light-weight robot's forearm (encoder_stuck_forearm).
  static constexpr double kMotion = 0.007;
  /// Share of the speed limit. 0.005 to 0.03. 0.06 misses an encoder that sticks while the other joint moves at 0.05 of
  /// its limit, 0.15 also one that sticks before rendering begins. The largest value reports the fewest correct
  /// readings.
  static constexpr double kOtherMotion = 0.03;
  /// Samples. 4: with 2 the stuck forearm is missed, with 8 a joint that comes to rest by itself is reported.
  static constexpr std::uint32_t kMoving = 4;
  /// Samples. 40 to 80. With 20 a tool that stops at a contact is reported (control_cycle_test.cc). The fault table
  /// allows 100.
  static constexpr std::uint32_t kStill = 40;
  /// Factor on the speed limit. 1.5: it must be above the speed at which the supervisor stops (joint_speed_stop is at
  /// most 1.4), or a fast joint would jump first. With 2 a jump of twice the limit is accepted, with 3 also the closed
  /// loop's encoder_jumps_twice.
  static constexpr double kJumpOfVelocity = 1.5;

  /// `stuck_torque`: share of a joint's torque limit, above its dry friction; `period`: T [s].
  PositionCheck(const ArmModel& arm, double stuck_torque, double period) noexcept;

  /// Accepts the next reading without a comparison: at the start, and after a reset.
  void restart() noexcept { started_ = false; }

  /// Checks the reading of one cycle. `qd`: the last estimated joint velocities [rad/s]; `pushed`: torques of the last
  /// cycle without those that hold the arm [Nm]; `skipped`: periods without a cycle since the last one. Cost: 100 ns.
  /// Real-time safe.
  void update(const hal::JointReading& reading, const JointVector& qd, const JointVector& pushed, std::uint32_t skipped,
              CheckedPositions& checked) noexcept;

 private:
  int stops_abruptly(const hal::JointReading& reading) noexcept;
  int rests_though_pushed(const hal::JointReading& reading, const JointVector& pushed) noexcept;

  int joint_count_;
  double period_;
  JointVector largest_step_ = JointVector::Zero();  // in a period [rad]
  JointVector stuck_torque_ = JointVector::Zero();  // [Nm]
  JointVector speed_step_ = JointVector::Zero();    // from sample to sample at the speed limit [rad]
  std::uint32_t cycles_a_sample_;
  std::uint32_t since_sample_ = 0;  // cycles
  bool started_ = false;
  JointVector accepted_ = JointVector::Zero();       // last accepted positions
  JointVector q_ = JointVector::Zero();              // accepted or predicted positions
  std::array<std::uint32_t, kMaxJoints> periods_{};  // since the accepted position
  std::array<std::uint32_t, kMaxJoints> jumps_{};
  std::array<std::uint32_t, kMaxJoints> predicted_{};
  JointVector fresh_ = JointVector::Zero();       // last fresh positions, accepted or not
  std::array<std::uint32_t, kMaxJoints> lost_{};  // cycles in a row without a fresh position
  /// Motion of one joint by its fresh positions.
  struct Motion {
    std::array<double, kMoving + 1> last{};  // newest first
    std::uint32_t moving = 0;                // samples in a row with a change
    std::uint32_t still = 0;                 // samples in a row without a change
    bool abrupt = false;                     // the joint moved just before these
  };
  std::array<Motion, kMaxJoints> motion_;
  std::uint32_t in_window_ = 0;
  JointVector window_start_ = JointVector::Zero();
  bool moved_{};                          // a joint moved at kOtherMotion
  std::array<bool, kMaxJoints> rests_{};  // pushed, and no bit changed in this window
};

}  // namespace godobject::firmware
