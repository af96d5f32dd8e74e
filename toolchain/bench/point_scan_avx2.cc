#include "toolchain/bench/point_scan.h"

#if defined(__x86_64__)
#include <immintrin.h>

#define GODOBJECT_AVX2 __attribute__((target("avx2,fma,bmi,popcnt")))

namespace godobject::bench {
namespace {

constexpr std::size_t kLanes = 8;

struct Lattice {
  __m256 m[9];
  __m256 t[3];
  __m256 last[3];        // highest coordinate
  __m256i last_cell[3];  // highest cell
  __m256i stride_y;
  __m256i stride_z;
};

struct Coordinates {
  __m256 x, y, z;
};

GODOBJECT_AVX2 inline Lattice lattice(const GridView& grid, const LatticePose& pose) noexcept {
  Lattice l;
  for (int k = 0; k < 9; ++k) l.m[k] = _mm256_set1_ps(pose.m[k]);
  for (int k = 0; k < 3; ++k) {
    l.t[k] = _mm256_set1_ps(pose.t[k]);
    l.last[k] = _mm256_set1_ps(static_cast<float>(grid.nodes[k] - 1));
    l.last_cell[k] = _mm256_set1_epi32(grid.nodes[k] - 2);
  }
  l.stride_y = _mm256_set1_epi32(grid.nodes[0]);
  l.stride_z = _mm256_set1_epi32(grid.nodes[0] * grid.nodes[1]);
  return l;
}

GODOBJECT_AVX2 inline __m256 row(const Lattice& l, int k, __m256 x, __m256 y, __m256 z) noexcept {
  const __m256 q =
      _mm256_fmadd_ps(l.m[3 * k], x, _mm256_fmadd_ps(l.m[3 * k + 1], y, _mm256_fmadd_ps(l.m[3 * k + 2], z, l.t[k])));
  return _mm256_min_ps(_mm256_max_ps(q, _mm256_setzero_ps()), l.last[k]);
}

GODOBJECT_AVX2 inline Coordinates coordinates(const Lattice& l, __m256 x, __m256 y, __m256 z) noexcept {
  return {row(l, 0, x, y, z), row(l, 1, x, y, z), row(l, 2, x, y, z)};
}

GODOBJECT_AVX2 inline __m256i node(const Lattice& l, __m256i x, __m256i y, __m256i z) noexcept {
  return _mm256_add_epi32(x, _mm256_add_epi32(_mm256_mullo_epi32(y, l.stride_y), _mm256_mullo_epi32(z, l.stride_z)));
}

GODOBJECT_AVX2 inline __m256 gather(const float* base, __m256i at) noexcept { return _mm256_i32gather_ps(base, at, 4); }

GODOBJECT_AVX2 inline __m256 mix(__m256 low, __m256 high, __m256 f) noexcept {
  return _mm256_fmadd_ps(f, _mm256_sub_ps(high, low), low);
}

/// Appends the points of `lanes` (bits) that are near.
GODOBJECT_AVX2 inline void keep_near(const GridView& grid, const Lattice& l, const Coordinates& q, __m256i index,
                                     std::uint32_t lanes, const ScanLimits& limits, NearList& near) noexcept {
  const __m256i x = _mm256_min_epi32(_mm256_cvttps_epi32(q.x), l.last_cell[0]);
  const __m256i y = _mm256_min_epi32(_mm256_cvttps_epi32(q.y), l.last_cell[1]);
  const __m256i z = _mm256_min_epi32(_mm256_cvttps_epi32(q.z), l.last_cell[2]);
  const __m256 fx = _mm256_sub_ps(q.x, _mm256_cvtepi32_ps(x));
  const __m256 fy = _mm256_sub_ps(q.y, _mm256_cvtepi32_ps(y));
  const __m256 fz = _mm256_sub_ps(q.z, _mm256_cvtepi32_ps(z));
  const __m256i n000 = node(l, x, y, z);
  const __m256i n010 = _mm256_add_epi32(n000, l.stride_y);
  const __m256i n001 = _mm256_add_epi32(n000, l.stride_z);
  const __m256i n011 = _mm256_add_epi32(n010, l.stride_z);
  const float* const next = grid.value + 1;
  const __m256 v00 = gather(grid.value, n000);
  const __m256 v10 = gather(grid.value, n010);
  const __m256 v01 = gather(grid.value, n001);
  const __m256 v11 = gather(grid.value, n011);
  const __m256 dx00 = _mm256_sub_ps(gather(next, n000), v00);
  const __m256 dx10 = _mm256_sub_ps(gather(next, n010), v10);
  const __m256 dx01 = _mm256_sub_ps(gather(next, n001), v01);
  const __m256 dx11 = _mm256_sub_ps(gather(next, n011), v11);
  const __m256 c00 = _mm256_fmadd_ps(fx, dx00, v00);
  const __m256 c10 = _mm256_fmadd_ps(fx, dx10, v10);
  const __m256 c01 = _mm256_fmadd_ps(fx, dx01, v01);
  const __m256 c11 = _mm256_fmadd_ps(fx, dx11, v11);
  const __m256 c0 = mix(c00, c10, fy);
  const __m256 c1 = mix(c01, c11, fy);
  const __m256 distance = mix(c0, c1, fz);
  const __m256 below = _mm256_cmp_ps(distance, _mm256_set1_ps(limits.cut), _CMP_LT_OQ);
  std::uint32_t kept = lanes & static_cast<std::uint32_t>(_mm256_movemask_ps(below));
  if (kept == 0) return;
  const __m256 per_voxel = _mm256_set1_ps(limits.per_voxel);
  alignas(32) float d[kLanes], gx[kLanes], gy[kLanes], gz[kLanes];
  alignas(32) std::uint32_t order[kLanes];
  _mm256_store_ps(d, distance);
  _mm256_store_ps(gx, _mm256_mul_ps(per_voxel, mix(mix(dx00, dx10, fy), mix(dx01, dx11, fy), fz)));
  _mm256_store_ps(gy, _mm256_mul_ps(per_voxel, mix(_mm256_sub_ps(c10, c00), _mm256_sub_ps(c11, c01), fz)));
  _mm256_store_ps(gz, _mm256_mul_ps(per_voxel, _mm256_sub_ps(c1, c0)));
  _mm256_store_si256(reinterpret_cast<__m256i*>(order), index);
  for (; kept != 0; kept &= kept - 1) {
    const auto lane = static_cast<std::size_t>(__builtin_ctz(kept));
    near.index[near.count] = order[lane];
    near.distance[near.count] = d[lane];
    near.gradient_x[near.count] = gx[lane];
    near.gradient_y[near.count] = gy[lane];
    near.gradient_z[near.count] = gz[lane];
    ++near.count;
  }
}

inline std::uint32_t lanes_left(std::size_t count, std::size_t i) noexcept {
  return count - i >= kLanes ? 0xffu : (1u << (count - i)) - 1u;
}

GODOBJECT_AVX2 inline __m256i load(const std::uint32_t* from) noexcept {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}

}  // namespace

GODOBJECT_AVX2 void scan_trilinear_avx2(const GridView& grid, const PointView& points, const LatticePose& pose,
                                        const ScanLimits& limits, std::uint32_t*, NearList& near) noexcept {
  const Lattice l = lattice(grid, pose);
  near.count = 0;
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const Coordinates q =
        coordinates(l, _mm256_loadu_ps(points.x + i), _mm256_loadu_ps(points.y + i), _mm256_loadu_ps(points.z + i));
    keep_near(grid, l, q, load(points.order + i), lanes_left(points.count, i), limits, near);
  }
}

GODOBJECT_AVX2 void scan_cull_avx2(const GridView& grid, const PointView& points, const LatticePose& pose,
                                   const ScanLimits& limits, std::uint32_t* scratch, NearList& near) noexcept {
  const Lattice l = lattice(grid, pose);
  const __m256 cull = _mm256_set1_ps(limits.cull);
  std::size_t survivors = 0;
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const Coordinates q =
        coordinates(l, _mm256_loadu_ps(points.x + i), _mm256_loadu_ps(points.y + i), _mm256_loadu_ps(points.z + i));
    // round to the nearest node
    const __m256i at = node(l, _mm256_cvtps_epi32(q.x), _mm256_cvtps_epi32(q.y), _mm256_cvtps_epi32(q.z));
    const __m256 below = _mm256_cmp_ps(gather(grid.value, at), cull, _CMP_LT_OQ);
    auto kept = lanes_left(points.count, i) & static_cast<std::uint32_t>(_mm256_movemask_ps(below));
    for (; kept != 0; kept &= kept - 1) {
      scratch[survivors++] = static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(__builtin_ctz(kept));
    }
  }
  for (std::size_t k = survivors; k < survivors + kLanes; ++k) scratch[k] = 0;  // unused lanes
  near.count = 0;
  for (std::size_t k = 0; k < survivors; k += kLanes) {
    const __m256i i = load(scratch + k);
    const Coordinates q = coordinates(l, gather(points.x, i), gather(points.y, i), gather(points.z, i));
    const __m256i order = _mm256_i32gather_epi32(reinterpret_cast<const int*>(points.order), i, 4);
    keep_near(grid, l, q, order, lanes_left(survivors, k), limits, near);
  }
}

}  // namespace godobject::bench
#endif
