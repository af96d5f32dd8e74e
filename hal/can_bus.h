#pragma once

#include <cstdint>

#include "hal/can_frame.h"

namespace godobject::hal {

/// Result of handing a frame to a bus.
enum class SendResult : std::uint8_t {
  kSent,  ///< handed over; it comes back as an own frame once it has been on the wire
  kFull,  ///< no room in the queue: lost
  kDown,  ///< the interface is down or gone
};

/// What is known of a bus beside its frames.
struct BusHealth {
  bool down = false;             ///< the interface is down or gone, or has been
  bool bus_off = false;          ///< the controller has left the bus; nothing starts it again by itself
  bool passive = false;          ///< the controller's error counters are high
  std::uint64_t dropped = 0;     ///< received frames that the socket had no room for
  std::uint64_t errors = 0;      ///< error frames
  std::uint32_t unreturned = 0;  ///< frames handed over since the last own one came back: beyond what a few cycles
                                 ///< send, nobody acknowledges
  std::uint64_t malformed = 0;   ///< frames that are none of CANopen's: extended, remote, impossible lengths
};

/// One CAN bus. `send` and `receive` never block, allocate or throw.
class CanBus {
 public:
  virtual ~CanBus() = default;

  /// Hands a frame over for sending.
  virtual SendResult send(const CanFrame& frame) noexcept = 0;

  /// The oldest frame that has come, own ones included, in the order of the wire. False: there is none.
  virtual bool receive(ReceivedFrame& received) noexcept = 0;

  /// As far as `receive` has come.
  virtual BusHealth health() const noexcept = 0;

 protected:
  CanBus() = default;
  CanBus(const CanBus&) = default;
  CanBus& operator=(const CanBus&) = default;
};

}  // namespace godobject::hal
