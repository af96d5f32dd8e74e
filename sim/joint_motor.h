#pragma once

#include <array>
#include <cstdint>

#include "core/device/arm_model.h"

namespace godobject::sim {

/// Parameters of a joint's motor, encoder, brake and drive, at the joint's side of the gear. Defaults are chosen, of
/// the order of small servo drives; the times must stay below those that the controller waits (Supervisor).
struct JointHardwareParameters {
  double encoder_step = 0.0;         ///< angle of a count [rad]; 0: exact
  std::int32_t counter_at_zero = 0;  ///< counts at q = 0; the counter wraps at 32 bits
  double torque_step = 0.0;   ///< torques are rounded to it, usually a permille of the rated torque [Nm]; 0: exact
  double motor_sign = 1.0;    ///< -1: the motor is connected with the wrong polarity
  double torque_limit = 0.0;  ///< [Nm]
  double brake_torque = 0.0;  ///< torque of the closed brake [Nm]
  std::int64_t brake_open_ns = 25'000'000;   ///< from current on to open; until then the brake holds
  std::int64_t brake_close_ns = 20'000'000;  ///< from current off to closed; until then it is open
  std::int64_t enable_ns = 3'000'000;        ///< from the request to the power stage, before the brake begins to open
  std::int64_t command_deadline_ns = 4'000'000;  ///< an enabled drive trips if no command arrives for longer
  double quick_stop_damping = 0.0;               ///< proportional gain of the drive's velocity loop [Nms/rad]
  double quick_stop_stiffness =
      0.0;  ///< its integral gain: stiffness towards the position at which the stop began [Nm/rad]
  double stop_speed_margin = 0.5;  ///< a drive trips if its joint becomes faster by this in a quick stop [rad/s]
  double rest_velocity = 0.01;     ///< below it the joint is at rest, and its brake closes [rad/s]
  std::int64_t quick_stop_ns = 500'000'000;  ///< time after which the brake closes in any case
};

/// Parameters for the arm of a device file, chosen: encoders of 20 bits a turn; torque steps of a permille of the
/// joint's limit, which is also the brake's torque; velocity loops of 100 rad/s, tuned with all joints halfway to their
/// upper limits.
std::array<JointHardwareParameters, kMaxJoints> usual_hardware(const ArmModel& model) noexcept;

/// Progress of a drive's own stop.
enum class Stopping : std::uint8_t {
  kSlowing,   ///< torque acts; at the end the brake closes
  kHeld,      ///< the brake holds: the torque may be switched off
  kRunsAway,  ///< the joint becomes faster
};

/// The mechanics of a joint's drive: motor torque in steps, brake with delays, encoder counter, and the velocity loop
/// that brings the joint to rest. The drive's states are in the classes that use it. The caller passes the time.
/// Real-time safe.
class JointMotor {
 public:
  JointMotor() = default;
  explicit JointMotor(const JointHardwareParameters& parameters) noexcept : parameters_(parameters) {}

  const JointHardwareParameters& parameters() const noexcept { return parameters_; }

  /// Advances the brake to `now_ns`. Called at each step of the plant, before the other functions.
  void update(std::int64_t now_ns) noexcept;

  /// Sets the torque [Nm], clamped to the limit and rounded to the step. A NaN is zero.
  void set_torque(double torque) noexcept { torque_ = rounded(torque); }
  void set_brake(bool open, std::int64_t now_ns) noexcept;

  /// Switches the torque off at once; the brake closes after it.
  void cut(std::int64_t now_ns) noexcept;

  /// Starts the stop from the present torque, at the joint's position and velocity [rad, rad/s].
  void begin_stop(std::int64_t now_ns, double position, double velocity) noexcept;
  Stopping stop(std::int64_t now_ns, double position, double velocity) noexcept;

  double torque() const noexcept { return torque_; }                                 ///< as the drive commands it [Nm]
  double motor_torque() const noexcept { return parameters_.motor_sign * torque_; }  ///< on the joint [Nm]
  double brake_torque() const noexcept { return brake_holds_ ? parameters_.brake_torque : 0.0; }
  bool brake_holds() const noexcept { return brake_holds_; }

  /// The encoder's counter at a position; only with an `encoder_step`.
  std::int32_t counter(double position) const noexcept;

 private:
  double rounded(double torque) const noexcept;

  JointHardwareParameters parameters_;
  double torque_ = 0.0;
  bool brake_open_ = false;  ///< requested state
  bool brake_holds_ = true;  ///< actual state
  std::int64_t brake_since_ns_ = 0;
  std::int64_t stop_since_ns_ = 0;
  double stop_position_ = 0.0;
  double stop_speed_ = 0.0;
  double stop_torque_ = 0.0;
};

}  // namespace godobject::sim
