#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "hal/clock.h"

namespace godobject::sim {

/// A time that does not come [ns].
inline constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

/// What happens while virtual time passes.
class World {
 public:
  virtual ~World() = default;

  virtual std::int64_t now_ns() const noexcept = 0;

  /// Lets the world run on until `ns`; does nothing if that has passed.
  virtual void advance_to(std::int64_t ns) noexcept = 0;

 protected:
  World() = default;
  World(const World&) = default;
  World& operator=(const World&) = default;
};

/// Someone waits too long: the first `sleep_until` for `ns` or later returns `late_ns` after what it was asked for.
struct LateWake {
  std::int64_t ns = 0;
  std::int64_t late_ns = 0;
};

/// Virtual time: it passes only while somebody sleeps, and the world runs in it. So computing takes no time, unless
/// `spend` says so. `late` in order of time; it must outlive the clock.
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

  /// Computing takes this long.
  void spend(std::int64_t duration_ns) noexcept { world_.advance_to(world_.now_ns() + duration_ns); }

 private:
  World& world_;
  std::span<const LateWake> late_;
};

}  // namespace godobject::sim
