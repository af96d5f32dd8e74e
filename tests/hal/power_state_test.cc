#include "hal/cia402/power_state.h"

#include <gtest/gtest.h>

#include <array>

namespace godobject::hal::cia402 {
namespace {

constexpr std::array<PowerState, 9> kStates = {
    PowerState::kNotReady,         PowerState::kSwitchOnDisabled, PowerState::kReadyToSwitchOn, PowerState::kSwitchedOn,
    PowerState::kOperationEnabled, PowerState::kQuickStopActive,  PowerState::kFaultReaction,   PowerState::kFault,
    PowerState::kUnknown};

TEST(PowerStates, StatuswordsAsDrivesSendThem) {
  EXPECT_EQ(power_state(0x0000), PowerState::kNotReady);
  EXPECT_EQ(power_state(0x0250), PowerState::kSwitchOnDisabled);
  EXPECT_EQ(power_state(0x0270), PowerState::kSwitchOnDisabled);  // bit 5 says nothing here
  EXPECT_EQ(power_state(0x0231), PowerState::kReadyToSwitchOn);
  EXPECT_EQ(power_state(0x0233), PowerState::kSwitchedOn);
  EXPECT_EQ(power_state(0x1637), PowerState::kOperationEnabled);
  EXPECT_EQ(power_state(0x0617), PowerState::kQuickStopActive);
  EXPECT_EQ(power_state(0x021F), PowerState::kFaultReaction);
  EXPECT_EQ(power_state(0x0218), PowerState::kFault);
  EXPECT_EQ(power_state(0x0238), PowerState::kFault);
}

/// The standard's table, written out by its six bits: 0 ready, 1 switched on, 2 enabled, 3 fault, 5 quick stop, 6
/// disabled.
PowerState state_by_bits(int word) {
  const bool ready = (word & 1) != 0;
  const bool on = (word & 2) != 0;
  const bool enabled = (word & 4) != 0;
  const bool fault = (word & 8) != 0;
  const bool no_quick_stop = (word & 0x20) != 0;
  const bool disabled = (word & 0x40) != 0;
  const bool none = !ready && !on && !enabled;
  const bool all = ready && on && enabled;
  if (disabled) return none && !fault ? PowerState::kSwitchOnDisabled : PowerState::kUnknown;
  if (fault) return none ? PowerState::kFault : all ? PowerState::kFaultReaction : PowerState::kUnknown;
  if (none) return PowerState::kNotReady;
  if (all) return no_quick_stop ? PowerState::kOperationEnabled : PowerState::kQuickStopActive;
  if (ready && !enabled && no_quick_stop) return on ? PowerState::kSwitchedOn : PowerState::kReadyToSwitchOn;
  return PowerState::kUnknown;
}

TEST(PowerStates, EveryCombinationOfTheSixBits) {
  int found = 0;
  for (int word = 0; word < 0x10000; ++word) {
    const PowerState expected = state_by_bits(word);
    ASSERT_EQ(power_state(static_cast<std::uint16_t>(word)), expected) << std::hex << word;
    found += expected != PowerState::kUnknown ? 1 : 0;
  }
  EXPECT_EQ(found, 12 * 1024);  // 4 states with bit 5 fixed, 4 with both its values
}

/// The figure of the standard, by hand: rows as kStates, columns off, enabled, quick stop, reset, reset with the bit.
TEST(PowerStates, EveryStateTowardsEveryGoal) {
  constexpr std::array<std::array<int, 5>, 9> kExpected = {{
      {0x00, 0x00, 0x02, 0x00, 0x00},  // not ready to switch on: only T1, by itself
      {0x00, 0x06, 0x02, 0x00, 0x00},  // switch-on disabled: T2 shutdown
      {0x00, 0x07, 0x02, 0x00, 0x00},  // ready: T3 switch on; T7 disable voltage or quick stop
      {0x00, 0x0F, 0x02, 0x00, 0x00},  // switched on: T4 enable operation; T10
      {0x00, 0x0F, 0x02, 0x00, 0x00},  // operation enabled: stays; T9 disable voltage; T11 quick stop
      {0x00, 0x02, 0x02, 0x00, 0x00},  // quick stop active: T12; never T16
      {0x00, 0x00, 0x00, 0x00, 0x00},  // fault reaction active: only T14, by itself
      {0x00, 0x00, 0x00, 0x00, 0x80},  // fault: T15 fault reset
      {0x00, 0x00, 0x02, 0x00, 0x00},  // unknown: a state that the standard does not define
  }};
  for (std::size_t s = 0; s < kStates.size(); ++s) {
    const PowerState state = kStates[s];
    const std::array<int, 5>& row = kExpected[s];
    for (const bool bit : {false, true}) {
      EXPECT_EQ(next_controlword(state, PowerGoal::kOff, bit), row[0]) << s;
      EXPECT_EQ(next_controlword(state, PowerGoal::kEnabled, bit), row[1]) << s;
      EXPECT_EQ(next_controlword(state, PowerGoal::kQuickStop, bit), row[2]) << s;
    }
    EXPECT_EQ(next_controlword(state, PowerGoal::kReset, false), row[3]) << s;
    EXPECT_EQ(next_controlword(state, PowerGoal::kReset, true), row[4]) << s;
  }
}

}  // namespace
}  // namespace godobject::hal::cia402
