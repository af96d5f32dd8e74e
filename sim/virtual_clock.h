#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "hal/clock.h"

namespace godobject::sim {

/// A time that is never reached [ns].
inline constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

/// A simulated world that virtual time advances.
class World {
 public:
  virtual ~World() = default;

  virtual std::int64_t now_ns() const noexcept = 0;

  /// Advances the world to `ns`; does nothing if that has passed.
  virtual void advance_to(std::int64_t ns) noexcept = 0;

 protected:
  World() = default;
  World(const World&) = default;
  World& operator=(const World&) = default;
};

/// A late wake-up: the first `sleep_until` for `ns` or later returns `late_ns` too late.
struct LateWake {
  std::int64_t ns = 0;
  std::int64_t late_ns = 0;
};

/// Virtual time: it passes only in `sleep_until`, which advances the world, and in `spend`. Computing takes no time.
/// `late`: in order of time; outlives the clock.
class VirtualClock final : public hal::Clock {
 public:
  explicit VirtualClock(World& world, std::span<const LateWake> late = {}) noexcept : world_(world), late_(late) {}

  std::int64_t now_ns() noexcept override { return world_.now_ns(); }

  void sleep_until(std::int64_t ns) noexcept override {
    std::int64_t wake_ns = std::max(ns, world_.now_ns());
    if (!late_.empty() && ns >= late_.front().ns) {
      wake_ns += late_.front().late_ns;
      late_ = late_.subspan(1);
    }
    world_.advance_to(wake_ns);
  }

  /// Lets time pass, for computing.
  void spend(std::int64_t duration_ns) noexcept { world_.advance_to(world_.now_ns() + duration_ns); }

 private:
  World& world_;
  std::span<const LateWake> late_;
};

}  // namespace godobject::sim
