#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>

namespace godobject::firmware {

/// Detects an event that happens too often in the last thousand cycles.
class RateWatch {
 public:
  static constexpr std::size_t kWindow = 1000;  ///< cycles
  /// Events in the window that are allowed. Chosen: 1 %. With 3 single jumps that the arm must tolerate
  /// (encoder_jumps_once) stop it; with 30 a joint may move by predictions in one cycle of 33.
  static constexpr std::uint32_t kMost = 10;

  explicit RateWatch(std::uint32_t most = kMost) noexcept : most_(most) {}

  /// Takes one cycle. True: the event happened, and too often. Cost: 5 ns. Real-time safe.
  bool update(bool happened) noexcept {
    in_window_ += (happened ? 1u : 0u) - (window_[at_] ? 1u : 0u);
    window_[at_] = happened;
    at_ = (at_ + 1) % kWindow;
    return happened && in_window_ > most_;
  }

 private:
  std::uint32_t most_;
  std::uint32_t in_window_ = 0;
  std::size_t at_{};
  std::bitset<kWindow> window_;
};

}  // namespace godobject::firmware
