#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hal/can_bus.h"
#include "hal/cia402/bus_layout.h"
#include "hal/frame_tap.h"
#include "sim/can_device.h"

namespace godobject::sim {

/// What has gone over the bridge.
struct BridgeCounters {
  std::uint64_t cycles = 0;      ///< that SYNC has begun
  std::uint64_t forwarded = 0;   ///< frames to the controller
  std::uint64_t not_sent = 0;    ///< of those that the buses had no room for
  std::uint64_t received = 0;    ///< frames from the controller
  std::uint64_t dropped = 0;     ///< of those that there was no room for
  std::uint64_t left_alone = 0;  ///< times that the controller fell silent for longer than two periods
};

/// A CanDevice whose controller is in another process: frames are passed between its ends and buses of the machine.
///
/// Lock-step: SYNC lets the device run on by one period and no more, whatever the clock says. With the SYNCs of all
/// buses, which `poll` waits for as long as a twentieth of a period, the device runs on until its drives have sampled,
/// and their answers are sent at once; buses of the machine that know no bit timing have them before they would have
/// ended on a wire. The device then runs on to the time at which the controller collects. Torques are handed over then,
/// or as long after SYNC as they have come if that is later, less the time that the layout gives to computing. Once
/// those of all joints have come, nothing else can act before the next SYNC: the device runs on to it ahead of time, so
/// that the next answer takes no longer than a sample. A controller that is in time thus moves the device as one in the
/// same process does, to the last bit.
///
/// Before the first SYNC, and when none has come for two periods, the device goes by the clock, so that its deadlines
/// run out when nobody is there any more. Its periods begin where those of the clock do, as a controller's with the
/// same clock: SYNC then finds it close before the next one. Faults of single frames on their way, see BusFault, have
/// no effect on what is sent. Static storage; a cycle takes a few calls of poll, which share its cost.
class CanBridge final : private hal::FrameTap {
 public:
  /// Device, layout and buses outlive this; the buses are one each of the layout's.
  CanBridge(CanDevice& device, const hal::BusLayout& layout, const hal::BusTiming& timing,
            std::span<hal::CanBus* const> buses) noexcept;
  ~CanBridge() override { device_.set_tap(nullptr); }

  /// Takes what has come and answers. `now_ns`: of any clock that goes on. Returns by when it wants to be called again,
  /// at once if that is `now_ns`; before, if frames come.
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
    bool sampled = false;  ///< and has ended on the device's wire
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
  void go_by_clock(std::int64_t now_ns) noexcept;
  void hand_over(int bus) noexcept;
  void drain() noexcept;
  std::span<Side> sides() noexcept { return {sides_.data(), static_cast<std::size_t>(bus_count_)}; }

  CanDevice& device_;
  int bus_count_;
  std::int64_t period_ns_;
  std::int64_t compute_ns_;
  std::int64_t collect_ns_;
  std::array<Side, hal::kMaxBuses> sides_;
  bool started_ = false;             ///< the clock has been seen
  bool in_step_ = false;             ///< goes by SYNC
  std::int64_t begin_ns_ = 0;        ///< of the cycle, or of going by the clock: the device's time
  std::int64_t begin_clock_ns_ = 0;  ///< the same by the clock
  std::int64_t first_sync_ns_ = -1;  ///< of the next cycle, by the clock; -1: none yet
  BridgeCounters counters_;
};

}  // namespace godobject::sim
