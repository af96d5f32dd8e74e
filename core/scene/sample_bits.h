#pragma once

#include <bit>
#include <cstdint>

#include "core/scene/sample_batch.h"

/// Properties of the points of a batch, a bit each. Real-time safe; some instructions a point.
namespace godobject {

/// Calls visit(i) for every bit that is set, ascending.
template <class Visit>
void for_each_bit(std::uint64_t bits, Visit&& visit) noexcept {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::uint32_t>(std::countr_zero(bits)));
}

inline std::uint64_t first_bits(std::uint32_t count) noexcept {
  return count >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
}

/// Clearances below a bound [m]. Bits beyond the batch's count mean nothing.
std::uint64_t clearance_below(const SampleBatch& batch, double bound) noexcept;

/// Distances above 0 that are no smaller than `kept`, or than they were where the chord began, but for `rounding` [m].
std::uint64_t keeps_distance(const SampleBatch& batch, double kept, double rounding) noexcept;

/// Gradients longer than this.
std::uint64_t steeper(const SampleBatch& batch, double gradient) noexcept;

}  // namespace godobject
