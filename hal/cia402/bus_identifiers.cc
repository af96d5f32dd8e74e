#include "hal/cia402/bus_identifiers.h"

#include "hal/canopen/network.h"
#include "hal/canopen/object_numbers.h"

namespace godobject::hal {

using namespace canopen;

BusIdentifiers::BusIdentifiers(const BusLayout& layout, int bus) noexcept {
  add(kCobNmt);
  add(kCobSync);
  add(kCobTime);
  add(kCobLssMaster);
  add(kCobHeartbeat + kControllerNode);
  for (const DriveConfig& drive : std::span(layout.drives).first(static_cast<std::size_t>(layout.joint_count))) {
    if (drive.bus == bus) add_node(drive.node);
  }
  if (layout.panel.bus == bus) add_node(layout.panel.node);
}

void BusIdentifiers::add_node(int node) noexcept {
  for (const Cob base :
       {kCobEmergency, kCobTpdo1, kCobTpdo2, kCobRpdo1, kCobSdoResponse, kCobSdoRequest, kCobHeartbeat}) {
    add(base + node);
  }
  for (int base = kCobRpdo1 + 0x100; base <= kCobRpdo4; base += 0x100) add(base + node);
}

}  // namespace godobject::hal
