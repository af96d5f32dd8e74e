#pragma once

#include <cstdint>

#include "hal/can_frame.h"

/// Client side of expedited SDO (CiA 301): one request, one response, values of at most four bytes. Pure functions,
/// real-time safe.
namespace godobject::hal::canopen {

/// The abort codes that this project names.
enum SdoAbort : std::uint32_t {
  kAbortTimeout = 0x05040000,
  kAbortWriteOnly = 0x06010001,
  kAbortReadOnly = 0x06010002,
  kAbortNoObject = 0x06020000,
  kAbortLength = 0x06070010,
  kAbortNoSubindex = 0x06090011,
};

/// A request to read an object of `node`.
CanFrame sdo_read(int node, std::uint16_t index, std::uint8_t subindex) noexcept;

/// A request to write the lowest `size` bytes of `value`: 1, 2 or 4.
CanFrame sdo_write(int node, std::uint16_t index, std::uint8_t subindex, std::uint32_t value, int size) noexcept;

struct SdoResponse {
  enum class Kind : std::uint8_t {
    kRead,     ///< `size` bytes of `value`
    kWritten,  ///< the write succeeded
    kAborted,  ///< `value` is the abort code
    kLong,     ///< the object has more than four bytes, or the response is of a longer transfer; no `value`
  };

  int node = 0;
  Kind kind = Kind::kAborted;
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  int size = 0;  ///< 1 to 4; 0: not given by the server
  std::uint32_t value = 0;
};

/// Parses a frame. False: it is no SDO response.
bool parse_sdo_response(const CanFrame& frame, SdoResponse& response) noexcept;

/// True if a frame is part of a write by a client: begin or segment of an expedited, segmented or block download.
bool is_sdo_write(const CanFrame& frame) noexcept;

}  // namespace godobject::hal::canopen
