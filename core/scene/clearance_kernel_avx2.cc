#if defined(__x86_64__)

#include <immintrin.h>

#include "core/scene/clearance_kernel_lanes.h"

namespace godobject::detail {
namespace {

struct Avx2 {
  static constexpr std::uint32_t kLanes = 8;
  using Floats __attribute__((vector_size(4 * kLanes))) = float;
  using Ints __attribute__((vector_size(4 * kLanes))) = std::int32_t;

  static Floats gather(const float* from, Ints at) noexcept {
    return _mm256_i32gather_ps(from, reinterpret_cast<__m256i>(at), sizeof(float));
  }
  static Ints gather(const std::uint32_t* from, Ints at) noexcept {
    return reinterpret_cast<Ints>(
        _mm256_i32gather_epi32(reinterpret_cast<const int*>(from), reinterpret_cast<__m256i>(at), sizeof(int)));
  }
  static Ints truncated(Floats x) noexcept { return reinterpret_cast<Ints>(_mm256_cvttps_epi32(x)); }
  static Floats root(Floats x) noexcept { return _mm256_sqrt_ps(x); }
  static Floats larger(Floats a, Floats b) noexcept { return _mm256_max_ps(a, b); }
  static Floats smaller(Floats a, Floats b) noexcept { return _mm256_min_ps(a, b); }
};

}  // namespace

void look_up_clearances_avx2(const FieldOfCells& field, const float* x, const float* y, const float* z,
                             float* clearance, std::uint32_t count) noexcept {
  look_up_lanes<Avx2>(field, x, y, z, clearance, count);
}

}  // namespace godobject::detail

#endif
