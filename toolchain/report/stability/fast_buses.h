#pragma once

#include <algorithm>
#include <cstddef>

#include "firmware/configuration/controller_file.h"
#include "hal/cia402/bus_plan.h"

namespace godobject::report {

/// The drives of a device on the buses that a period needs: below 1 ms each joint on a bus of its own, with FD frames
/// alone and data at 8 Mbit/s.
inline hal::BusLayout layout_for(hal::BusLayout layout, double period) {
  constexpr double kSlowest = 0.9e-3;  // below, the device's own buses have no room
  layout.period = period;
  if (period > kSlowest) return layout;
  layout.fd = layout.fd_services = true;
  layout.data_rate = 8e6;
  layout.compute = std::min(layout.compute, firmware::kComputeShare * period);
  for (int i = 0; i < layout.joint_count; ++i) layout.drives.at(static_cast<std::size_t>(i)).bus = i;
  layout.panel = {.bus = layout.joint_count};
  layout.bus_count = layout.joint_count + 1;
  return layout;
}

}  // namespace godobject::report
