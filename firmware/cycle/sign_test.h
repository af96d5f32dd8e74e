#pragma once

#include <cstdint>

#include "core/device/arm_model.h"

namespace godobject::firmware {

/// Checks, before rendering, that each joint moves in the direction of its torque, one joint after the other. A wrong
/// polarity, a swapped axis or an encoder that counts backwards would turn every spring into its opposite.
///
/// A joint's torque rises slowly from zero, in addition to the torque that holds the arm, until its position deviates
/// by `motion` from the straight line in time that it followed before. Then the same in the other direction. A drifting
/// hand moves on a straight line and does not disturb. Both directions right: next joint. Both wrong: kWrong. Otherwise
/// the joint is tested again, kAttempts times in all, then kUndecided: the joint is blocked, its encoder stuck, or the
/// hand moves.
///
/// The constants are chosen. Each comment gives the range that tests/firmware and tests/closed_loop pass with, all
/// others unchanged, and the effect of the next value tried.
class SignTest {
 public:
  enum class Result : std::uint8_t { kRunning, kPassed, kWrong, kUndecided };

  struct Parameters {
    double push = 0.05;     ///< largest torque: share of the joint's limit
    double motion = 0.002;  ///< deviation to detect [rad]
  };

  /// Time that determines the straight line [ms]. 50 to 100. With 20 a hand that holds the arm as a spring spoils the
  /// line.
  static constexpr std::uint32_t kStill_ms = 50;
  /// Time in which the torque rises to its largest value [ms]. 1000: with 300 dry friction and a drifting hand, with
  /// 3000 a hand that holds the arm as a spring makes the test fail.
  static constexpr std::uint32_t kPush_ms = 1000;
  /// Motion in kStill_ms that counts as rest: share of `motion`. 0.05 to 0.15. With 0.5 a joint that still springs
  /// back from the push before, in the hand's grip, spoils the line.
  static constexpr double kAtRest = 0.15;
  /// Times kStill_ms in which a joint may come to rest. 8 to 20. With 3 a joint in the hand's grip is tested too
  /// early.
  static constexpr std::uint32_t kWaits = 8;
  /// 1 to 5 pass. Chosen: a hand that moves by chance costs one attempt; the third without a result means a cause that
  /// stays.
  static constexpr int kAttempts = 3;

  /// `period`: T [s].
  SignTest(const ArmModel& arm, const Parameters& parameters, double period) noexcept;

  void restart() noexcept;

  /// One cycle with the joint positions [rad]. `torque`: to be added to the torque that holds the arm [Nm].
  /// Cost: 10 ns. Real-time safe.
  Result update(const JointVector& q, JointVector& torque) noexcept;

  int joint() const noexcept { return joint_; }  ///< the joint under test, or the one that failed

 private:
  /// `response`: the joint moved along the push (1), against it (-1) or not at all (0).
  void finish_push(int response) noexcept;

  int joint_count_;
  std::uint32_t still_cycles_;
  std::uint32_t push_cycles_;
  double motion_;
  JointVector largest_ = JointVector::Zero();  // torque [Nm]
  Result result_ = Result::kRunning;
  int joint_ = 0;
  int attempt_ = 0;
  double direction_ = 1.0;
  int first_response_{};
  std::uint32_t waits_ = 0;  // times that the joint was given to come to rest
  std::uint32_t cycle_ = 0;  // of the push, with the still cycles before it
  double begin_{};           // of the straight line
  double slope_{};           // a cycle
};

}  // namespace godobject::firmware
