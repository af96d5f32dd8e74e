#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/pipeline/contact/contact_limits.h"
#include "core/pipeline/cycle/state.h"
#include "godobject/pose.h"

namespace godobject {

/// The god object's poses at the ends of the sub-steps of the last cycle of `contact`. Between two of them, and from
/// the cycle's first pose to the first of them, every point moved along a straight chord that the certificate checked.
/// Tools and tests read it; no cycle depends on it.
class SubstepPath {
 public:
  static constexpr std::uint32_t kCapacity = kMaxSubsteps + kMostFreeSubsteps;

  void clear() noexcept { count_ = 0; }
  void push(const Pose& H_WS) noexcept {
    if (count_ < kCapacity) poses_[count_++] = H_WS;
  }
  std::span<const Pose> poses() const noexcept { return {poses_.data(), count_}; }

 private:
  std::array<Pose, kCapacity> poses_;
  std::uint32_t count_ = 0;
};

}  // namespace godobject
