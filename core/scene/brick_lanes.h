#pragma once

#include <cstdint>

#include "core/scene/format.h"

/// How the kernels' loops read format::Brick: 16 bits and the next 16 are gathered together. Included by those that are
/// included once by a source for each kind of vectors, as clearance_kernel_lanes.h.
namespace godobject::detail {
namespace {

/// Of a pair, with its sign.
template <class Ints>
Ints first_of(Ints pair) noexcept {
  return (pair << 16) >> 16;
}
template <class Ints>
Ints second_of(Ints pair) noexcept {
  return pair >> 16;
}

/// format::decode_lipschitz of the pair's first.
template <class Vectors>
typename Vectors::Floats decode_lipschitz(typename Vectors::Ints pair) noexcept {
  const typename Vectors::Ints code = pair & 0xffff;
  return reinterpret_cast<typename Vectors::Floats>((code << format::kLipschitzShift) +
                                                    static_cast<std::int32_t>(format::kLipschitzOne));
}

/// Of two neighbours of 16 bits without a sign, the second.
template <class Vectors>
typename Vectors::Floats second_unsigned(typename Vectors::Ints pair) noexcept {
  return __builtin_convertvector((pair >> 16) & 0xffff, typename Vectors::Floats);
}

}  // namespace
}  // namespace godobject::detail
