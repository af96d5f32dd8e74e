#pragma once

#include <array>
#include <cstdint>

#include "core/device/arm_model.h"
#include "firmware/cycle/fault.h"
#include "firmware/cycle/lateness_watch.h"
#include "firmware/cycle/limit_watch.h"
#include "firmware/cycle/mode.h"
#include "firmware/cycle/observation.h"
#include "firmware/cycle/rate_watch.h"
#include "firmware/cycle/sign_test.h"
#include "hal/joint_drives.h"

namespace godobject::firmware {

/// The torques and the power that may leave in this cycle.
struct Decision {
  hal::PowerRequest power = hal::PowerRequest::kOff;
  bool holds_arm = false;                         ///< command the torque that holds the arm
  double share = 0.0;                             ///< of the rendered torque [0, 1]
  bool of_last = false;                           ///< `share` is of the torque rendered last, not of this cycle's
  bool rate_limited = true;                       ///< torques change by no more than the rate limit
  JointVector test_torque = JointVector::Zero();  ///< of the sign test [Nm]
};

/// Decides what a fault means, and owns the torque: only torque that it grants is sent. No other class does either. A
/// state machine without time, hardware or I/O; `step` is called once a cycle.
///
/// Power: it is given only after the operator has released and then held the enable switch, while all drives answer and
/// the emergency stop is released, and each time again. A switch that is stuck, or held since before the start, gives
/// none. Neither FADE nor STOP requests power that was not requested in the cycle before, or that a drive has lost
/// since.
///
/// FADE, after a position was lost three times: the last rendered torque, held for the two cycles in which a position
/// may be missing, goes to zero in kFade_ms; then STOP.
///
/// STOP: nothing is rendered from this cycle on. Drives that obey hold the arm for kHold_ms; then they get their
/// quick stop: they come to rest by themselves and close the brakes. The hold comes first since a drive's quick stop
/// begins with the present torque. Power is taken away only once all drives are seen at rest, since a drive without
/// power breaks its ramp off. A drive that is not seen at rest in time stays in its quick stop.
///
/// Reactions, in cycles of 1 ms from the one that sees the cause to the complete reaction: position lost three times,
/// FADE then STOP, 6; all others, STOP, 1 of any period. A cause that must occur two or three times in a row is seen at
/// the last of them.
class Supervisor {
 public:
  struct Parameters {
    double period = 1e-3;               ///< T [s]
    std::uint32_t boot_cycles = 5000;   ///< until all drives must answer
    std::uint32_t prepare_cycles = 25;  ///< until the torque that holds the arm is reached, before power
    std::uint32_t engage_cycles = 500;  ///< of the ramp to the full wrench
    double engage_force = 0.5;          ///< contact force below which rendering begins [N]
    std::uint32_t limited_cycles = 50;  ///< for which a drive may limit its torque by itself
    bool sign_test = true;
    SignTest::Parameters sign;
  };

  // Constants are chosen. Comments give the range that tests/closed_loop and tests/firmware pass with, all others
  // unchanged, and the effect of the next value tried.

  /// Lost positions in the last thousand cycles that are allowed. Chosen: a fifth. They lengthen the mean age of a
  /// position by a quarter of a period (A10 of toolchain/report). A drive that answers only every second SYNC loses
  /// half of all.
  static constexpr std::uint32_t kMostLost = 200;
  /// Jumps in a row. One may be a disturbance of the encoder; the second confirms the fault.
  static constexpr std::uint32_t kJumpsInRow = 2;
  /// Duration of the zero check [ms]. 20 to 100: long enough to see a joint that slips in its brake. Longer only delays
  /// the start.
  static constexpr std::uint32_t kZero_ms = 100;
  /// Time until the drives must be enabled [ms]. 500 to 2000. The simulated drives need 28 (3 for the power stage, 25
  /// for the brake); with 30 they are too late over CAN.
  static constexpr std::uint32_t kEnable_ms = 2000;
  /// Duration of a FADE [ms], at least two cycles. 5: at 1 kHz the fault table measures 7 cycles from the third loss on
  /// the bus to the complete reaction, and allows 8; with 10 it is too late. Less would let the torque step harder.
  static constexpr std::uint32_t kFade_ms = 5;
  /// Time in which a STOP holds the arm [ms], at least a cycle. 1 to 4. With 0 the quick stop would begin with the last
  /// rendered torque.
  static constexpr std::uint32_t kHold_ms = 2;
  /// Duration of the ramp when the run ends [ms]. 50: with 10 torques change faster than the rate limit, with 200 the
  /// run does not end within 0.2 s, which the tests require.
  static constexpr std::uint32_t kEndRamp_ms = 50;
  /// Time until the drives must rest when the run ends [ms]. 50 to 120. With 300 the run does not end within 0.2 s.
  static constexpr std::uint32_t kEndStop_ms = 120;
  /// Time until the drives must rest after a fault, and until a reset must succeed [ms]. 200 to 1000. A drive's quick
  /// stop takes at most 0.5 s in simulation (JointHardwareParameters::quick_stop_ns). Longer only delays the message.
  static constexpr std::uint32_t kFaultStop_ms = 1000;
  /// Motion that the zero check allows [rad]. 0.001 to 0.005. With 0.02 a joint that moves 6 mrad with its brake closed
  /// passes.
  static constexpr double kAtRest = 0.005;
  /// Motion of a joint that ends enabling and sign test [rad]. 0.05 to 0.2. With 0.01 the test of an encoder that
  /// stands still fails.
  static constexpr double kMovesAway = 0.05;

  Supervisor(const ArmModel& arm, const Parameters& parameters) noexcept;

  /// The decision of this cycle. Cost: 20 ns. Real-time safe.
  Decision step(const Observation& seen) noexcept;

  Mode mode() const noexcept { return mode_; }
  Fault fault() const noexcept { return fault_; }
  int fault_joint() const noexcept { return fault_joint_; }  ///< joint of the fault; -1: not known, or none

  /// True: each position is compared with the one before. False: each reading is taken as it is.
  bool follows_positions() const noexcept {
    return mode_ != Mode::kBoot && mode_ != Mode::kStopped && mode_ != Mode::kResetting;
  }

  /// True: the god object moves by its own rules. False: it is set to the device pose in each cycle.
  bool renders() const noexcept {
    return mode_ == Mode::kArmed || mode_ == Mode::kEngaging || mode_ == Mode::kRunning || mode_ == Mode::kEnding;
  }

 private:
  void enter(Mode mode) noexcept;
  void stop(Fault fault, int joint = -1) noexcept;
  void begin_ending() noexcept;
  void watch_limits(const Observation& seen) noexcept;
  int joint_of(Fault fault, const Observation& seen) const noexcept;
  Fault find_fault(const Observation& seen) const noexcept;
  Fault find_fault_with_power(const Observation& seen) const noexcept;
  Fault find_fault_without_power(const Observation& seen) const noexcept;
  bool jumps_too_often(const Observation& seen) const noexcept { return seen.jumps >= kJumpsInRow || too_many_jumps_; }
  bool moved(const Observation& seen, double more_than) const noexcept;
  bool before_sign_is_known() const noexcept { return mode_ == Mode::kEnabling || mode_ == Mode::kSignTest; }
  bool powered() const noexcept { return (mode_ >= Mode::kEnabling && mode_ <= Mode::kFade) || mode_ == Mode::kEnding; }

  // a cycle in one mode
  void advance(const Observation& seen) noexcept;
  void raise_share() noexcept;
  void lower_share() noexcept;
  void come_to_rest(const Observation& seen) noexcept;
  void boot(const Observation& seen) noexcept;
  void check_zero(const Observation& seen) noexcept;
  void wait_for_enable_switch(const Observation& seen) noexcept;
  void wait_for_power(const Observation& seen) noexcept;
  void test_sign(const Observation& seen) noexcept;
  void reset(const Observation& seen) noexcept;

  Decision decide(const Observation& seen) const noexcept;
  hal::PowerRequest power_to_stop(const DriveSummary& drives, bool may_hold) const noexcept;
  hal::PowerRequest power_after_stop(const DriveSummary& drives) const noexcept;

  /// The constants in cycles.
  struct Durations {
    explicit Durations(double period) noexcept;
    std::uint32_t zero, enable, fade, hold, end_ramp, end_stop, fault_stop;
    std::uint32_t to_loss;  // lost positions or failed sends in a row that are a fault, see hal::cycles_to_loss
  };

  int joint_count_;
  Parameters parameters_;
  Durations cycles_;
  Mode mode_ = Mode::kBoot;
  Fault fault_ = Fault::kNone;
  hal::PowerRequest last_power_ = hal::PowerRequest::kOff;
  std::uint32_t in_mode_ = 0;  // cycles in this mode, with this one
  bool ending_ = false;
  bool switch_was_released_{};  // since kIdle began, with the emergency stop released
  bool sign_tested_;
  bool led_out_ = false;  // the operator leads the tool out of a contact, or away from an object, before it engages
  double share_ = 0.0;
  double end_step_{};                            // of the share, a cycle
  JointVector reference_ = JointVector::Zero();  // joint positions at the beginning of a mode in which none may move
  JointVector test_torque_ = JointVector::Zero();
  std::uint32_t stop_cycles_{};  // longest duration of this kStopping
  int fault_joint_ = -1;
  SignTest sign_test_;
  LatenessWatch lateness_;
  RateWatch jumps_;
  RateWatch lost_{kMostLost};
  std::array<LimitWatch, kMaxJoints> limits_{};
  int limited_joint_ = -1;  // its drive limited its torque for too long; -1: none
  bool too_late_{};
  bool too_many_jumps_{};
  bool too_many_lost_{};
};

}  // namespace godobject::firmware
