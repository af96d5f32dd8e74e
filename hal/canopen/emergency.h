#pragma once

#include <cstdint>

#include "hal/can_frame.h"

namespace godobject::hal::canopen {

/// A node's emergency message (CiA 301) without the five manufacturer-specific bytes.
struct Emergency {
  int node = 0;
  std::uint16_t code = 0;           ///< 0: the error has disappeared
  std::uint8_t error_register = 0;  ///< object 1001
};

/// Code of a node whose RPDOs were missing for longer than their deadline, 1400:5.
inline constexpr std::uint16_t kRpdoTimeout = 0x8250;

/// Parses a frame. False: it is no emergency message.
bool parse_emergency(const CanFrame& frame, Emergency& emergency) noexcept;

/// True if the controller may continue after this code: 0 (no error), 8110 (CAN overrun of the node) or 8120 (error
/// passive). Their effects are noticed anyway, as lost frames or by the drives' deadline.
bool is_warning(std::uint16_t code) noexcept;

}  // namespace godobject::hal::canopen
