#pragma once

#include <cstdint>
#include <cstring>

#include <arm_neon.h>

namespace godobject::detail {
namespace {

/// Vectors of AArch64, as those of AVX2.
struct Neon {
  static constexpr std::uint32_t kLanes = 4;
  using Floats __attribute__((vector_size(4 * kLanes))) = float;
  using Ints __attribute__((vector_size(4 * kLanes))) = std::int32_t;
  using Doubles __attribute__((vector_size(4 * kLanes))) = double;
  using Longs __attribute__((vector_size(4 * kLanes))) = std::int64_t;

  /// There are no gathers: one load a lane.
  static Ints gather(const std::uint32_t* from, Ints at) noexcept {
    const auto load = [&](int lane) noexcept { return static_cast<std::int32_t>(from[at[lane]]); };
    return Ints{load(0), load(1), load(2), load(3)};
  }
  static Ints gather_pair(const std::int16_t* from, Ints at) noexcept {
    const auto load = [&](int lane) noexcept {
      std::int32_t pair = 0;
      std::memcpy(&pair, from + at[lane], sizeof(pair));
      return pair;
    };
    return Ints{load(0), load(1), load(2), load(3)};
  }
  static Ints truncated(Floats x) noexcept { return vcvtq_s32_f32(x); }
  static Floats root(Floats x) noexcept { return vsqrtq_f32(x); }
  static Floats larger(Floats a, Floats b) noexcept { return vmaxnmq_f32(a, b); }
  static Floats smaller(Floats a, Floats b) noexcept { return vminnmq_f32(a, b); }

  static Doubles low(Floats x) noexcept { return vcvt_f64_f32(vget_low_f32(x)); }
  static Doubles high(Floats x) noexcept { return vcvt_high_f64_f32(x); }
  static Doubles low(Ints x) noexcept { return vcvtq_f64_s64(vmovl_s32(vget_low_s32(x))); }
  static Doubles high(Ints x) noexcept { return vcvtq_f64_s64(vmovl_high_s32(x)); }
  static Longs low_mask(Ints x) noexcept { return vmovl_s32(vget_low_s32(x)); }
  static Longs high_mask(Ints x) noexcept { return vmovl_high_s32(x); }
  static Floats narrowed(Doubles low, Doubles high) noexcept { return vcvt_high_f32_f64(vcvt_f32_f64(low), high); }
  static Ints truncated(Doubles low, Doubles high) noexcept {
    return vmovn_high_s64(vmovn_s64(vcvtq_s64_f64(low)), vcvtq_s64_f64(high));
  }
  static Ints mask(Longs low, Longs high) noexcept { return vmovn_high_s64(vmovn_s64(low), high); }
  static std::uint32_t bits(Ints mask) noexcept {
    std::uint32_t out = 0;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) out |= (mask[lane] != 0 ? 1u : 0u) << lane;
    return out;
  }
};

}  // namespace
}  // namespace godobject::detail
