#pragma once

#include "core/scene/brick_lanes.h"
#include "core/scene/clearance_kernel.h"

/// The kernel of Voxelmap::clearances for any vector type. Each vector type's source file includes it once and is
/// compiled for these vectors. All names are local to that source (unnamed namespace), so that the linker cannot use
/// them elsewhere.
namespace godobject::detail {
namespace {

using format::kBrickNodes;
namespace index_entry = format::index_entry;

/// Returns the linear interpolation at 0 <= `at` <= 1.
template <class F>
F between(F low, F high, F at) noexcept {
  return low + at * (high - low);
}

/// One component of the points' positions.
template <class Vectors>
struct Axis {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;

  Floats cells;  ///< from the grid's origin [cells]
  Ints within;   ///< -1 inside of the grid; 0 outside and for NaN
  Ints cell;     ///< of the grid; 0 outside
  Floats at;     ///< position in the cell, 0 .. 1

  Axis(const FieldOfCells& f, int axis, Floats x, Floats y, Floats z) noexcept {
    const float(&m)[4] = f.to_cells[axis];
    cells = m[0] * x + m[1] * y + m[2] * z + m[3];
    within = (cells >= 0.0f) & (cells < f.cells[axis]);
    cell = Vectors::truncated(cells) & within;
    at = cells - __builtin_convertvector(cell, Floats);
  }

  /// Returns the squared component of the distance to the surface's box.
  Floats squared_away(const FieldOfCells& f, int axis) const noexcept {
    const Floats away =
        Vectors::larger(Vectors::larger(f.surface_min[axis] - cells, cells - f.surface_max[axis]), Floats{});
    return away * away;
  }
  /// Returns the squared component of the distance to the centre of the brick's position.
  Floats squared_from_center() const noexcept {
    const Floats from_center =
        cells - (__builtin_convertvector(cell & ~(format::kBrickCells - 1), Floats) + kBrickCenter);
    return from_center * from_center;
  }
  Floats absolute() const noexcept { return reinterpret_cast<Floats>(reinterpret_cast<Ints>(cells) & 0x7fffffff); }
};

/// LookUpClearances for any vector type. `Vectors` has `Floats` and `Ints` of `kLanes` elements of 32 bits, for which
/// the compiler has arithmetic, comparisons (-1 or 0) and selections, and the functions gather, gather_pair (a 16-bit
/// word and, in the upper half, the next), truncated, root, larger and smaller. `count`: a multiple of kLanes; the
/// arrays are aligned to the vectors.
template <class Vectors>
void look_up_lanes(const FieldOfCells& f, const float* xs, const float* ys, const float* zs, float* clearance,
                   std::uint32_t count) noexcept {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;
  const Floats zero = {};
  for (std::uint32_t i = 0; i < count; i += Vectors::kLanes) {
    const Floats px = *reinterpret_cast<const Floats*>(xs + i);
    const Floats py = *reinterpret_cast<const Floats*>(ys + i);
    const Floats pz = *reinterpret_cast<const Floats*>(zs + i);
    const Axis<Vectors> x(f, 0, px, py, pz);
    const Axis<Vectors> y(f, 1, px, py, pz);
    const Axis<Vectors> z(f, 2, px, py, pz);
    const Ints within = x.within & y.within & z.within;
    const Ints position =
        (x.cell >> kBrickShift) + f.stride_y * (y.cell >> kBrickShift) + f.stride_z * (z.cell >> kBrickShift);
    const Ints entry = Vectors::gather(f.index, position & within);
    const Ints far = entry < 0;
    const Ints halved = ((entry & static_cast<int>(index_entry::kRefined)) != 0) & ~far;
    const Ints number = entry & static_cast<int>(index_entry::kNumber) & ~far;
    const Ints own = Vectors::gather(f.refined, kRefinedWords * number & halved);
    const Ints brick = kBrickWords * (halved ? own : number);
    constexpr int kCell = format::kBrickCells - 1;
    constexpr int kY = kBrickNodes;
    constexpr int kZ = kBrickNodes * kBrickNodes;
    const Ints v = brick + (x.cell & kCell) + kY * (y.cell & kCell) + kZ * (z.cell & kCell);
    const auto edge = [&](int node) noexcept {
      const Ints pair = Vectors::gather_pair(f.bricks + node, v);
      return between(__builtin_convertvector(first_of(pair), Floats), __builtin_convertvector(second_of(pair), Floats),
                     x.at);
    };
    const Floats near_face = between(edge(0), edge(kY), y.at);
    const Floats far_face = between(edge(kZ), edge(kZ + kY), y.at);
    const Ints bounds = Vectors::gather_pair(f.bricks + kLipschitzAt, brick);
    const Floats distance = f.quantum * (between(near_face, far_face, z.at) - second_unsigned<Vectors>(bounds));
    const Floats stored =
        Vectors::smaller(Vectors::larger(distance, zero), zero + f.near_band) / decode_lipschitz<Vectors>(bounds);
    const Floats from_center = x.squared_from_center() + y.squared_from_center() + z.squared_from_center();
    const Floats squared_away = x.squared_away(f, 0) + y.squared_away(f, 1) + z.squared_away(f, 2);
    const Floats away = Vectors::root(within ? from_center : squared_away);
    const Floats of_center = reinterpret_cast<Floats>((entry & far & static_cast<int>(index_entry::kLow)) << 1);
    const Floats free = Vectors::larger(of_center - kLengthRoundedUp * f.cell_edge * away, zero + f.assured);
    const Ints inside = (entry & static_cast<int>(index_entry::kInside)) != 0;
    const Floats outside = Vectors::larger(f.cell_edge * (away - f.outside_off), zero + f.assured);
    const Floats bound = within ? (far ? (inside ? zero : free) : stored) : outside;
    const Floats shift = x.absolute() + y.absolute() + z.absolute() + f.offset;
    *reinterpret_cast<Floats*>(clearance + i) = bound - kPointRounding * f.cell_edge * shift;
  }
}

}  // namespace
}  // namespace godobject::detail
