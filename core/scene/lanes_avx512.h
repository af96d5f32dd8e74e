#pragma once

#include <cstdint>

#include <immintrin.h>

namespace godobject::detail {
namespace {

/// Vectors of AVX-512 F and DQ, as those of AVX2.
struct Avx512 {
  static constexpr std::uint32_t kLanes = 16;
  using Floats __attribute__((vector_size(4 * kLanes))) = float;
  using Ints __attribute__((vector_size(4 * kLanes))) = std::int32_t;
  using Doubles __attribute__((vector_size(4 * kLanes))) = double;
  using Longs __attribute__((vector_size(4 * kLanes))) = std::int64_t;

  // masked by nothing: GCC 12 takes the unmasked ones for uses of undefined values
  static constexpr __mmask16 kAll = 0xffff;
  static constexpr __mmask8 kHalf = 0xff;

  static Ints gather(const std::uint32_t* from, Ints at) noexcept {
    return reinterpret_cast<Ints>(
        _mm512_mask_i32gather_epi32(__m512i{}, kAll, reinterpret_cast<__m512i>(at), from, sizeof(int)));
  }
  static Ints gather_pair(const std::int16_t* from, Ints at) noexcept {
    return reinterpret_cast<Ints>(
        _mm512_mask_i32gather_epi32(__m512i{}, kAll, reinterpret_cast<__m512i>(at), from, sizeof(std::int16_t)));
  }
  static Ints truncated(Floats x) noexcept { return reinterpret_cast<Ints>(_mm512_maskz_cvttps_epi32(kAll, x)); }
  static Floats root(Floats x) noexcept { return _mm512_maskz_sqrt_ps(kAll, x); }
  static Floats larger(Floats a, Floats b) noexcept { return _mm512_maskz_max_ps(kAll, a, b); }
  static Floats smaller(Floats a, Floats b) noexcept { return _mm512_maskz_min_ps(kAll, a, b); }

  static Doubles low(Floats x) noexcept { return _mm512_maskz_cvtps_pd(kHalf, half<0>(x)); }
  static Doubles high(Floats x) noexcept { return _mm512_maskz_cvtps_pd(kHalf, half<1>(x)); }
  static Doubles low(Ints x) noexcept { return _mm512_maskz_cvtepi32_pd(kHalf, half<0>(x)); }
  static Doubles high(Ints x) noexcept { return _mm512_maskz_cvtepi32_pd(kHalf, half<1>(x)); }
  static Longs low_mask(Ints x) noexcept {
    return reinterpret_cast<Longs>(_mm512_maskz_cvtepi32_epi64(kHalf, half<0>(x)));
  }
  static Longs high_mask(Ints x) noexcept {
    return reinterpret_cast<Longs>(_mm512_maskz_cvtepi32_epi64(kHalf, half<1>(x)));
  }
  static Floats narrowed(Doubles low, Doubles high) noexcept {
    return reinterpret_cast<Floats>(joined(reinterpret_cast<__m256i>(_mm512_maskz_cvtpd_ps(kHalf, low)),
                                           reinterpret_cast<__m256i>(_mm512_maskz_cvtpd_ps(kHalf, high))));
  }
  static Ints truncated(Doubles low, Doubles high) noexcept {
    return joined(_mm512_maskz_cvttpd_epi32(kHalf, low), _mm512_maskz_cvttpd_epi32(kHalf, high));
  }
  static Ints mask(Longs low, Longs high) noexcept {
    return joined(_mm512_maskz_cvtepi64_epi32(kHalf, reinterpret_cast<__m512i>(low)),
                  _mm512_maskz_cvtepi64_epi32(kHalf, reinterpret_cast<__m512i>(high)));
  }
  static std::uint32_t bits(Ints mask) noexcept { return _mm512_movepi32_mask(reinterpret_cast<__m512i>(mask)); }

 private:
  template <int kHigh>
  static __m256i half(Ints x) noexcept {
    return _mm512_maskz_extracti64x4_epi64(kHalf, reinterpret_cast<__m512i>(x), kHigh);
  }
  template <int kHigh>
  static __m256 half(Floats x) noexcept {
    return reinterpret_cast<__m256>(half<kHigh>(reinterpret_cast<Ints>(x)));
  }
  static Ints joined(__m256i low, __m256i high) noexcept {
    const __m512i first = _mm512_maskz_inserti64x4(kHalf, __m512i{}, low, 0);
    return reinterpret_cast<Ints>(_mm512_maskz_inserti64x4(kHalf, first, high, 1));
  }
};

}  // namespace
}  // namespace godobject::detail
