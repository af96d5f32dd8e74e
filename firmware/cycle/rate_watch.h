#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>

namespace godobject::firmware {

/// Whether something happens in more than one cycle in a hundred, over the last second.
class RateWatch {
 public:
  static constexpr std::size_t kWindow = 1000;  ///< cycles
  static constexpr std::uint32_t kMost = 10;    ///< in them

  /// One cycle. True: it happened, and too often. Cost: 5 ns. Real-time safe.
  bool update(bool happened) noexcept {
    in_window_ += (happened ? 1u : 0u) - (window_[at_] ? 1u : 0u);
    window_[at_] = happened;
    at_ = (at_ + 1) % kWindow;
    return happened && in_window_ > kMost;
  }

 private:
  std::uint32_t in_window_ = 0;
  std::size_t at_ = 0;
  std::bitset<kWindow> window_;
};

}  // namespace godobject::firmware
