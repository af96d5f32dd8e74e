#pragma once

#include <cstdint>

#include "hal/can_frame.h"

namespace godobject::hal::canopen {

/// A node's emergency message (CiA 301); the five bytes of the maker's own are left out.
struct Emergency {
  int node = 0;
  std::uint16_t code = 0;           ///< 0: the error has gone
  std::uint8_t error_register = 0;  ///< 1001
};

/// Commands stayed away from a node for longer than the deadline of their PDO, 1400:5.
inline constexpr std::uint16_t kRpdoTimeout = 0x8250;

/// False: it is none.
bool parse_emergency(const CanFrame& frame, Emergency& emergency) noexcept;

/// Whether a node may go on after it: no error any more, or 8110 and 8120, a node that was behind with its frames or
/// saw errors on the wire. What that costs shows by itself: lost frames, and the drives' deadline.
bool is_warning(std::uint16_t code) noexcept;

}  // namespace godobject::hal::canopen
