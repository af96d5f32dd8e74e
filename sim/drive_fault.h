#pragma once

#include <cstdint>
#include <span>

namespace godobject::sim {

/// Faults of drives and panel.
enum class FaultKind : std::uint8_t {
  kEncoderJump,       ///< the position read is `value` [rad] too large
  kEncoderNotFinite,  ///< the position read is NaN
  kEncoderStuck,      ///< the position read stays that of the first cycle
  kReadingLost,       ///< the joint's samples of these cycles never arrive
  kReadingLate,       ///< the joint's samples arrive `value` cycles late, 15 at most
  kDriveTrips,        ///< the drive trips: kFault
  kDriveDisabled,     ///< the drive switches off without a request
  kModeSlips,      ///< the drive reports mode `value` and ignores the torque, with the same statusword; CAN drives only
  kTemperature,    ///< the drive's temperature becomes `value` [degC] and stays so; CAN drives only
  kTorqueLimited,  ///< the drive gives at most `value` [Nm at the joint]; over CAN it shows its internal limit, too
  kSendFails,      ///< `send` returns false; the joint's command is lost
  kCommandLost,    ///< `send` returns true; the joint's command is lost
  kSupplyLost,     ///< the drive has no supply: no torque until its brake has closed, no answer
  kEmergencyStop,  ///< the emergency stop is pressed
  kEnableReleased,  ///< the operator releases the enable switch
  kClutchOpen,      ///< the operator opens the clutch (no fault)
};

inline constexpr int kAllJoints = -1;

/// A fault: it lasts `cycles` cycles from `first_cycle` on, counted from time zero.
struct DriveFault {
  FaultKind kind = FaultKind::kEncoderJump;
  int joint = kAllJoints;
  std::int64_t first_cycle = 0;
  std::int64_t cycles = 1;
  double value = 0.0;

  bool concerns(FaultKind asked, int asked_joint, std::int64_t cycle) const noexcept {
    return kind == asked && (joint == kAllJoints || joint == asked_joint) && cycle >= first_cycle &&
           cycle - first_cycle < cycles;
  }
};

/// The fault of this kind that concerns the joint in this cycle; null: none. Cost: linear in the script.
inline const DriveFault* find_fault(std::span<const DriveFault> script, FaultKind kind, int joint,
                                    std::int64_t cycle) noexcept {
  for (const DriveFault& fault : script) {
    if (fault.concerns(kind, joint, cycle)) return &fault;
  }
  return nullptr;
}

}  // namespace godobject::sim
