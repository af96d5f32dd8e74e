#pragma once

#include <cstdint>

#include <immintrin.h>

namespace godobject::detail {
namespace {

/// Vectors of AVX2, with the operations that clearance_kernel_lanes.h and cell_lanes.h list.
struct Avx2 {
  static constexpr std::uint32_t kLanes = 8;
  using Floats __attribute__((vector_size(4 * kLanes))) = float;
  using Ints __attribute__((vector_size(4 * kLanes))) = std::int32_t;
  using Doubles __attribute__((vector_size(4 * kLanes))) = double;
  using Longs __attribute__((vector_size(4 * kLanes))) = std::int64_t;

  static Ints gather(const std::uint32_t* from, Ints at) noexcept {
    return reinterpret_cast<Ints>(
        _mm256_i32gather_epi32(reinterpret_cast<const int*>(from), reinterpret_cast<__m256i>(at), sizeof(int)));
  }
  static Ints gather_pair(const std::int16_t* from, Ints at) noexcept {
    return reinterpret_cast<Ints>(_mm256_i32gather_epi32(reinterpret_cast<const int*>(from),
                                                         reinterpret_cast<__m256i>(at), sizeof(std::int16_t)));
  }
  static Ints truncated(Floats x) noexcept { return reinterpret_cast<Ints>(_mm256_cvttps_epi32(x)); }
  static Floats root(Floats x) noexcept { return _mm256_sqrt_ps(x); }
  static Floats larger(Floats a, Floats b) noexcept { return _mm256_max_ps(a, b); }
  static Floats smaller(Floats a, Floats b) noexcept { return _mm256_min_ps(a, b); }

  static Doubles low(Floats x) noexcept { return _mm256_cvtps_pd(_mm256_castps256_ps128(x)); }
  static Doubles high(Floats x) noexcept { return _mm256_cvtps_pd(_mm256_extractf128_ps(x, 1)); }
  static Doubles low(Ints x) noexcept { return _mm256_cvtepi32_pd(low_half(x)); }
  static Doubles high(Ints x) noexcept { return _mm256_cvtepi32_pd(high_half(x)); }
  static Longs low_mask(Ints x) noexcept { return reinterpret_cast<Longs>(_mm256_cvtepi32_epi64(low_half(x))); }
  static Longs high_mask(Ints x) noexcept { return reinterpret_cast<Longs>(_mm256_cvtepi32_epi64(high_half(x))); }
  static Floats narrowed(Doubles low, Doubles high) noexcept {
    return _mm256_set_m128(_mm256_cvtpd_ps(high), _mm256_cvtpd_ps(low));
  }
  static Ints truncated(Doubles low, Doubles high) noexcept {
    return reinterpret_cast<Ints>(_mm256_set_m128i(_mm256_cvttpd_epi32(high), _mm256_cvttpd_epi32(low)));
  }
  static Ints mask(Longs low, Longs high) noexcept {
    constexpr int kEven = 0b10'00'10'00;     // of four 32-bit words the first and the third, of either
    constexpr int kInOrder = 0b11'01'10'00;  // of four 64-bit words
    const __m256 mixed = _mm256_shuffle_ps(reinterpret_cast<__m256>(low), reinterpret_cast<__m256>(high), kEven);
    return reinterpret_cast<Ints>(_mm256_permute4x64_pd(reinterpret_cast<__m256d>(mixed), kInOrder));
  }
  static std::uint32_t bits(Ints mask) noexcept {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
  }

 private:
  static __m128i low_half(Ints x) noexcept { return _mm256_castsi256_si128(reinterpret_cast<__m256i>(x)); }
  static __m128i high_half(Ints x) noexcept { return _mm256_extracti128_si256(reinterpret_cast<__m256i>(x), 1); }
};

}  // namespace
}  // namespace godobject::detail
