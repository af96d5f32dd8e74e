#pragma once

#include <cstdint>

namespace godobject::hal::cia402 {

/// The power states of CiA 402.
enum class PowerState : std::uint8_t {
  kNotReady,
  kSwitchOnDisabled,
  kReadyToSwitchOn,
  kSwitchedOn,
  kOperationEnabled,
  kQuickStopActive,
  kFaultReaction,
  kFault,
  kUnknown,  ///< a statusword that the standard does not define
};

/// The power state that a drive shall reach.
enum class PowerGoal : std::uint8_t {
  kOff,        ///< switch-on disabled, at once
  kEnabled,    ///< operation enabled
  kQuickStop,  ///< come to rest, then switch-on disabled
  kReset,      ///< out of a fault; otherwise off
};

enum Statusword : std::uint16_t {
  kStatusRemote = 1u << 9,
  kStatusInternalLimit = 1u << 11,  ///< the drive gives less than the command: current, voltage or heat limit it
  kStatusFollowsTarget = 1u << 12,  ///< in cyclic synchronous torque mode: the drive follows 6071
};

enum Controlword : std::uint16_t {
  kDisableVoltage = 0x00,    ///< T7, T9, T10, T12
  kQuickStopCommand = 0x02,  ///< T11; T7, T10
  kShutdown = 0x06,          ///< T2, T6, T8
  kSwitchOn = 0x07,          ///< T3, T5
  kEnableOperation = 0x0F,   ///< T4, T16
  kFaultReset = 0x80,        ///< T15, by its rising edge
};

/// Decodes a statusword by its state bits.
PowerState power_state(std::uint16_t statusword) noexcept;

/// The controlword for the next transition from `state` towards `goal`, one transition at a time. Only `kReset` ends a
/// fault, and only while `reset_bit`: the caller lets it rise. A quick stop is never interrupted into operation (T16),
/// and no drive is enabled out of a fault.
Controlword next_controlword(PowerState state, PowerGoal goal, bool reset_bit) noexcept;

}  // namespace godobject::hal::cia402
