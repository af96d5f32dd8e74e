#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/can_bus.h"
#include "hal/frame_tap.h"
#include "sim/bus_fault.h"
#include "sim/can_nodes.h"
#include "sim/loopback_bus.h"
#include "sim/virtual_clock.h"

namespace godobject::sim {

/// A simulated arm behind CAN, in the same process and in virtual time: plant, drives and panel on the wires of a
/// layout, whose other ends are the controller's. Nothing moves but while `advance_to` runs: frames end, timers run out
/// and torques act at their own nanosecond, and the plant is integrated up to each frame that is not a node's own, each
/// timer and the end of `advance_to`.
///
/// Nodes answer SYNC the layout's `answer` after it; a frame takes as long as its stuffing may make it, see
/// LoopbackBus. What the controller has computed goes on the wire `layout.compute` after it is sent, see LoopbackEnd.
/// About 900 KiB. Real-time safe.
class CanDevice final : public World {
 public:
  /// As CanNodes; `faults` outlive this, too.
  CanDevice(Plant& plant, const hal::BusLayout& layout, std::span<const JointHardwareParameters> joints,
            const CanScript& script = {}, std::span<const BusFault> faults = {}) noexcept;

  /// The controller's end of a bus of the layout.
  hal::CanBus& bus(int i) noexcept { return *ends_[static_cast<std::size_t>(i)]; }
  const LoopbackBus& wire(int i) const noexcept { return *wires_[static_cast<std::size_t>(i)]; }

  std::int64_t now_ns() const noexcept override { return nodes_.now_ns(); }
  void advance_to(std::int64_t ns) noexcept override;

  /// To the next thing that happens, at most to `ns`, which is ahead. The plant may stay behind it.
  void advance_to_event(std::int64_t ns) noexcept;

  /// Is shown each frame of a node when it is handed over to the wire, and each of the controller when it has ended
  /// there. It outlives this.
  void set_tap(hal::FrameTap* tap) noexcept { tap_ = tap; }

  CanNodes& nodes() noexcept { return nodes_; }
  const CanNodes& nodes() const noexcept { return nodes_; }

 private:
  static constexpr int kController = 0;  ///< its end on each wire; node i has end 1 + i
  static constexpr int kForeign = LoopbackBus::kEnds - 1;
  static constexpr std::size_t kHeld = 32;

  /// A frame that a fault keeps from arriving; it waits for a time, or for the next frame on its bus.
  struct Held {
    bool used = false;
    bool until_next = false;
    int bus = 0;
    std::int64_t due_ns = 0;
    WireFrame frame;
  };

  void take_frames() noexcept;
  void end_frames() noexcept;
  void begin_cycle() noexcept;
  CanopenNode* find_node(int bus, int node) noexcept;
  void arrive(int bus, const WireFrame& ended) noexcept;
  void spoil(int bus, WireFrame& ended) noexcept;
  void hold(const Held& held) noexcept;
  void release_due() noexcept;

  const hal::BusLayout& layout_;
  std::span<const BusFault> faults_;
  CanNodes nodes_;
  std::array<std::optional<LoopbackBus>, hal::kMaxBuses> wires_;
  std::array<std::optional<LoopbackEnd>, hal::kMaxBuses> ends_;
  std::array<Held, kHeld> held_{};
  hal::FrameTap* tap_ = nullptr;
};

}  // namespace godobject::sim
