#pragma once

#include <array>
#include <cstdint>

#include "hal/can_bus.h"
#include "hal/cia402/bus_layout.h"
#include "sim/virtual_clock.h"

namespace godobject::sim {

/// How long a frame of n data bytes holds the wire at most, the 3 bits after it included [ns].
///
/// Classical, 11 bit identifier: 34 bits from the start of the frame to the checksum's end are stuffed, and the data:
/// at worst every fourth bit after the first, floor((34 + 8 n - 1) / 4); 13 more are not. 55 + 10 n bits. FD: 17 bits
/// from the start to the switch of the rate and floor(16 / 4) stuffed ones, 13 after the checksum: 34 at the nominal
/// rate. At the data rate the 5 bits before the data and the data, of them every fourth stuffed, 4 bits that count
/// these, a checksum of 17 bits, beyond 16 bytes of 21, and a fixed stuffed bit in each four of the last two: 33 + 10 n
/// bits, beyond 16 bytes 38 + 10 n.
std::int64_t frame_ns(const hal::BusLayout& layout, const hal::CanFrame& frame) noexcept;

/// What is on the wire, or has been.
struct WireFrame {
  hal::CanFrame frame;
  int end = -1;             ///< that sent it
  std::int64_t end_ns = 0;  ///< when the last of it, and the 3 bits after it, have gone by
};

/// One CAN wire in virtual time with several ends: one frame at a time; when it is idle the lowest identifier among the
/// frames at the heads of the ends' queues goes, of equal ones the lowest end's. Nothing is lost on it, and every frame
/// takes the longest time that its stuffing may take. Static storage; real-time safe.
class LoopbackBus {
 public:
  static constexpr int kEnds = 12;
  static constexpr int kQueue = 128;

  /// Only the rates of the layout count; it must outlive the bus.
  explicit LoopbackBus(const hal::BusLayout& layout) noexcept : layout_(layout) {}

  /// Into the queue of an end, ready to be sent from `ready_ns` on. False: no room, nothing is done.
  bool hand_over(int end, const hal::CanFrame& frame, std::int64_t ready_ns) noexcept;
  int queued(int end) const noexcept { return queues_[static_cast<std::size_t>(end)].count; }
  void clear(int end) noexcept;  ///< its queue; a frame on the wire goes on

  /// Starts the next frame if the wire is idle and one is ready. Call it once all that happens at `now_ns` has
  /// happened.
  void arbitrate(std::int64_t now_ns) noexcept;

  /// When something happens next by itself: the frame on the wire ends, or the next one is ready.
  std::int64_t next_ns() const noexcept;

  /// The frame that has ended by `now_ns`. False: none has.
  bool take(std::int64_t now_ns, WireFrame& ended) noexcept;

  std::int64_t busy_ns() const noexcept { return busy_ns_; }  ///< for how long there were frames on it

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

/// The controller's interface to a loopback bus, as a socket of Linux is one: bounded queues, own frames come back.
/// What arrives is put into it by `deliver`. RPDOs are put on the wire `compute_ns` after they are sent, since in
/// virtual time computing takes no time by itself, every other frame at once.
class LoopbackEnd final : public hal::CanBus {
 public:
  static constexpr int kReceiveQueue = 512;

  LoopbackEnd(LoopbackBus& bus, int end, std::int64_t compute_ns) noexcept
      : bus_(bus), end_(end), compute_ns_(compute_ns) {}

  hal::SendResult send(const hal::CanFrame& frame) noexcept override;
  bool receive(hal::ReceivedFrame& received) noexcept override;
  hal::BusHealth health() const noexcept override { return health_; }

  void set_now(std::int64_t now_ns) noexcept { now_ns_ = now_ns; }
  void deliver(const WireFrame& ended) noexcept;
  void set_down(bool down) noexcept;
  void set_bus_off() noexcept;                         ///< until it is taken down and up again
  void set_full(bool full) noexcept { full_ = full; }  ///< as if the queue for sending never emptied
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
