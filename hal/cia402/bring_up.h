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
    kBusDown,         ///< an interface is down, or its controller has left the bus
    kSecondMaster,    ///< somebody else sends what only a master may: `found` is the COB-ID
    kCannotSend,      ///< the queue of an interface stayed full
    kNoBootUp,        ///< a node did not boot in time
    kStartedAnew,     ///< a node booted once more while it was being set up
    kNoAnswer,        ///< a node did not answer an SDO request
    kRefused,         ///< a node aborted an SDO transfer: `found` is the abort code
    kWrongSize,       ///< an object has `found` bytes in place of `expected`; 0: more than four
    kWrongValue,      ///< an object reads `found` in place of `expected`
    kTooLow,          ///< an object reads `found`, which is less than `expected`
    kWrongRatio,      ///< sub-indices 1 and 2 of an object give `ratio_found` in place of `ratio_expected`
    kNotOperational,  ///< a node did not become operational
    kEnded,           ///< it was asked to end
    kModeNotTold,     ///< a drive is operational, but does not tell its mode by TPDO2
};

/// How far the start of all nodes came. Of the first thing that went wrong: `bus`, and where it makes sense `node`,
/// `joint`, and object.
struct BringUpResult {
  BringUpStatus status = BringUpStatus::kOk;
  int bus = -1;
  int node = 0;    ///< 0: no node's matter
  int joint = -1;  ///< -1: no joint's
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  std::uint32_t expected = 0;
  std::uint32_t found = 0;
  double ratio_expected = 0.0;
  double ratio_found = 0.0;
  bool began = false;  ///< something has been sent
};

/// What a status means and what to do about it, without the numbers.
const char* describe(BringUpStatus status) noexcept;

/// Starts all drives and the panel; no torque is sent, nothing is enabled.
///
/// Listens for 100 ms and refuses a second master, resets communication, waits for every node's boot-up for up to
/// `boot_timeout`, identifies, sets up and reads back each by SDO (cia402/parameters.h), starts the nodes and waits
/// until each says that it is operational and each drive has told its mode by TPDO2. Takes 0.15 s and 0.08 s a node
/// with nodes that answer within a millisecond. Sleeps in steps of a millisecond. Encoder resolution (608F) and gear
/// (6091) of drives that have them must be the layout's `counts` and `gear`; a gear of 1 is one that the drive does not
/// know of. `end`: once it is true the start ends within a millisecond; may be null. `buses`: one each of the layout's.
/// `tap` may be null. Allocates nothing, throws nothing.
BringUpResult bring_up(const BusLayout& layout, std::span<CanBus* const> buses, Clock& clock, FrameTap* tap,
                       const std::atomic<bool>* end = nullptr) noexcept;

}  // namespace godobject::hal
