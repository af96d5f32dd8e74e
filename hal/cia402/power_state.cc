#include "hal/cia402/power_state.h"

#include <array>
#include <cstddef>

namespace godobject::hal::cia402 {
namespace {

struct Pattern {
  std::uint16_t mask;
  std::uint16_t value;
  PowerState state;
};

constexpr std::array<Pattern, 8> kPatterns = {{
    {0x4F, 0x00, PowerState::kNotReady},
    {0x4F, 0x40, PowerState::kSwitchOnDisabled},
    {0x6F, 0x21, PowerState::kReadyToSwitchOn},
    {0x6F, 0x23, PowerState::kSwitchedOn},
    {0x6F, 0x27, PowerState::kOperationEnabled},
    {0x6F, 0x07, PowerState::kQuickStopActive},
    {0x4F, 0x0F, PowerState::kFaultReaction},
    {0x4F, 0x08, PowerState::kFault},
}};

struct Row {
  Controlword off;
  Controlword enabled;
  Controlword quick_stop;
};

// The quick stop is sent in every state but the faults: the drive may already be one transition further than reported.
constexpr std::array<Row, 9> kNext = {{
    {kDisableVoltage, kDisableVoltage, kQuickStopCommand},    // not ready: T1 comes by itself
    {kDisableVoltage, kShutdown, kQuickStopCommand},          // switch-on disabled: T2
    {kDisableVoltage, kSwitchOn, kQuickStopCommand},          // ready: T7, T3, T7
    {kDisableVoltage, kEnableOperation, kQuickStopCommand},   // switched on: T10, T4, T10
    {kDisableVoltage, kEnableOperation, kQuickStopCommand},   // operation enabled: T9, stays, T11
    {kDisableVoltage, kQuickStopCommand, kQuickStopCommand},  // quick stop: T12, stays, stays
    {kDisableVoltage, kDisableVoltage, kDisableVoltage},      // fault reaction: T14 comes by itself
    {kDisableVoltage, kDisableVoltage, kDisableVoltage},      // fault
    {kDisableVoltage, kDisableVoltage, kQuickStopCommand},    // unknown
}};

}  // namespace

PowerState power_state(std::uint16_t statusword) noexcept {
  for (const Pattern& pattern : kPatterns) {
    if ((statusword & pattern.mask) == pattern.value) return pattern.state;
  }
  return PowerState::kUnknown;
}

Controlword next_controlword(PowerState state, PowerGoal goal, bool reset_bit) noexcept {
  const Row& row = kNext[static_cast<std::size_t>(state)];
  switch (goal) {
    case PowerGoal::kEnabled: return row.enabled;
    case PowerGoal::kQuickStop: return row.quick_stop;
    case PowerGoal::kReset:
      if (state == PowerState::kFault && reset_bit) return kFaultReset;
      break;
    case PowerGoal::kOff: break;
  }
  return row.off;
}

}  // namespace godobject::hal::cia402
