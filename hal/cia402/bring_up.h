#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "hal/can_bus.h"
#include "hal/cia402/bus_layout.h"
#include "hal/clock.h"
#include "hal/frame_tap.h"

namespace godobject::hal {

enum class [[nodiscard]] BringUpStatus : std::uint8_t{
    kOk,
    kBusDown,         ///< an interface is down or bus-off
    kSecondMaster,    ///< another master sends frames: `found` is the COB-ID
    kCannotSend,      ///< the queue of an interface stayed full
    kNoBootUp,        ///< a node did not boot in time
    kStartedAnew,     ///< a node rebooted during its setup
    kNoAnswer,        ///< a node did not answer an SDO request
    kRefused,         ///< a node aborted an SDO transfer: `found` is the abort code
    kWrongSize,       ///< an object has `found` bytes in place of `expected`; 0: more than four
    kWrongValue,      ///< an object reads `found` in place of `expected`
    kTooLow,          ///< an object reads `found`, less than `expected`
    kWrongRatio,      ///< sub-indices 1 and 2 of an object give `ratio_found` in place of `ratio_expected`
    kNotOperational,  ///< a node did not become operational
    kEnded,           ///< the start was asked to end
    kModeNotTold,     ///< a drive is operational, but does not send its mode by TPDO2
    kWrongDrive,      ///< a field of the identity is `found` in place of `expected`
    kDriveElsewhere,  ///< as kWrongDrive, and the expected drive answers as that of joint `other_joint`
    kDrivesSwapped,   ///< as kDriveElsewhere, and that joint's expected drive answers here
    kTooHot,          ///< a drive's temperature is `celsius`, at or above `most_celsius`
    kNoIdentity,      ///< a drive lacks a field of the identity that the layout gives: `expected`
};

/// Result of the start of all nodes. On failure: the first cause with its bus and, as far as they apply, node, joint
/// and object.
struct BringUpResult {
  BringUpStatus status = BringUpStatus::kOk;
  int bus = -1;
  int node = 0;    ///< 0: no single node
  int joint = -1;  ///< -1: no single joint
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  std::uint32_t expected = 0;
  std::uint32_t found = 0;
  double ratio_expected = 0.0;
  double ratio_found = 0.0;
  double celsius = 0.0;       ///< [degC]
  double most_celsius = 0.0;  ///< [degC]
  bool began = false;         ///< a frame was sent
  int other_joint = -1;       ///< joint at which the expected drive answers; -1: at none
};

/// The status as one clause with the cure, without the numbers. Never null.
const char* describe(BringUpStatus status) noexcept;

/// Starts all drives and the panel. Sends no torque and enables no drive.
///
/// Steps: listen for 100 ms and refuse a second master; reset communication; wait up to `boot_timeout` for the boot-up
/// of each node; read the identities of all drives (1018) and compare each field that the layout gives; check, set up
/// and read back each node by SDO (cia402/parameters.h); start the nodes; wait until each is operational and each drive
/// has sent its mode by TPDO2. Nothing is written to a drive before all identities are right. This takes 0.15 s plus
/// 0.1 s a node if nodes answer within a millisecond. Encoder resolution (608F) and gear (6091) of drives that have
/// them must equal the layout's `counts` and `gear`; 6091 may be 1, for a gear that the drive does not know of. A drive
/// must answer for its temperature, if the layout has one, and be cooler than the temperature that stops the arm.
///
/// `buses`: one for each bus of the layout. `tap`: may be null. `end`: the start ends within a millisecond after it
/// became true; may be null. Sleeps in steps of a millisecond. Does not allocate or throw.
BringUpResult bring_up(const BusLayout& layout, std::span<CanBus* const> buses, Clock& clock, FrameTap* tap,
                       const std::atomic<bool>* end = nullptr) noexcept;

}  // namespace godobject::hal
