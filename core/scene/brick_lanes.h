#pragma once

#include <cstdint>

#include "core/scene/format.h"

/// Access of the kernels to format::Brick: they gather a 16-bit word together with the next one, as a pair. Only for
/// the headers that each vector type's source file includes once, as clearance_kernel_lanes.h.
namespace godobject::detail {
namespace {

/// Returns the first (second) word of a pair, with its sign.
template <class Ints>
Ints first_of(Ints pair) noexcept {
  return (pair << 16) >> 16;
}
template <class Ints>
Ints second_of(Ints pair) noexcept {
  return pair >> 16;
}

/// Returns format::decode_lipschitz of the pair's first word.
template <class Vectors>
typename Vectors::Floats decode_lipschitz(typename Vectors::Ints pair) noexcept {
  const typename Vectors::Ints code = pair & 0xffff;
  return reinterpret_cast<typename Vectors::Floats>((code << format::kLipschitzShift) +
                                                    static_cast<std::int32_t>(format::kLipschitzOne));
}

/// Returns the pair's second word as an unsigned number.
template <class Vectors>
typename Vectors::Floats second_unsigned(typename Vectors::Ints pair) noexcept {
  return __builtin_convertvector((pair >> 16) & 0xffff, typename Vectors::Floats);
}

}  // namespace
}  // namespace godobject::detail
