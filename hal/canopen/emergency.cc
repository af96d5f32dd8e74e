#include "hal/canopen/emergency.h"

#include "hal/canopen/little_endian.h"
#include "hal/canopen/network.h"

namespace godobject::hal::canopen {

bool parse_emergency(const CanFrame& frame, Emergency& emergency) noexcept {
  const int node = node_of(frame.id, kCobEmergency);
  if (node == 0 || frame.length != 8) return false;
  emergency = {node, static_cast<std::uint16_t>(load(frame.data, 0, 2)), frame.data[2]};
  return true;
}

bool is_warning(std::uint16_t code) noexcept { return code == 0x0000 || code == 0x8110 || code == 0x8120; }

}  // namespace godobject::hal::canopen
