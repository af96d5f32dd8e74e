#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace godobject::firmware {

/// Returns how many cycles of `period` [s] a duration [s] takes: rounded, and at least `least`.
inline std::uint32_t cycles_in(double seconds, double period, std::uint32_t least = 1) noexcept {
  return std::max(least, static_cast<std::uint32_t>(std::lround(seconds / period)));
}

}  // namespace godobject::firmware
