#include "toolchain/bench/point_scan.h"

#if defined(__x86_64__)
#include <immintrin.h>

#define GODOBJECT_AVX512 __attribute__((target("avx512f,avx512vl,avx512dq,avx512bw,fma,bmi2,popcnt")))

namespace godobject::bench {
namespace {

constexpr std::size_t kLanes = 16;

struct Lattice {
  __m512 m[9];
  __m512 t[3];
  __m512 last[3];        // highest coordinate
  __m512i last_cell[3];  // highest cell
  __m512i stride_y;
  __m512i stride_z;
};

struct Coordinates {
  __m512 x, y, z;
};

GODOBJECT_AVX512 inline Lattice lattice(const GridView& grid, const LatticePose& pose) noexcept {
  Lattice l;
  for (int k = 0; k < 9; ++k) l.m[k] = _mm512_set1_ps(pose.m[k]);
  for (int k = 0; k < 3; ++k) {
    l.t[k] = _mm512_set1_ps(pose.t[k]);
    l.last[k] = _mm512_set1_ps(static_cast<float>(grid.nodes[k] - 1));
    l.last_cell[k] = _mm512_set1_epi32(grid.nodes[k] - 2);
  }
  l.stride_y = _mm512_set1_epi32(grid.nodes[0]);
  l.stride_z = _mm512_set1_epi32(grid.nodes[0] * grid.nodes[1]);
  return l;
}

GODOBJECT_AVX512 inline __m512 row(const Lattice& l, int k, __m512 x, __m512 y, __m512 z) noexcept {
  const __m512 q =
      _mm512_fmadd_ps(l.m[3 * k], x, _mm512_fmadd_ps(l.m[3 * k + 1], y, _mm512_fmadd_ps(l.m[3 * k + 2], z, l.t[k])));
  return _mm512_min_ps(_mm512_max_ps(q, _mm512_setzero_ps()), l.last[k]);
}

GODOBJECT_AVX512 inline Coordinates coordinates(const Lattice& l, __m512 x, __m512 y, __m512 z) noexcept {
  return {row(l, 0, x, y, z), row(l, 1, x, y, z), row(l, 2, x, y, z)};
}

GODOBJECT_AVX512 inline __m512i node(const Lattice& l, __m512i x, __m512i y, __m512i z) noexcept {
  return _mm512_add_epi32(x, _mm512_add_epi32(_mm512_mullo_epi32(y, l.stride_y), _mm512_mullo_epi32(z, l.stride_z)));
}

GODOBJECT_AVX512 inline __m512 gather(const float* base, __m512i at) noexcept {
  return _mm512_i32gather_ps(at, base, 4);
}

GODOBJECT_AVX512 inline __m512 mix(__m512 low, __m512 high, __m512 f) noexcept {
  return _mm512_fmadd_ps(f, _mm512_sub_ps(high, low), low);
}

/// Appends the points of `lanes` that are near.
GODOBJECT_AVX512 inline void keep_near(const GridView& grid, const Lattice& l, const Coordinates& q, __m512i index,
                                       __mmask16 lanes, const ScanLimits& limits, NearList& near) noexcept {
  const __m512i x = _mm512_min_epi32(_mm512_cvttps_epi32(q.x), l.last_cell[0]);
  const __m512i y = _mm512_min_epi32(_mm512_cvttps_epi32(q.y), l.last_cell[1]);
  const __m512i z = _mm512_min_epi32(_mm512_cvttps_epi32(q.z), l.last_cell[2]);
  const __m512 fx = _mm512_sub_ps(q.x, _mm512_cvtepi32_ps(x));
  const __m512 fy = _mm512_sub_ps(q.y, _mm512_cvtepi32_ps(y));
  const __m512 fz = _mm512_sub_ps(q.z, _mm512_cvtepi32_ps(z));
  const __m512i n000 = node(l, x, y, z);
  const __m512i n010 = _mm512_add_epi32(n000, l.stride_y);
  const __m512i n001 = _mm512_add_epi32(n000, l.stride_z);
  const __m512i n011 = _mm512_add_epi32(n010, l.stride_z);
  const float* const next = grid.value + 1;
  const __m512 v00 = gather(grid.value, n000);
  const __m512 v10 = gather(grid.value, n010);
  const __m512 v01 = gather(grid.value, n001);
  const __m512 v11 = gather(grid.value, n011);
  const __m512 dx00 = _mm512_sub_ps(gather(next, n000), v00);
  const __m512 dx10 = _mm512_sub_ps(gather(next, n010), v10);
  const __m512 dx01 = _mm512_sub_ps(gather(next, n001), v01);
  const __m512 dx11 = _mm512_sub_ps(gather(next, n011), v11);
  const __m512 c00 = _mm512_fmadd_ps(fx, dx00, v00);
  const __m512 c10 = _mm512_fmadd_ps(fx, dx10, v10);
  const __m512 c01 = _mm512_fmadd_ps(fx, dx01, v01);
  const __m512 c11 = _mm512_fmadd_ps(fx, dx11, v11);
  const __m512 c0 = mix(c00, c10, fy);
  const __m512 c1 = mix(c01, c11, fy);
  const __m512 distance = mix(c0, c1, fz);
  const __mmask16 kept = _mm512_mask_cmp_ps_mask(lanes, distance, _mm512_set1_ps(limits.cut), _CMP_LT_OQ);
  if (kept == 0) return;
  const __m512 per_voxel = _mm512_set1_ps(limits.per_voxel);
  const __m512 gx = _mm512_mul_ps(per_voxel, mix(mix(dx00, dx10, fy), mix(dx01, dx11, fy), fz));
  const __m512 gy = _mm512_mul_ps(per_voxel, mix(_mm512_sub_ps(c10, c00), _mm512_sub_ps(c11, c01), fz));
  const __m512 gz = _mm512_mul_ps(per_voxel, _mm512_sub_ps(c1, c0));
  const std::size_t n = near.count;
  _mm512_storeu_si512(near.index + n, _mm512_maskz_compress_epi32(kept, index));
  _mm512_storeu_ps(near.distance + n, _mm512_maskz_compress_ps(kept, distance));
  _mm512_storeu_ps(near.gradient_x + n, _mm512_maskz_compress_ps(kept, gx));
  _mm512_storeu_ps(near.gradient_y + n, _mm512_maskz_compress_ps(kept, gy));
  _mm512_storeu_ps(near.gradient_z + n, _mm512_maskz_compress_ps(kept, gz));
  near.count = n + static_cast<std::size_t>(__builtin_popcount(kept));
}

GODOBJECT_AVX512 inline __mmask16 lanes_left(std::size_t count, std::size_t i) noexcept {
  return static_cast<__mmask16>(count - i >= kLanes ? 0xffffu : (1u << (count - i)) - 1u);
}

}  // namespace

GODOBJECT_AVX512 void scan_trilinear_avx512(const GridView& grid, const PointView& points, const LatticePose& pose,
                                            const ScanLimits& limits, std::uint32_t*, NearList& near) noexcept {
  const Lattice l = lattice(grid, pose);
  near.count = 0;
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const Coordinates q =
        coordinates(l, _mm512_loadu_ps(points.x + i), _mm512_loadu_ps(points.y + i), _mm512_loadu_ps(points.z + i));
    keep_near(grid, l, q, _mm512_loadu_si512(points.order + i), lanes_left(points.count, i), limits, near);
  }
}

GODOBJECT_AVX512 void scan_cull_avx512(const GridView& grid, const PointView& points, const LatticePose& pose,
                                       const ScanLimits& limits, std::uint32_t* scratch, NearList& near) noexcept {
  const Lattice l = lattice(grid, pose);
  const __m512 cull = _mm512_set1_ps(limits.cull);
  const __m512i step = _mm512_set1_epi32(kLanes);
  __m512i number = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  std::size_t survivors = 0;
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const Coordinates q =
        coordinates(l, _mm512_loadu_ps(points.x + i), _mm512_loadu_ps(points.y + i), _mm512_loadu_ps(points.z + i));
    // round to the nearest node
    const __m512i at = node(l, _mm512_cvtps_epi32(q.x), _mm512_cvtps_epi32(q.y), _mm512_cvtps_epi32(q.z));
    const __mmask16 kept = _mm512_cmp_ps_mask(gather(grid.value, at), cull, _CMP_LT_OQ);
    if (kept != 0) {
      _mm512_storeu_si512(scratch + survivors, _mm512_maskz_compress_epi32(kept, number));
      survivors += static_cast<std::size_t>(__builtin_popcount(kept));
    }
    number = _mm512_add_epi32(number, step);
  }
  near.count = 0;
  for (std::size_t k = 0; k < survivors; k += kLanes) {
    __mmask16 lanes = lanes_left(survivors, k);
    const __m512i i = _mm512_maskz_loadu_epi32(lanes, scratch + k);
    // the padding behind the last point may have passed the cull
    lanes = _mm512_mask_cmplt_epu32_mask(lanes, i, _mm512_set1_epi32(static_cast<int>(points.count)));
    const Coordinates q = coordinates(l, gather(points.x, i), gather(points.y, i), gather(points.z, i));
    const __m512i order = _mm512_i32gather_epi32(i, points.order, 4);
    keep_near(grid, l, q, order, lanes, limits, near);
  }
}

}  // namespace godobject::bench
#endif
