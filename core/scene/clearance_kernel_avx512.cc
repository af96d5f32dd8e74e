#if defined(__x86_64__)

#include <immintrin.h>

#include "core/scene/clearance_kernel_lanes.h"

namespace godobject::detail {
namespace {

struct Avx512 {
  static constexpr std::uint32_t kLanes = 16;
  using Floats __attribute__((vector_size(4 * kLanes))) = float;
  using Ints __attribute__((vector_size(4 * kLanes))) = std::int32_t;

  // masked by nothing: GCC 12 takes the unmasked ones for uses of undefined values
  static constexpr __mmask16 kAll = 0xffff;

  static Floats gather(const float* from, Ints at) noexcept {
    return _mm512_mask_i32gather_ps(Floats{}, kAll, reinterpret_cast<__m512i>(at), from, sizeof(float));
  }
  static Ints gather(const std::uint32_t* from, Ints at) noexcept {
    return reinterpret_cast<Ints>(
        _mm512_mask_i32gather_epi32(__m512i{}, kAll, reinterpret_cast<__m512i>(at), from, sizeof(int)));
  }
  static Ints truncated(Floats x) noexcept { return reinterpret_cast<Ints>(_mm512_maskz_cvttps_epi32(kAll, x)); }
  static Floats root(Floats x) noexcept { return _mm512_maskz_sqrt_ps(kAll, x); }
  static Floats larger(Floats a, Floats b) noexcept { return _mm512_maskz_max_ps(kAll, a, b); }
  static Floats smaller(Floats a, Floats b) noexcept { return _mm512_maskz_min_ps(kAll, a, b); }
};

}  // namespace

void look_up_clearances_avx512(const FieldOfCells& field, const float* x, const float* y, const float* z,
                               float* clearance, std::uint32_t count) noexcept {
  look_up_lanes<Avx512>(field, x, y, z, clearance, count);
}

}  // namespace godobject::detail

#endif
