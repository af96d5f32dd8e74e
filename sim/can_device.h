#pragma once

#include <array>
#include <cstddef>
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

/// A simulated arm behind CAN in the same process and in virtual time: plant, drives and panel on the wires of a
/// layout. The controller has the other ends of the wires. Time passes only in `advance_to`: frames end, timers expire
/// and torques act at their own nanosecond. The plant is integrated up to each frame that is not a node's own, to each
/// timer and to the end of `advance_to`.
///
/// Nodes answer SYNC the layout's `answer` after it. A frame has its longest duration by stuffing, see LoopbackBus.
/// Torques of the controller go on the wire `layout.compute` after they are sent, see LoopbackEnd. Large: the heap, or
/// static storage. Real-time safe.
class CanDevice final : public World {
 public:
  /// As CanNodes. `faults` outlive this, too.
  CanDevice(Plant& plant, const hal::BusLayout& layout, std::span<const JointHardwareParameters> joints,
            const CanScript& script = {}, std::span<const BusFault> faults = {}) noexcept;

  /// The controller's end of a bus of the layout.
  hal::CanBus& bus(int i) noexcept { return *ends_[static_cast<std::size_t>(i)]; }
  const LoopbackBus& wire(int i) const noexcept { return *wires_[static_cast<std::size_t>(i)]; }

  std::int64_t now_ns() const noexcept override { return nodes_.now_ns(); }
  void advance_to(std::int64_t ns) noexcept override;

  /// Advances to the next event, at most to `ns`, which is in the future. The plant may stay behind.
  void advance_to_event(std::int64_t ns) noexcept;

  /// Sets an observer: it is called for each frame of a node when the frame is handed over to the wire, and for each
  /// frame of the controller when the frame has ended there. It outlives this.
  void set_tap(hal::FrameTap* tap) noexcept { tap_ = tap; }

  CanNodes& nodes() noexcept { return nodes_; }
  const CanNodes& nodes() const noexcept { return nodes_; }

 private:
  static constexpr int kController = 0;  ///< the controller's end on each wire; node i has end 1 + i
  static constexpr int kForeign = LoopbackBus::kEnds - 1;
  static constexpr std::size_t kHeld = 32;

  /// A frame that a fault holds back until a time, or until the next frame on its bus.
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
  void apply_to_wire(const BusFault& fault) noexcept;
  void apply_to_node(const BusFault& fault, CanopenNode& node) noexcept;
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
static_assert(sizeof(CanDevice) < (std::size_t{2} << 20), "2 MiB; most of it is the queues of the wires");

}  // namespace godobject::sim
