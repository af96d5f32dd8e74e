#pragma once

#include <cstdint>

namespace godobject::firmware {

/// Detects a drive that limits its torque by itself for too long. Each cycle with the limit counts up, each without it
/// counts down: a limit that flickers is found, too, if it is active in more than half of the cycles.
class LimitWatch {
 public:
  /// Takes one cycle. True: the limit was active in more than `most` cycles beyond those in which it was not. Cost:
  /// 1 ns. Real-time safe.
  bool update(bool active, std::uint32_t most) noexcept {
    if (active && count_ <= most) ++count_;
    if (!active && count_ > 0) --count_;
    return count_ > most;
  }

  void reset() noexcept { count_ = 0; }

 private:
  std::uint32_t count_ = 0;
};

}  // namespace godobject::firmware
