#pragma once

#include <array>
#include <cstdint>

namespace godobject::hal {

/// A CAN data frame with an 11 bit identifier.
struct CanFrame {
  std::uint16_t id = 0;                 ///< 11 bits
  std::uint8_t length = 0;              ///< bytes of data: 0 to 8; FD: 0 to 8, 12, 16, 20, 24, 32, 48, 64
  bool fd = false;                      ///< FD format, data at the higher bit rate
  std::array<std::uint8_t, 64> data{};  ///< `length` bytes are valid
};

/// A received frame.
struct ReceivedFrame {
  CanFrame frame;            ///< identifier and data
  std::int64_t time_ns = 0;  ///< end of the frame on the bus, by a clock that may be set: for logs and figures only
  bool own = false;          ///< sent by this bus object, and now on the wire
};

}  // namespace godobject::hal
