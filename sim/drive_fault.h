#pragma once

#include <cstdint>
#include <span>

namespace godobject::sim {

enum class FaultKind : std::uint8_t {
  kEncoderJump,       ///< `value` [rad] is added to the position read
  kEncoderNotFinite,  ///< the position read is NaN
  kEncoderStuck,      ///< the position read stays what it was when the fault began
  kReadingLost,       ///< what the joint sends in these cycles never comes
  kReadingLate,       ///< what comes is `value` cycles old, 15 at most
  kDriveTrips,        ///< kFault
  kDriveDisabled,     ///< the drive goes off without being asked
  kModeSlips,         ///< it shows the mode `value` and follows no torque, its statusword as before; CAN drives only
  kSendFails,         ///< `send` returns false; the joint's command goes nowhere
  kCommandLost,       ///< `send` returns true; the joint's command goes nowhere
  kSupplyLost,        ///< no power: the joint is limp until its brake has closed, and does not answer
  kEmergencyStop,     ///< pressed
  kEnableReleased,    ///< the operator lets go of the enable switch
  kClutchOpen,        ///< the operator opens the clutch: no fault, but a thing that happens
};

inline constexpr int kAllJoints = -1;

/// What goes wrong, in which cycles: those from `first_cycle` on, counted from time zero, `cycles` of them.
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
