#pragma once

#include <bitset>
#include <cstdint>

namespace godobject::firmware {

/// Whether a loop overruns more often than can be gone on with: three times in a row, more than one cycle in a hundred
/// over the last second, or once by more than 5 ms.
class OverrunWatch {
 public:
  static constexpr std::uint32_t kInRow = 3;
  static constexpr std::size_t kWindow = 1000;  ///< cycles
  static constexpr std::uint32_t kInWindow = 10;
  static constexpr std::int64_t kLong_ns = 5'000'000;

  /// One cycle: by how much the cycle before was late to end; 0 if it was not. True: too often, or too long.
  bool update(std::int64_t overrun_ns) noexcept {
    const bool overrun = overrun_ns > 0;
    in_row_ = overrun ? in_row_ + 1 : 0;
    in_window_ += (overrun ? 1u : 0u) - (window_[at_] ? 1u : 0u);
    window_[at_] = overrun;
    at_ = (at_ + 1) % kWindow;
    return in_row_ >= kInRow || in_window_ > kInWindow || overrun_ns > kLong_ns;
  }

 private:
  std::uint32_t in_row_ = 0;
  std::uint32_t in_window_ = 0;
  std::size_t at_ = 0;
  std::bitset<kWindow> window_;
};

}  // namespace godobject::firmware
