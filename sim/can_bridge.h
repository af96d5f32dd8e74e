#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hal/can_bus.h"
#include "hal/cia402/bus_layout.h"
#include "hal/frame_tap.h"
#include "sim/can_device.h"

namespace godobject::sim {

/// Figures of the bridge.
struct BridgeCounters {
  std::uint64_t cycles = 0;      ///< cycles that SYNC has begun
  std::uint64_t forwarded = 0;   ///< frames to the controller
  std::uint64_t not_sent = 0;    ///< of those, frames for which the buses had no room
  std::uint64_t received = 0;    ///< frames from the controller
  std::uint64_t dropped = 0;     ///< of those, frames for which the bridge had no room
  std::uint64_t left_alone = 0;  ///< times that the controller was silent for longer than two periods
};

/// Connects a CanDevice to a controller in another process: it passes frames between the device's ends and CAN buses of
/// the machine.
///
/// Lock-step: each SYNC advances the device by one period, whatever the clock shows. `poll` waits for the SYNCs of all
/// buses, at most a twentieth of a period. Then the device advances until its drives have sampled, and their answers
/// are sent at once: virtual buses of the machine have no bit timing, so they have the frames earlier than a wire
/// would. The device then advances to the time at which the controller collects. Torques are handed over at that time,
/// or as long after SYNC as they arrived if that is later, less the layout's computing time. Once the torques of all
/// joints have arrived nothing else can act before the next SYNC, so the device advances to it ahead of time, and the
/// next answer takes no longer than a sample. A controller that is in time moves the device as one in the same process
/// does, to the last bit.
///
/// Before the first SYNC, and after two periods without one, the device follows the clock, so its deadlines expire when
/// the controller is gone. Its periods begin with those of the clock, as a controller's with the same clock do: SYNC
/// then finds the device shortly before the next period. Faults of single frames, see BusFault, have no effect on
/// frames to the controller. Large: static storage, or the heap. A cycle takes a few calls of `poll`.
class CanBridge final : private hal::FrameTap {
 public:
  /// `buses`: one for each bus of the layout. Device, layout and buses outlive this.
  CanBridge(CanDevice& device, const hal::BusLayout& layout, const hal::BusTiming& timing,
            std::span<hal::CanBus* const> buses) noexcept;
  ~CanBridge() override { device_.set_tap(nullptr); }

  /// Takes the received frames and answers. `now_ns`: of any monotonic clock. Returns the time of the next call, at
  /// once if that is `now_ns`; received frames need an earlier call.
  std::int64_t poll(std::int64_t now_ns) noexcept;

  const BridgeCounters& counters() const noexcept { return counters_; }

 private:
  static constexpr std::size_t kInbox = 128;

  struct Side {
    hal::CanBus* bus = nullptr;
    std::array<hal::CanFrame, kInbox> inbox{};
    std::size_t first = 0;
    std::size_t count = 0;
    bool synced = false;   ///< its SYNC of this cycle has come
    bool sampled = false;  ///< this SYNC has ended on the device's wire
    int joints = 0;
    int torques = 0;  ///< handed over in this cycle
    bool sync_waits() const noexcept;
    bool torque_waits() const noexcept;
  };

  void on_frame(int bus, const hal::ReceivedFrame& received) noexcept override;
  void read() noexcept;
  void pass_on(std::int64_t now_ns) noexcept;
  void pass_on_behind_sync() noexcept;
  bool sync_is_there(std::int64_t now_ns) noexcept;
  void begin_cycle() noexcept;
  void collect() noexcept;
  bool has_all_torques() const noexcept;
  void follow_clock(std::int64_t now_ns) noexcept;
  void hand_over(int bus) noexcept;
  void drain() noexcept;
  std::span<Side> sides() noexcept { return {sides_.data(), static_cast<std::size_t>(bus_count_)}; }

  CanDevice& device_;
  int bus_count_;
  std::int64_t period_ns_;
  std::int64_t compute_ns_;
  std::int64_t collect_ns_;
  std::array<Side, hal::kMaxBuses> sides_;
  bool started_ = false;             ///< `poll` was called
  bool in_step_ = false;             ///< advances with SYNC, not with the clock
  std::int64_t begin_ns_ = 0;        ///< the device's time at the beginning of the cycle, or of following the clock
  std::int64_t begin_clock_ns_ = 0;  ///< the clock's time then
  std::int64_t first_sync_ns_ = -1;  ///< the clock's time of the next cycle's first SYNC; -1: none yet
  BridgeCounters counters_;
};

}  // namespace godobject::sim
