#pragma once

#include <array>
#include <cstdint>

#include "core/device/arm_model.h"

namespace godobject::sim {

/// Motor, encoder, brake and drive of one joint, at the joint's side of the gear.
struct JointHardwareParameters {
  double encoder_step = 0.0;         ///< what a count stands for [rad]; 0: exact
  std::int32_t counter_at_zero = 0;  ///< counts at q = 0; the counter wraps like any 32 bit number
  double torque_step = 0.0;   ///< what torques are rounded to, usually a permille of the rated one [Nm]; 0: exact
  double motor_sign = 1.0;    ///< -1: the motor is connected the wrong way round, and its drive does not know
  double torque_limit = 0.0;  ///< [Nm]
  double brake_torque = 0.0;  ///< that the closed brake holds [Nm]
  std::int64_t brake_open_ns = 25'000'000;   ///< from current on to free; until then it holds
  std::int64_t brake_close_ns = 20'000'000;  ///< from current off to closed; until then it is free
  std::int64_t enable_ns = 3'000'000;        ///< from the request to the power stage, before the brake begins to open
  std::int64_t command_deadline_ns = 4'000'000;  ///< an enabled drive trips when no command came for longer
  double quick_stop_damping = 0.0;               ///< of the drive's own velocity loop [Nms/rad]
  double quick_stop_stiffness = 0.0;             ///< its integral action: of the position where the stop began [Nm/rad]
  double stop_speed_margin = 0.5;  ///< a drive trips if a quick stop makes its joint faster by so much [rad/s]
  double rest_velocity = 0.01;     ///< below it the joint is at rest and its brake closes [rad/s]
  std::int64_t quick_stop_ns = 500'000'000;  ///< after which the brake closes in any case
};

/// Figures for a device file's arm: encoders of 20 bits a turn, torques in permille of each joint's greatest, which is
/// also what its brake holds; velocity loops of 100 rad/s, tuned with all joints halfway to their upper limits.
std::array<JointHardwareParameters, kMaxJoints> usual_hardware(const ArmModel& model) noexcept;

/// How a stop of the drive's own goes on.
enum class Stopping : std::uint8_t {
  kSlowing,   ///< torque acts; at the end the brake is closing
  kHeld,      ///< the brake holds: torque may go
  kRunsAway,  ///< the joint becomes faster instead
};

/// What of a joint's drive is mechanics: the motor's torque in its steps, the brake with its delays, the encoder's
/// counter, and the velocity loop that brings the joint to rest. What commands them is somebody else's. In time that is
/// passed in; real-time safe.
class JointMotor {
 public:
  JointMotor() = default;
  explicit JointMotor(const JointHardwareParameters& parameters) noexcept : parameters_(parameters) {}

  const JointHardwareParameters& parameters() const noexcept { return parameters_; }

  /// Lets the brake move on to `now_ns`. Called at each step of the plant, before what follows.
  void update(std::int64_t now_ns) noexcept;

  /// Within its limit and in its steps [Nm]; a NaN is zero.
  void set_torque(double torque) noexcept { torque_ = rounded(torque); }
  void set_brake(bool open, std::int64_t now_ns) noexcept;

  /// Torque off at once, the brake closes behind it.
  void cut(std::int64_t now_ns) noexcept;

  /// The loop starts from the torque that acts, at the joint's position and velocity [rad, rad/s].
  void begin_stop(std::int64_t now_ns, double position, double velocity) noexcept;
  Stopping stop(std::int64_t now_ns, double position, double velocity) noexcept;

  double torque() const noexcept { return torque_; }                                 ///< as the drive has it [Nm]
  double motor_torque() const noexcept { return parameters_.motor_sign * torque_; }  ///< on the joint [Nm]
  double brake_torque() const noexcept { return brake_holds_ ? parameters_.brake_torque : 0.0; }
  bool brake_holds() const noexcept { return brake_holds_; }

  /// What the encoder's counter shows at a position; only with an `encoder_step`.
  std::int32_t counter(double position) const noexcept;

 private:
  double rounded(double torque) const noexcept;

  JointHardwareParameters parameters_;
  double torque_ = 0.0;
  bool brake_open_ = false;  ///< what is asked of it
  bool brake_holds_ = true;  ///< what it does
  std::int64_t brake_since_ns_ = 0;
  std::int64_t stop_since_ns_ = 0;
  double stop_position_ = 0.0;
  double stop_speed_ = 0.0;
  double stop_torque_ = 0.0;
};

}  // namespace godobject::sim
