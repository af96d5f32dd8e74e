#pragma once

#include <cstdint>

#include "hal/linux/monotonic_clock.h"
#include "sim/virtual_clock.h"

namespace godobject::firmware {

/// The machine's clock for a simulated world: `sleep_until` advances the world to the deadline first and then waits for
/// the rest. The world's own computing time therefore does not appear as lateness of the loop.
class PacedClock final : public hal::Clock {
 public:
  /// `world` outlives the clock, which starts at the world's time.
  explicit PacedClock(sim::World& world) noexcept : world_(world), offset_ns_(clock_.now_ns() - world.now_ns()) {}

  std::int64_t now_ns() noexcept override { return clock_.now_ns() - offset_ns_; }
  void sleep_until(std::int64_t ns) noexcept override {
    world_.advance_to(ns);
    clock_.sleep_until(ns + offset_ns_);
  }

 private:
  sim::World& world_;
  hal::MonotonicClock clock_;
  std::int64_t offset_ns_;
};

}  // namespace godobject::firmware
