#include "hal/canopen/network.h"

namespace godobject::hal::canopen {

bool parse_heartbeat(const CanFrame& frame, Heartbeat& heartbeat) noexcept {
  const int node = node_of(frame.id, kCobHeartbeat);
  if (node == 0 || frame.length != 1) return false;
  switch (frame.data[0]) {
    case kNmtBoot:
    case kNmtStopped:
    case kNmtOperational:
    case kNmtPreOperationalState: break;
    default: return false;
  }
  heartbeat = {node, static_cast<NmtState>(frame.data[0])};
  return true;
}

bool is_of_master(std::uint16_t id) noexcept {
  if (id == kCobNmt || id == kCobSync || id == kCobTime || id == kCobLssMaster) return true;
  if (id == cob(kCobHeartbeat, kControllerNode)) return true;
  for (std::uint16_t base = kCobRpdo1; base <= kCobRpdo4; base = static_cast<std::uint16_t>(base + 0x100)) {
    if (node_of(id, base) != 0) return true;
  }
  return node_of(id, kCobSdoRequest) != 0;
}

}  // namespace godobject::hal::canopen
