#pragma once

#include <cstdint>

#include "hal/joint_drives.h"

namespace godobject::firmware {

/// Reasons to take the power away. The supervisor latches the first one. Telemetry has their numbers.
enum class Fault : std::uint8_t {
  kNone,
  kDrivesAbsent,    ///< not all drives answered in time
  kNotAtRest,       ///< a joint moved although its brake was closed
  kPositionLost,    ///< a joint had no usable position three times in a row, or too often
  kPositionJump,    ///< an impossible position, twice in a row or too often
  kNotFinite,       ///< a NaN or Inf in a reading
  kEncoderStuck,    ///< a position does not change although its joint should move
  kComputation,     ///< the cycle could not be computed
  kOverruns,        ///< the loop overran its period too often, or by too much
  kDriveLeft,       ///< a drive is no longer enabled, or did not become so
  kAlarm,           ///< a bus or a drive raised an alarm: the reading's alarm
  kSendFailed,      ///< torques could not be handed over three times in a row
  kEmergencyStop,   ///< the emergency stop is pressed, or its line is dead
  kEnableReleased,  ///< the operator released the enable switch
  kJointLimit,      ///< a joint is beyond its position limit
  kTooFast,         ///< hand or joint is above its stop speed, or a joint runs away
  kSignWrong,       ///< a joint moves against its torque, or without one
  kSignUndecided,   ///< a joint does not move when pushed, or the hand is not still
  kOutsideLimits,   ///< a joint is beyond its position limit before the start
  kComputedLate,    ///< cycles computed for longer than planned too often, or by too much
  kNotBalanced,     ///< the torque of wrong masses moved the tool before the arm rendered
  kDrifts,          ///< the torque of wrong masses moved the tool over a long way
  kTorqueWrong,     ///< a drive's measured torque does not follow the torque sent
  kDriveLimited,    ///< a drive limited its torque by itself for too long
};

inline constexpr Fault kLastFault = Fault::kDriveLimited;

/// The fault, or the alarm, as one clause with the cure. Never null.
const char* describe(Fault fault) noexcept;
const char* describe(hal::Alarm alarm) noexcept;

}  // namespace godobject::firmware
