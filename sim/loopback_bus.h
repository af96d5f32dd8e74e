#pragma once

#include <array>
#include <cstdint>

#include "hal/can_bus.h"
#include "hal/cia402/bus_layout.h"
#include "sim/virtual_clock.h"

namespace godobject::sim {

/// Longest time that a frame of n data bytes occupies the wire, with the 3 bits after it [ns]. Derived, in a second way
/// beside hal::longest_frame_ns:
///
/// Classical, 11 bit identifier: 34 bits from the start of frame to the end of the checksum, and the data, are stuffed:
/// at worst every fourth bit after the first, floor((34 + 8 n - 1) / 4). 13 more bits are not. Sum: 55 + 10 n bits. FD,
/// at the nominal rate: 17 bits up to the switch of the rate, floor(16 / 4) stuff bits, 13 bits after the checksum: 34
/// bits. At the data rate: 5 bits before the data and the data, every fourth stuffed; 4 bits that count the stuff bits;
/// a checksum of 17 bits (21 beyond 16 bytes); a fixed stuff bit in each four of these last two. Sum: 33 + 10 n bits,
/// beyond 16 bytes 38 + 10 n.
std::int64_t frame_ns(const hal::BusLayout& layout, const hal::CanFrame& frame) noexcept;

/// A frame on the wire, or one that has ended.
struct WireFrame {
  hal::CanFrame frame;
  int end = -1;             ///< the end that sent it
  std::int64_t end_ns = 0;  ///< end of the frame and the 3 bits after it
};

/// One CAN wire in virtual time with several ends. It carries one frame at a time. When it is idle, the lowest
/// identifier among the heads of the ends' queues is sent next; of equal ones that of the lowest end. No frame is lost,
/// and every frame has its longest duration by stuffing. Real-time safe.
class LoopbackBus {
 public:
  static constexpr int kEnds = 12;    ///< derived: controller, 7 drives, panel, foreign sender: 10
  static constexpr int kQueue = 128;  ///< frames an end; chosen: more than a millisecond of a full wire, 21 frames

  /// Uses the rates of `layout`, which outlives the bus.
  explicit LoopbackBus(const hal::BusLayout& layout) noexcept : layout_(layout) {}

  /// Puts a frame into the queue of an end, to be sent from `ready_ns` on: as an FD frame if all frames of the layout
  /// are. False: the queue is full.
  bool hand_over(int end, const hal::CanFrame& frame, std::int64_t ready_ns) noexcept;
  int queued(int end) const noexcept { return queues_[static_cast<std::size_t>(end)].count; }
  void clear(int end) noexcept;  ///< clears its queue; a frame on the wire continues

  /// Starts the next frame if the wire is idle and one is ready. Call it after all other events of `now_ns`.
  void arbitrate(std::int64_t now_ns) noexcept;

  /// Time of the next event on the wire: a frame ends, or the next one is ready.
  std::int64_t next_ns() const noexcept;

  /// Takes the frame that has ended by `now_ns`. False: there is none.
  bool take(std::int64_t now_ns, WireFrame& ended) noexcept;

  std::int64_t busy_ns() const noexcept { return busy_ns_; }  ///< total duration of frames

 private:
  struct Queued {
    hal::CanFrame frame;
    std::int64_t ready_ns = 0;
  };
  struct Queue {
    std::array<Queued, kQueue> frames{};
    int first = 0;
    int count = 0;
    const Queued& head() const noexcept { return frames[static_cast<std::size_t>(first)]; }
  };

  const hal::BusLayout& layout_;
  std::array<Queue, kEnds> queues_;
  WireFrame on_wire_;
  bool busy_ = false;
  std::int64_t busy_ns_ = 0;
};

/// The controller's interface to a loopback bus, with the behaviour of a SocketCAN socket: bounded queues, own frames
/// return. `deliver` puts a received frame into it. RPDOs go on the wire `compute_ns` after they are sent, since
/// computing takes no virtual time; all other frames at once.
class LoopbackEnd final : public hal::CanBus {
 public:
  static constexpr int kReceiveQueue = 512;  ///< frames; chosen: 24 ms of a full wire

  LoopbackEnd(LoopbackBus& bus, int end, std::int64_t compute_ns) noexcept
      : bus_(bus), end_(end), compute_ns_(compute_ns) {}

  hal::SendResult send(const hal::CanFrame& frame) noexcept override;
  bool receive(hal::ReceivedFrame& received) noexcept override;
  hal::BusHealth health() const noexcept override { return health_; }

  void set_now(std::int64_t now_ns) noexcept { now_ns_ = now_ns; }
  void deliver(const WireFrame& ended) noexcept;
  void set_down(bool down) noexcept;
  void set_bus_off() noexcept;                         ///< until the interface is taken down and up again
  void set_full(bool full) noexcept { full_ = full; }  ///< the transmit queue is full while true
  void count_malformed() noexcept { ++health_.malformed; }

 private:
  LoopbackBus& bus_;
  int end_;
  std::int64_t compute_ns_;
  std::int64_t now_ns_ = 0;
  bool full_ = false;
  hal::BusHealth health_;
  std::array<hal::ReceivedFrame, kReceiveQueue> received_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace godobject::sim
