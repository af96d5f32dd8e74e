#pragma once

#include <cstdint>

#include "hal/can_frame.h"

namespace godobject::hal {

/// Result of handing a frame to a bus.
enum class SendResult : std::uint8_t {
  kSent,  ///< handed over; it returns as an own frame after it was on the wire
  kFull,  ///< the queue was full: the frame is lost
  kDown,  ///< the interface is down or gone
};

/// State of a bus.
struct BusHealth {
  bool down = false;          ///< the interface is, or was, down or gone
  bool bus_off = false;       ///< the controller is bus-off and does not restart by itself
  bool passive = false;       ///< the controller is error-passive
  std::uint64_t dropped = 0;  ///< received frames for which the socket had no room
  std::uint64_t errors = 0;   ///< error frames
  /// Frames handed over since the last own frame returned. More than a few cycles send: no node acknowledges.
  std::uint32_t unreturned = 0;
  std::uint64_t malformed = 0;  ///< frames that CANopen does not have: extended, remote, impossible lengths
};

/// One CAN bus. `send` and `receive` never block, allocate or throw.
class CanBus {
 public:
  virtual ~CanBus() = default;

  /// Hands a frame over for sending.
  virtual SendResult send(const CanFrame& frame) noexcept = 0;

  /// Takes the oldest received frame, own ones included, in the order of the wire. False: there is none.
  virtual bool receive(ReceivedFrame& received) noexcept = 0;

  /// The state after the frames that `receive` has taken.
  virtual BusHealth health() const noexcept = 0;

 protected:
  CanBus() = default;
  CanBus(const CanBus&) = default;
  CanBus& operator=(const CanBus&) = default;
};

}  // namespace godobject::hal
