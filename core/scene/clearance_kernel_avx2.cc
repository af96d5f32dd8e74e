#include "core/scene/clearance_kernel.h"

#if defined(__x86_64__)

#include <immintrin.h>

namespace godobject::detail {
namespace {

using format::kBrickNodes;
namespace index_entry = format::index_entry;

// arithmetic, comparisons and selections of vectors are the compiler's; only what it has no operator for is intrinsic
using Floats __attribute__((vector_size(32))) = float;
using Ints __attribute__((vector_size(32))) = std::int32_t;
using Mask = Ints;  ///< -1 or 0

Floats gather(const float* from, Ints at) noexcept {
  return _mm256_i32gather_ps(from, reinterpret_cast<__m256i>(at), sizeof(float));
}
Ints gather(const std::uint32_t* from, Ints at) noexcept {
  return reinterpret_cast<Ints>(
      _mm256_i32gather_epi32(reinterpret_cast<const int*>(from), reinterpret_cast<__m256i>(at), sizeof(int)));
}
Floats larger(Floats a, Floats b) noexcept { return _mm256_max_ps(a, b); }
Floats smaller(Floats a, Floats b) noexcept { return _mm256_min_ps(a, b); }
Floats absolute(Floats a) noexcept { return reinterpret_cast<Floats>(reinterpret_cast<Ints>(a) & 0x7fffffff); }
Floats between(Floats low, Floats high, Floats at) noexcept { return low + at * (high - low); }

struct Axis {
  Floats cells;  ///< from the grid's origin
  Mask within;   ///< false for NaN
  Ints cell;     ///< of it, 0 where it is not within
  Floats at;     ///< in the cell

  Axis(const FieldOfCells& f, int axis, Floats x, Floats y, Floats z) noexcept {
    const float(&m)[4] = f.to_cells[axis];
    cells = m[0] * x + m[1] * y + m[2] * z + m[3];
    within = (cells >= 0.0f) & (cells < f.cells[axis]);
    cell = reinterpret_cast<Ints>(_mm256_cvttps_epi32(cells)) & within;
    at = cells - __builtin_convertvector(cell, Floats);
  }
};

Floats squared_away(const FieldOfCells& f, int axis, Floats cells) noexcept {
  const Floats zero = {};
  const Floats away = larger(larger(f.surface_min[axis] - cells, cells - f.surface_max[axis]), zero);
  return away * away;
}

}  // namespace

void look_up_clearances_avx2(const FieldOfCells& f, const float* xs, const float* ys, const float* zs, float* clearance,
                             std::uint32_t count) noexcept {
  constexpr std::uint32_t kLanes = sizeof(Floats) / sizeof(float);
  const Floats zero = {};
  for (std::uint32_t i = 0; i < count; i += kLanes) {
    const Floats px = _mm256_load_ps(xs + i);
    const Floats py = _mm256_load_ps(ys + i);
    const Floats pz = _mm256_load_ps(zs + i);
    const Axis x(f, 0, px, py, pz);
    const Axis y(f, 1, px, py, pz);
    const Axis z(f, 2, px, py, pz);
    const Mask within = x.within & y.within & z.within;
    const Ints position =
        (x.cell >> kBrickShift) + f.stride_y * (y.cell >> kBrickShift) + f.stride_z * (z.cell >> kBrickShift);
    const Ints entry = gather(f.index, position & within);
    const Mask far = entry < 0;
    const Mask halved = ((entry & static_cast<int>(index_entry::kRefined)) != 0) & ~far;
    const Ints number = entry & static_cast<int>(index_entry::kNumber) & ~far;
    const Ints own = gather(f.refined, kRefinedWords * number & halved);
    const Ints brick = kBrickFloats * (halved ? own : number);
    constexpr int kCell = format::kBrickCells - 1;
    constexpr int kY = kBrickNodes;
    constexpr int kZ = kBrickNodes * kBrickNodes;
    const Ints v = brick + (x.cell & kCell) + kY * (y.cell & kCell) + kZ * (z.cell & kCell);
    const Floats x00 = between(gather(f.bricks, v), gather(f.bricks + 1, v), x.at);
    const Floats x10 = between(gather(f.bricks + kY, v), gather(f.bricks + kY + 1, v), x.at);
    const Floats x01 = between(gather(f.bricks + kZ, v), gather(f.bricks + kZ + 1, v), x.at);
    const Floats x11 = between(gather(f.bricks + kZ + kY, v), gather(f.bricks + kZ + kY + 1, v), x.at);
    const Floats distance =
        between(between(x00, x10, y.at), between(x01, x11, y.at), z.at) - gather(f.bricks + kDeviationAt, brick);
    const Floats stored = smaller(larger(distance, zero), zero + f.near_band) / gather(f.bricks + kLipschitzAt, brick);
    const Floats free =
        larger(reinterpret_cast<Floats>((entry & static_cast<int>(index_entry::kLow)) << 1), zero + f.assured);
    const Mask inside = (entry & static_cast<int>(index_entry::kInside)) != 0;
    const Floats away =
        _mm256_sqrt_ps(squared_away(f, 0, x.cells) + squared_away(f, 1, y.cells) + squared_away(f, 2, z.cells));
    const Floats outside = larger(f.outside_share * f.cell_edge * (away - f.outside_off), zero + f.assured);
    const Floats bound = within ? (far ? (inside ? zero : free) : stored) : outside;
    const Floats shift = absolute(x.cells) + absolute(y.cells) + absolute(z.cells) + f.offset;
    _mm256_store_ps(clearance + i, bound - kPointRounding * f.cell_edge * shift);
  }
}

}  // namespace godobject::detail

#endif
