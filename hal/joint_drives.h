#pragma once

#include <array>
#include <cstdint>

#include "core/device/joint_vector.h"

namespace godobject::hal {

/// Returns how many cycles in a row without an answer count as a loss: 3, or those of 10 ms if they are fewer. Chosen:
/// a disturbance of two cycles must not stop the arm, nor may the last torque be held for long.
constexpr int cycles_to_loss(double period) noexcept {
  const int in_10_ms = static_cast<int>(10e-3 / period + 1e-9);
  return in_10_ms < 1 ? 1 : in_10_ms > 3 ? 3 : in_10_ms;
}

/// Returns for how long drives wait for torques by default before they stop by themselves [s]: 4 ms, or a period more
/// than a loss takes.
constexpr double default_deadline(double period) noexcept {
  const double a_loss = (cycles_to_loss(period) + 1) * period;
  return a_loss > 4e-3 ? a_loss : 4e-3;
}

/// State of a drive, as it reports it.
enum class DriveState : std::uint8_t {
  kOff,          ///< no torque, brake closed: before it is enabled and after a quick stop
  kEnabled,      ///< torque follows the command, brake open
  kQuickStop,    ///< the drive brings its joint to rest, then closes its brake
  kFault,        ///< the drive has tripped: no torque, brake closing; only a reset ends it
  kUnavailable,  ///< the drive does not answer
};

/// Power that the controller requests from all drives.
enum class PowerRequest : std::uint8_t {
  kOff,        ///< no torque, brakes closed
  kEnable,     ///< torque follows the command, brakes open
  kQuickStop,  ///< the drives come to rest by themselves, then close the brakes
  kReset,      ///< leave kFault for kOff
};

/// An event of a bus or a drive. Each is a reason to take the power away.
enum class Alarm : std::uint8_t {
  kNone,
  kBusDown,           ///< an interface is down or bus-off
  kBadFrames,         ///< three invalid frames in a row from a drive
  kNodeReset,         ///< a drive has restarted
  kHeartbeatLost,     ///< a drive's heartbeat is missing
  kDriveError,        ///< a drive has sent an emergency message
  kWrongMode,         ///< a drive left cyclic synchronous torque mode or the operational state
  kForeignMaster,     ///< another node sends frames that only this controller may send
  kForeignWrite,      ///< another node has written to a drive
  kParameterChanged,  ///< a drive's parameter differs from the value written at the start
  kAnswersLate,       ///< a drive answers one period late
  kPanelLost,         ///< the operator's panel no longer answers
  kPanelSilent,       ///< the operator's panel has not sent its inputs since the start
  kTooHot,            ///< a drive's temperature is at or above the one that stops the arm
  kTemperatureLost,   ///< a drive has not answered three requests in a row for its temperature
};

/// A reading of all joints in SI, at the joint's side of the gear. Entries from the joint count on are zero. A joint
/// without a fresh sample keeps its last values.
struct JointReading {
  JointVector position = JointVector::Zero();       ///< [rad]
  JointVector torque = JointVector::Zero();         ///< measured by the drive [Nm]
  std::array<std::uint32_t, kMaxJoints> age{};      ///< cycles since the last sample; 0: fresh
  std::array<DriveState, kMaxJoints> state{};       ///< power state of each drive
  std::array<bool, kMaxJoints> warm{};              ///< the drive's temperature is at or above its warning
  std::array<bool, kMaxJoints> temperature_lost{};  ///< the last request for the drive's temperature was not answered
  std::array<bool, kMaxJoints> limited{};  ///< the drive gives less torque than commanded, by a limit of its own
  bool emergency_stop = false;             ///< the emergency stop is pressed, or its line is dead
  bool enable_switch = false;              ///< the operator holds the enable switch
  bool clutch_open = false;                ///< the operator moves the arm without moving the mesh
  Alarm alarm = Alarm::kNone;              ///< the first alarm since the last reset
  int alarm_joint = -1;                    ///< joint of the alarm; -1: no single joint
};

/// A command to all joints.
struct JointCommand {
  JointVector torque = JointVector::Zero();  ///< [Nm]; a drive that is not enabled ignores it
  PowerRequest power = PowerRequest::kOff;   ///< the same for all joints
};

/// The drive interface of the control cycle. `request`, `receive` and `send` are called once a cycle in this order,
/// with `receive` `collect_ns` after `request`. They never block, allocate or throw. Power requests are levels, not
/// edges: they are repeated each cycle, and a drive reaches the state as soon as it can.
class JointDrives {
 public:
  virtual ~JointDrives() = default;

  /// Returns the number of joints, 1 to kMaxJoints.
  virtual int joint_count() const noexcept = 0;

  /// Asks all joints for a sample of the present time: the beginning of a cycle.
  virtual void request() noexcept = 0;

  /// Time after `request` by which all samples have arrived [ns].
  virtual std::int64_t collect_ns() const noexcept = 0;

  /// Takes the samples that have arrived since the last call. Sends messages other than samples and torques that are
  /// due.
  virtual void receive(JointReading& reading) noexcept = 0;

  /// Sends the command of this cycle. False: not all torques could be handed over; the caller counts that.
  virtual bool send(const JointCommand& command) noexcept = 0;

  /// Longest time from the sample of a position to the torque that answers it [s]: t_d of the stability analysis,
  /// without half a period of hold.
  virtual double delay() const noexcept = 0;

 protected:
  JointDrives() = default;
  JointDrives(const JointDrives&) = default;
  JointDrives& operator=(const JointDrives&) = default;
};

}  // namespace godobject::hal
