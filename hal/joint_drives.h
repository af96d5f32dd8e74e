#pragma once

#include <array>
#include <cstdint>

#include "core/device/joint_vector.h"

namespace godobject::hal {

/// What a drive says of itself.
enum class DriveState : std::uint8_t {
  kOff,          ///< no torque, brake closed: what a drive is in until it is enabled, and after a quick stop has ended
  kEnabled,      ///< torque follows the command, brake open
  kQuickStop,    ///< the drive brings its joint to rest by itself, then closes its brake
  kFault,        ///< the drive has tripped: no torque, brake closing; left by a reset only
  kUnavailable,  ///< it does not answer
};

/// What the drives are asked for.
enum class PowerRequest : std::uint8_t {
  kOff,        ///< no torque, brakes closed
  kEnable,     ///< torque follows the command, brakes open
  kQuickStop,  ///< come to rest by the drives' own means, then brakes
  kReset,      ///< leave kFault for kOff
};

/// What a bus or a drive says beside its state. Each is a reason to take power away.
enum class Alarm : std::uint8_t {
  kNone,
  kBusDown,           ///< an interface is down, or its controller has left the bus
  kBadFrames,         ///< three frames in a row that a drive cannot have sent
  kNodeReset,         ///< a drive has started anew
  kHeartbeatLost,     ///< a drive's heartbeat stayed away
  kDriveError,        ///< a drive has sent an emergency message
  kWrongMode,         ///< a drive is not in cyclic synchronous torque, or not operational
  kForeignMaster,     ///< somebody else sends what only this controller may
  kForeignWrite,      ///< somebody else has written to a drive
  kParameterChanged,  ///< a drive's parameter is no longer what was written at the start
  kAnswersLate,       ///< a drive answers a period late
  kPanelLost,         ///< the operator's panel does not answer any more
  kPanelSilent,       ///< the operator's panel has not told its inputs since the start
};

/// Joint side, SI; entries from the joint count on are zero. What is not fresh keeps its last value.
struct JointReading {
  JointVector position = JointVector::Zero();   ///< [rad]
  JointVector torque = JointVector::Zero();     ///< as the drive measures it [Nm]
  std::array<std::uint32_t, kMaxJoints> age{};  ///< cycles since position and state came; 0: in this one
  std::array<DriveState, kMaxJoints> state{};   ///< of each drive
  bool emergency_stop = false;                  ///< the emergency stop is pressed, or its line is dead
  bool enable_switch = false;                   ///< the operator holds the enable switch
  bool clutch_open = false;                     ///< the operator moves the arm without moving in the scene
  Alarm alarm = Alarm::kNone;                   ///< the first one since the last reset
  int alarm_joint = -1;                         ///< whose it is; -1: nobody's
};

/// Joint side, SI; entries from the joint count on are ignored.
struct JointCommand {
  JointVector torque = JointVector::Zero();  ///< [Nm]; a drive that is not enabled ignores it
  PowerRequest power = PowerRequest::kOff;   ///< the same for all joints
};

/// The joints as the control cycle sees them: `request`, `receive` and `send` once a cycle, in this order; `receive`
/// belongs `collect_ns` after `request`. They never block, allocate or throw. Power requests are levels, not edges:
/// they are repeated each cycle, and the drives get there when they can.
class JointDrives {
 public:
  virtual ~JointDrives() = default;

  /// Returns the number of joints, 1 to kMaxJoints.
  virtual int joint_count() const noexcept = 0;

  /// Asks all joints for a sample of now: the beginning of the cycle.
  virtual void request() noexcept = 0;

  /// In which the samples come, after `request` [ns].
  virtual std::int64_t collect_ns() const noexcept = 0;

  /// Takes what has come since the last call; what is due beside samples and torques is sent then.
  virtual void receive(JointReading& reading) noexcept = 0;

  /// Torques for this cycle. False: not all of them could be handed over; counted by the caller as lost.
  virtual bool send(const JointCommand& command) noexcept = 0;

  /// From the sample of a position to the torque that answers it [s]: t_d of the stability figures, without the hold's
  /// half period.
  virtual double delay() const noexcept = 0;

 protected:
  JointDrives() = default;
  JointDrives(const JointDrives&) = default;
  JointDrives& operator=(const JointDrives&) = default;
};

}  // namespace godobject::hal
