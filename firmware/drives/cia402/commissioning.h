#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/cia402/can_drives.h"
#include "hal/clock.h"

namespace godobject::firmware {

/// Identity of a joint's drive, and its reactions to a change of mode and to missing RPDOs.
struct JointTrial {
  std::optional<std::uint32_t> device_type;   ///< object 1000; none: no answer
  hal::DriveIdentity identity;                ///< 1018, as far as the drive has it
  std::optional<std::uint32_t> rated_torque;  ///< 6076 [mNm]
  double position = 0.0;        ///< joint position by counts, gear, sign and zero of the device file [rad]
  int mode_after_ms = -1;       ///< time until TPDO2 showed another mode, the longer of two; -1: it did not
  bool mode_refused = false;    ///< the drive refuses mode 0, which the test needs
  int after_ms = -1;            ///< time from the last RPDO to a reaction; -1: there was none
  std::uint16_t emergency = 0;  ///< code of the emergency message; 0: none
  bool fault = false;           ///< the statusword showed a fault
  bool in_time = false;         ///< emergency 8250 or a fault within the deadline and kSeenAfter_ms
};

/// Tests each drive in turn, without power, right after the start. First the mode is set to none and back: TPDO2 must
/// show both changes within kModeAtOnce_ms. Then the deadline of the RPDOs: for some cycles this drive
/// gets none while all other drives do. Its reaction must be seen within the deadline and kSeenAfter_ms; the test
/// waits kPatience_ms longer. `buses`: those of `drives`. Throws command::Failure (kUnavailable) if the drives do not
/// answer, another alarm occurs, a drive cannot be reset, or `end` becomes true.
std::vector<JointTrial> try_drives(hal::CanDrives& drives, const hal::BusLayout& layout,
                                   std::span<hal::CanBus* const> buses, hal::Clock& clock,
                                   const std::vector<std::string>& names, const std::atomic<bool>& end);

/// Chosen: ten times the usual deadline, so that a late reaction is shown with its time; a test of a joint takes as
/// long.
inline constexpr int kPatience_ms = 50;
/// Chosen: a tenth of a brake's or a power stage's time, and far below the periodic refresh of TPDO2, 1 s
/// (`BusLayout::mode_refresh`), which a drive sends even if it misses the change.
inline constexpr int kModeAtOnce_ms = 20;
/// Derived: a drive reacts within a cycle of its deadline, and its frame is read at the end of the next cycle. 1400:5
/// counts milliseconds, so a drive may react a millisecond later. Two cycles at least.
inline constexpr int kSeenAfter_ms = 2;

/// The results as a table: one line a joint, each with a line feed.
std::string trial_table(const hal::BusLayout& layout, std::span<const JointTrial> trials);

/// The identities of the drives as keys for the device file: one line a joint, each with a line feed.
std::string identity_keys(const hal::BusLayout& layout, std::span<const JointTrial> trials);

/// The joints that failed, and how to test a deadline in another way, as one line without a line feed; empty: all
/// passed.
std::string trial_objection(std::span<const JointTrial> trials);

}  // namespace godobject::firmware
