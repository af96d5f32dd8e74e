#pragma once

#include <bit>
#include <cstdint>

#include "core/scene/sample_batch.h"

/// Properties of the points of a batch as bit masks, one bit for each point. Real-time safe; some instructions a point.
namespace godobject {

/// Calls visit(i) for every bit that is set, ascending.
template <class Visit>
void for_each_bit(std::uint64_t bits, Visit&& visit) noexcept {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::uint32_t>(std::countr_zero(bits)));
}

/// Returns the mask of the first `count` bits.
inline std::uint64_t first_bits(std::uint32_t count) noexcept {
  return count >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
}

/// Returns the points with a clearance below `bound` [m]. Bits beyond the batch's count are undefined.
std::uint64_t clearance_below(const SampleBatch& batch, double bound) noexcept;

/// Returns the points whose distance is above 0 and not smaller, up to `rounding`, than the lesser of `kept` and the
/// distance at the start of the chord [m].
std::uint64_t keeps_distance(const SampleBatch& batch, double kept, double rounding) noexcept;

/// Returns the points with a gradient longer than `gradient`.
std::uint64_t steeper(const SampleBatch& batch, double gradient) noexcept;

}  // namespace godobject
