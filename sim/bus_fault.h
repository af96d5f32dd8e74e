#pragma once

#include <cstdint>

#include "hal/can_frame.h"

namespace godobject::sim {

enum class BusFaultKind : std::uint8_t {
  kFrameDropped,       ///< frames with `id` reach no node; the controller's own ones return to it
  kFrameDelayed,       ///< frames with `id` arrive `value` cycles late
  kFrameDuplicated,    ///< frames with `id` arrive twice
  kFrameReordered,     ///< frames with `id` arrive after the next frame on the bus
  kFrameLength,        ///< frames with `id` arrive with `value` bytes
  kFrameReplaced,      ///< frames with `id` arrive with the data and the length of `frame`
  kForeignFrame,       ///< another node sends `frame` `value` times in each cycle, as far as the bus has room
  kEmergency,          ///< `node` sends an emergency message with the code `value`
  kNodeReset,          ///< `node` restarts by itself
  kHeartbeatStops,     ///< `node` sends no heartbeat
  kSdoRefused,         ///< `node` aborts each SDO transfer with the code `value`, or those of `index` if it is not 0
  kParameterChanged,   ///< object `index`:`sub` of `node` becomes `value`
  kBusOff,             ///< the controller becomes and stays bus-off
  kInterfaceDown,      ///< the controller's interface is down in these cycles
  kTransmitQueueFull,  ///< the controller's transmit queue takes no frame in these cycles
};

/// A fault on a bus: it lasts `cycles` cycles from `first_cycle` on, counted from time zero. A drive or panel that
/// boots late or never is one that has lost its supply at the start, see DriveFault.
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
  bool ends(std::int64_t cycle) const noexcept { return cycle == first_cycle + cycles; }
};

}  // namespace godobject::sim
