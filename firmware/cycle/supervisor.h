#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/cycle/overrun_watch.h"
#include "firmware/cycle/rate_watch.h"
#include "firmware/cycle/sign_test.h"
#include "godobject/status.h"
#include "hal/joint_drives.h"

namespace godobject::firmware {

/// What the supervisor is about. Power flows from kEnabling to kFade and in kEnding.
enum class Mode : std::uint8_t {
  kBoot,       ///< waits for all drives to answer
  kZeroCheck,  ///< positions must be possible and rest, brakes closed
  kIdle,       ///< waits for the enable switch: to be seen released, then held
  kEnabling,   ///< waits for all drives to be enabled; holds the arm
  kSignTest,   ///< each joint must move the way it is pushed
  kArmed,      ///< holds the arm; waits for the contact force to be small
  kEngaging,   ///< what is rendered rises from nothing
  kRunning,    ///< renders
  kFade,       ///< what was last rendered goes to nothing within kFadeCycles; then kStopping
  kStopping,   ///< nothing is rendered, the arm is held, the drives come to rest and close the brakes
  kStopped,    ///< no power once the drives rest; a fault is latched until the operator resets it
  kResetting,  ///< drives leave their faults, once they rest; then kBoot
  kEnding,     ///< was asked to end: what is rendered goes to nothing; then kStopping
  kEnded,      ///< no power once the drives rest; the loop may be left
};
inline constexpr std::size_t kModeCount = static_cast<std::size_t>(Mode::kEnded) + 1;

/// Why power was taken away. The first one is latched.
enum class Fault : std::uint8_t {
  kNone,
  kDrivesAbsent,    ///< not all drives answered in time
  kNotAtRest,       ///< a joint moved though its brake was closed
  kPositionLost,    ///< a joint without a position that could be used three times in a row
  kPositionJump,    ///< a position that cannot be, twice in a row or too often
  kNotFinite,       ///< a NaN or Inf in a reading
  kEncoderStuck,    ///< a position rests though its joint should move
  kComputation,     ///< the cycle could not be computed
  kOverruns,        ///< the loop was late too often, or too much
  kDriveLeft,       ///< a drive is no longer enabled, or does not become so
  kAlarm,           ///< a bus or a drive said something that power must not outlive: the reading's alarm
  kSendFailed,      ///< torques could not be handed over three times in a row
  kEmergencyStop,   ///< pressed, or its line is dead
  kEnableReleased,  ///< the operator let go of the enable switch
  kJointLimit,      ///< a joint beyond its position limit
  kTooFast,         ///< hand or joint beyond the speed at which to stop, or a joint that runs away
  kSignWrong,       ///< a joint moves against its torque, or away by itself
  kSignUndecided,   ///< a joint does not move, or the hand is not still
  kOutsideLimits,   ///< a joint stands beyond its position limit before the start
};

const char* name(Mode mode) noexcept;        ///< one word
const char* describe(Fault fault) noexcept;  ///< one clause with the cure
const char* describe(hal::Alarm alarm) noexcept;

struct DriveSummary {
  bool all_answer = false;
  bool all_enabled = false;
  bool none_moves = false;  ///< each answers, and is neither enabled nor in a quick stop
  bool any_fault = false;
  bool all_fresh = false;  ///< each has said so in this cycle
};

DriveSummary summarize(const hal::JointReading& reading, int joint_count) noexcept;

/// All that the supervisor sees of a cycle, once it is computed and before torques are sent.
struct Observation {
  DriveSummary drives;
  bool emergency_stop = false;
  bool enable_switch = false;
  bool alarm = false;
  bool drive_restarted = false;         ///< the alarm is that a drive has started anew
  JointVector q = JointVector::Zero();  ///< checked positions [rad]
  std::uint32_t lost = 0;               ///< CheckedPositions::predicted
  std::uint32_t jumps = 0;
  bool finite = true;
  bool stuck = false;
  int joint_beyond_limit = -1;  ///< a joint beyond its position limit; -1: none
  bool too_fast = false;
  Status status = Status::kOk;     ///< of estimate, mapping, god object and joint torque
  double contact_force = 0.0;      ///< what would be rendered [N], torques counted by the rotation length
  bool inside = false;             ///< the god object has not yet come out of where it started
  std::int64_t overrun_ns = 0;     ///< of the cycle before
  std::uint32_t sends_failed = 0;  ///< in a row, before this cycle
  bool end_requested = false;      ///< SIGTERM, SIGINT, or the duration is over
  bool reset_requested = false;    ///< by the operator
};

/// What may leave this cycle.
struct Decision {
  hal::PowerRequest power = hal::PowerRequest::kOff;
  bool holds_arm = false;                         ///< the torque that holds the arm is commanded
  double share = 0.0;                             ///< of what is rendered [0, 1]
  bool of_last = false;                           ///< that share is of what was rendered last, not in this cycle
  bool rate_limited = true;                       ///< torques change by no more than the rate limit
  JointVector test_torque = JointVector::Zero();  ///< of the sign test [Nm]
};

/// The only place that decides what a fault means, and the only owner of torque: what it does not grant is not sent. A
/// state machine without time, hardware or I/O; `step` is called once a cycle.
///
/// Neither FADE nor STOP asks for power that was not asked for in the cycle before, or that a drive has lost since.
///
/// Power is given only after the enable switch, while all drives answered and the emergency stop was released, was
/// seen released and then held, each time anew: one that is stuck, or held since before the start, gives none.
///
/// FADE: the two cycles for which a position may be missing are what the last torque is held for; from the third on it
/// goes to nothing in kFadeCycles. STOP: nothing is rendered from this cycle on; drives that obey hold the arm, and
/// after kHoldCycles they are told to come to rest by themselves, then to close the brakes. The cycles before are there
/// since a drive's quick stop begins with the torque that it finds. Power is taken from them only once all have been
/// seen at rest: without it a drive breaks its ramp off. What is not seen at rest in time stays in its quick stop.
///
/// Reactions, with the cycles from the one in which the cause is seen to the one in which the reaction is complete:
/// position lost three times FADE then STOP 6; all others STOP 1. What is seen two or three times in a row is seen at
/// the last of them.
class Supervisor {
 public:
  struct Parameters {
    std::uint32_t boot_cycles = 5000;   ///< for the drives to answer
    std::uint32_t prepare_cycles = 25;  ///< in which the torque that holds the arm is reached, before power
    std::uint32_t engage_cycles = 500;  ///< for the ramp
    double engage_force = 0.5;          ///< [N]
    bool sign_test = true;
    SignTest::Parameters sign;
  };

  static constexpr std::uint32_t kZeroCycles = 100;     ///< of the zero check
  static constexpr std::uint32_t kEnableCycles = 2000;  ///< for the drives to become enabled
  static constexpr std::uint32_t kFadeCycles = 5;
  static constexpr std::uint32_t kHoldCycles = 2;
  static constexpr std::uint32_t kEndRamp = 50;      ///< cycles
  static constexpr std::uint32_t kEndStop = 120;     ///< for brakes when asked to end
  static constexpr std::uint32_t kFaultStop = 1000;  ///< for brakes after a fault
  static constexpr double kAtRest = 0.005;           ///< of the zero check [rad]
  static constexpr double kMovesAway = 0.05;         ///< before and in the sign test [rad]

  Supervisor(const ArmModel& arm, const Parameters& parameters) noexcept;

  /// One cycle. Cost: 20 ns. Real-time safe.
  Decision step(const Observation& seen) noexcept;

  Mode mode() const noexcept { return mode_; }
  Fault fault() const noexcept { return fault_; }
  int fault_joint() const noexcept { return fault_joint_; }  ///< whose fault it is, where it is known; -1: none

  /// Positions are held against those before; otherwise each reading is taken as it is.
  bool follows_positions() const noexcept {
    return mode_ != Mode::kBoot && mode_ != Mode::kStopped && mode_ != Mode::kResetting;
  }

  /// The god object has a life of its own in this mode; otherwise it is put to the device in each cycle.
  bool renders() const noexcept {
    return mode_ == Mode::kArmed || mode_ == Mode::kEngaging || mode_ == Mode::kRunning || mode_ == Mode::kEnding;
  }

 private:
  void enter(Mode mode) noexcept;
  void stop(Fault fault, int joint = -1) noexcept;
  Fault find_fault(const Observation& seen) const noexcept;
  void advance(const Observation& seen) noexcept;
  bool moved(const Observation& seen, double more_than) const noexcept;
  bool before_sign_is_known() const noexcept { return mode_ == Mode::kEnabling || mode_ == Mode::kSignTest; }
  void begin_ending() noexcept;
  Decision decide(const Observation& seen) const noexcept;
  hal::PowerRequest power_to_stop(const DriveSummary& drives, bool may_hold) const noexcept;
  hal::PowerRequest power_after_stop(const DriveSummary& drives) const noexcept;
  bool powered() const noexcept { return (mode_ >= Mode::kEnabling && mode_ <= Mode::kFade) || mode_ == Mode::kEnding; }

  int joint_count_;
  Parameters parameters_;
  Mode mode_ = Mode::kBoot;
  Fault fault_ = Fault::kNone;
  hal::PowerRequest last_power_ = hal::PowerRequest::kOff;
  std::uint32_t in_mode_ = 0;  // cycles, this one included
  bool ending_ = false;
  bool switch_was_released_ = false;  // since kIdle began, with the emergency stop released
  bool sign_tested_;
  double share_ = 0.0;
  double end_step_ = 0.0;                        // of the share, a cycle
  JointVector reference_ = JointVector::Zero();  // where the joints were when the mode began that must not move
  JointVector test_torque_ = JointVector::Zero();
  std::uint32_t stop_cycles_ = 0;  // the longest that kStopping may take
  int fault_joint_ = -1;
  SignTest sign_test_;
  OverrunWatch overruns_;
  RateWatch jumps_;
  bool too_many_overruns_ = false;
  bool too_many_jumps_ = false;
};

}  // namespace godobject::firmware
