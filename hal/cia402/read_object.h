#pragma once

#include <cstdint>

#include "hal/can_bus.h"
#include "hal/clock.h"

namespace godobject::hal {

/// Reads an object of at most four bytes from a node by SDO, before the cycle begins. All other frames that arrive
/// meanwhile are dropped. Waits up to a second, in steps of a millisecond. False: no answer, an abort, or a longer
/// object. Does not allocate or throw.
bool read_object(CanBus& bus, Clock& clock, int node, std::uint16_t index, std::uint8_t subindex,
                 std::uint32_t& value) noexcept;

}  // namespace godobject::hal
