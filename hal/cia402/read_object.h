#pragma once

#include <cstdint>

#include "hal/can_bus.h"
#include "hal/clock.h"

namespace godobject::hal {

/// Reads an object of at most four bytes of a node by SDO; what else comes on the bus meanwhile is dropped. For what an
/// engineer wants to see before the cycle begins. Waits for up to a second, in steps of a millisecond. False: no
/// answer, an abort, or a longer object. Allocates nothing, throws nothing.
bool read_object(CanBus& bus, Clock& clock, int node, std::uint16_t index, std::uint8_t subindex,
                 std::uint32_t& value) noexcept;

}  // namespace godobject::hal
