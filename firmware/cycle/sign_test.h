#pragma once

#include <cstdint>

#include "core/device/arm_model.h"

namespace godobject::firmware {

/// Whether each joint moves the way it is pushed, one after the other, before anything is rendered: a wrong polarity, a
/// swapped axis or an encoder that counts backwards turns every spring into its opposite.
///
/// A joint's torque rises slowly from zero, on top of what holds the arm, until the position leaves the straight line
/// in time that it was on before by `motion`; then the same the other way. A drifting hand is on a straight line and
/// does not matter. Both ways right: next joint. Both ways wrong: kWrong. Else again, kAttempts times in all, then
/// kUndecided: the joint is blocked, its encoder stuck, or the hand is not still.
class SignTest {
 public:
  enum class Result : std::uint8_t { kRunning, kPassed, kWrong, kUndecided };

  struct Parameters {
    double push = 0.05;     ///< largest torque, share of the joint's limit
    double motion = 0.002;  ///< deviation looked for [rad]
  };

  static constexpr std::uint32_t kStillCycles = 50;   ///< in which the straight line is found
  static constexpr std::uint32_t kPushCycles = 1000;  ///< in which the torque rises to its largest
  static constexpr double kAtRest = 0.15;             ///< of `motion` in kStillCycles
  static constexpr std::uint32_t kWaits = 8;          ///< times kStillCycles, for that
  static constexpr int kAttempts = 3;

  SignTest(const ArmModel& arm, const Parameters& parameters) noexcept;

  void restart() noexcept;

  /// One cycle with the joint positions [rad]; `torque`: what to add to the torque that holds the arm [Nm].
  /// Cost: 10 ns. Real-time safe.
  Result update(const JointVector& q, JointVector& torque) noexcept;

  int joint() const noexcept { return joint_; }  ///< that is being tested, or failed

 private:
  /// Which way the joint went at a push: 1 along, -1 against, 0 not at all.
  void finish_push(int way) noexcept;

  int joint_count_;
  double motion_;
  JointVector largest_ = JointVector::Zero();  // torque [Nm]
  Result result_ = Result::kRunning;
  int joint_ = 0;
  int attempt_ = 0;
  double direction_ = 1.0;
  int first_way_ = 0;
  std::uint32_t waits_ = 0;  // for the joint to come to rest
  std::uint32_t cycle_ = 0;  // of the push, the still cycles before it included
  double begin_ = 0.0;       // of the straight line
  double slope_ = 0.0;       // a cycle
};

}  // namespace godobject::firmware
