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

/// What a joint's drive says of itself, and what it did when its mode was changed and its RPDOs stayed away.
struct JointTrial {
  std::optional<std::uint32_t> device_type;   ///< 1000; nothing: it did not say
  std::optional<std::uint32_t> vendor;        ///< 1018:1
  std::optional<std::uint32_t> product;       ///< 1018:2
  std::optional<std::uint32_t> rated_torque;  ///< 6076 [mNm]
  double position = 0.0;                      ///< of the joint, by the device file's counts, gear, sign and zero [rad]
  int mode_after_ms = -1;                     ///< until TPDO2 told of another mode, the longer of two; -1: it did not
  bool mode_refused = false;                  ///< it does not take mode 0, with which that is tried
  int after_ms = -1;                          ///< from the last RPDO until something was seen; -1: nothing was
  std::uint16_t emergency = 0;                ///< code of the emergency message; 0: none came
  bool fault = false;                         ///< its statusword showed a fault
  bool in_time = false;                       ///< emergency 8250 or a fault, no later than it may be seen
};

/// Tries each drive in turn, without power, right after the start. Its mode is set to none and back: TPDO2 must tell of
/// both within kModeAtOnce_ms. Then the deadline of its RPDOs: cycles of a millisecond in which it gets none while all
/// other joints do. A deadline that has run out may be seen two cycles
/// after it, and is waited for kPatience_ms longer. `buses`: as those of `drives`.
/// Throws command::Failure (kUnavailable): the drives do not answer, an alarm that is none of this came up, one cannot
/// be reset, or `end` became true.
std::vector<JointTrial> try_drives(hal::CanDrives& drives, const hal::BusLayout& layout,
                                   std::span<hal::CanBus* const> buses, hal::Clock& clock,
                                   const std::vector<std::string>& names, const std::atomic<bool>& end);

inline constexpr int kPatience_ms = 50;
inline constexpr int kModeAtOnce_ms = 20;  ///< far from the refresh that comes anyway

/// A line a joint; each ends with a line feed.
std::string trial_table(const hal::BusLayout& layout, std::span<const JointTrial> trials);

/// The joints whose mode or deadline was not seen, and how a deadline can be tested else, as one line without its end;
/// empty: all were.
std::string trial_objection(std::span<const JointTrial> trials);

}  // namespace godobject::firmware
