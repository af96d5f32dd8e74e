#pragma once

#include <cstdint>

#include "hal/can_frame.h"

namespace godobject::sim {

enum class BusFaultKind : std::uint8_t {
  kFrameDropped,      ///< frames with `id` reach nobody; the controller's own come back to it
  kFrameDelayed,      ///< they arrive `value` cycles late; it is told from a fresh one if it comes before the next SYNC
  kFrameDuplicated,   ///< they arrive twice
  kFrameReordered,    ///< they arrive after the next frame on the bus
  kFrameLength,       ///< they arrive with `value` bytes
  kFrameReplaced,     ///< they arrive with the data and the length of `frame`
  kForeignFrame,      ///< somebody else sends `frame`, `value` times in each cycle as far as the bus has room
  kEmergency,         ///< `node` sends an emergency message with the code `value`
  kNodeReset,         ///< `node` starts anew by itself
  kHeartbeatStops,    ///< `node` sends no heartbeat
  kSdoRefused,        ///< `node` aborts each SDO transfer with the code `value`
  kParameterChanged,  ///< object `index`:`sub` of `node` becomes `value`
  kBusOff,            ///< the controller leaves the bus, and stays away
  kInterfaceDown,     ///< the controller's interface is down in these cycles
  kTransmitQueueFull,  ///< the controller's queue takes nothing in these cycles
};

/// What goes wrong on a bus, in which cycles: those from `first_cycle` on, counted from time zero, `cycles` of them.
/// A drive or panel that boots late or never is one whose supply is lost at first, see DriveFault.
struct BusFault {
  BusFaultKind kind = BusFaultKind::kFrameDropped;
  int bus = 0;
  std::int64_t first_cycle = 0;
  std::int64_t cycles = 1;
  std::uint16_t id = 0;
  int node = 0;
  double value = 0.0;
  hal::CanFrame frame{};
  std::uint16_t index = 0;
  std::uint8_t sub = 0;

  bool is_on(std::int64_t cycle) const noexcept { return cycle >= first_cycle && cycle - first_cycle < cycles; }
  bool begins(std::int64_t cycle) const noexcept { return cycle == first_cycle; }
};

}  // namespace godobject::sim
