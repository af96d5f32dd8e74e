#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/scene/brick_lanes.h"
#include "core/scene/format.h"
#include "core/scene/sample_kernel.h"

/// Included once by a source for each kind of vectors, as clearance_kernel_lanes.h.
namespace godobject::detail {
namespace {

/// One component of the positions of a vector's points, in single precision as far as they lie within a cell.
/// `Vectors` have `kLanes` elements of 32 bits (`Floats`, `Ints`); of 64 bits (`Doubles`, `Longs`) two vectors make as
/// many, the low and the high half.
template <class Vectors>
struct SampleAxis {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;
  using Doubles = typename Vectors::Doubles;

  Ints within;  ///< -1 or 0, 0 for NaN
  Ints cell;    ///< of the grid, 0 where it is not within
  Floats at;    ///< in the cell

  /// Stores the components in the field's frame at `position`.
  SampleAxis(const FieldOfNodes& f, int axis, Floats x, Floats y, Floats z, double* position) noexcept {
    constexpr std::uint32_t kHalf = Vectors::kLanes / 2;
    const double(&m)[4] = f.to_field[axis];
    const Doubles low = m[0] * Vectors::low(x) + (m[1] * Vectors::low(y) + m[2] * Vectors::low(z)) + m[3];
    const Doubles high = m[0] * Vectors::high(x) + (m[1] * Vectors::high(y) + m[2] * Vectors::high(z)) + m[3];
    *reinterpret_cast<Doubles*>(position) = low;
    *reinterpret_cast<Doubles*>(position + kHalf) = high;
    const Doubles low_node = (low - f.origin[axis]) * f.per_voxel;
    const Doubles high_node = (high - f.origin[axis]) * f.per_voxel;
    within =
        Vectors::mask((low_node >= 0.0) & (low_node < f.cells[axis]), (high_node >= 0.0) & (high_node < f.cells[axis]));
    cell = Vectors::truncated(low_node, high_node) & within;
    at = Vectors::narrowed(low_node - Vectors::low(cell), high_node - Vectors::high(cell));
  }
};

/// One component in cells of a brick that is halved again and again: Voxelmap::descend.
template <class Vectors>
struct HalvedAxis {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;
  using Doubles = typename Vectors::Doubles;
  using Longs = typename Vectors::Longs;

  Doubles low, high;

  HalvedAxis(Ints cell, Floats at) noexcept
      : low(Vectors::low(cell) + Vectors::low(at)), high(Vectors::high(cell) + Vectors::high(at)) {}

  /// Which halves hold the points; -1: the upper.
  Ints upper() const noexcept { return Vectors::mask(low >= kMiddle, high >= kMiddle); }

  /// Those of `refined` go there.
  void halve(Ints refined) noexcept {
    halve(low, Vectors::low_mask(refined));
    halve(high, Vectors::high_mask(refined));
  }

  /// Cell and position in it of the points that were `refined`.
  void locate(Ints refined, Ints& cell, Floats& at) const noexcept {
    constexpr int kLast = format::kBrickCells - 1;
    const Ints truncated = Vectors::truncated(low, high);
    const Ints own = truncated > kLast ? kLast + Ints{} : truncated;
    const Floats own_at = Vectors::narrowed(low - Vectors::low(own), high - Vectors::high(own));
    cell = refined ? own : cell;
    at = refined ? own_at : at;
  }

 private:
  static constexpr double kMiddle = format::kBrickCells / 2;

  static void halve(Doubles& x, Longs refined) noexcept { x = refined ? 2.0 * (x >= kMiddle ? x - kMiddle : x) : x; }
};

/// Half of what was found, as Voxelmap::sample has it.
template <class Vectors>
typename Vectors::Longs store_samples(const FieldOfNodes& f, typename Vectors::Doubles distance,
                                      typename Vectors::Doubles lipschitz, const typename Vectors::Doubles (&slope)[3],
                                      SampleBatch& batch, std::uint32_t first) noexcept {
  using Doubles = typename Vectors::Doubles;
  using Longs = typename Vectors::Longs;
  const Doubles zero = {};
  const Longs known = (distance < f.band) & (-distance < f.band);
  const Doubles nearest = f.near_band < distance ? zero + f.near_band : distance;
  *reinterpret_cast<Doubles*>(batch.clearance + first) = distance > 0.0 ? nearest / lipschitz : zero;
  *reinterpret_cast<Doubles*>(batch.distance + first) =
      known ? distance : (distance < 0.0 ? zero - f.band : zero + f.band);
  *reinterpret_cast<Doubles*>(batch.gradient_x + first) = known ? f.quantum_per_voxel * slope[0] : zero;
  *reinterpret_cast<Doubles*>(batch.gradient_y + first) = known ? f.quantum_per_voxel * slope[1] : zero;
  *reinterpret_cast<Doubles*>(batch.gradient_z + first) = known ? f.quantum_per_voxel * slope[2] : zero;
  return known;
}

template <class Vectors>
std::uint32_t sample_lanes(const FieldOfNodes& f, SampleBatch& batch, std::uint32_t first) noexcept {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;
  using Doubles = typename Vectors::Doubles;
  namespace entry_of = format::index_entry;
  constexpr int kShift = std::countr_zero(static_cast<unsigned>(format::kBrickCells));
  constexpr int kCell = format::kBrickCells - 1;
  constexpr int kY = format::kBrickNodes;
  constexpr int kZ = format::kBrickNodes * format::kBrickNodes;
  constexpr int kBrickWords = sizeof(format::Brick) / sizeof(std::int16_t);
  constexpr int kLipschitz = offsetof(format::Brick, lipschitz) / sizeof(std::int16_t);
  constexpr int kRefinedWords = sizeof(format::Refined) / sizeof(std::uint32_t);
  constexpr int kOwn = offsetof(format::Refined, brick) / sizeof(std::uint32_t);
  constexpr int kChild = offsetof(format::Refined, child) / sizeof(std::uint32_t);
  static_assert(entry_of::kCoarse == 1u << 31);

  const Floats px = *reinterpret_cast<const Floats*>(batch.x + first);
  const Floats py = *reinterpret_cast<const Floats*>(batch.y + first);
  const Floats pz = *reinterpret_cast<const Floats*>(batch.z + first);
  SampleAxis<Vectors> x(f, 0, px, py, pz, batch.field_x + first);
  SampleAxis<Vectors> y(f, 1, px, py, pz, batch.field_y + first);
  SampleAxis<Vectors> z(f, 2, px, py, pz, batch.field_z + first);
  const Ints within = x.within & y.within & z.within;
  const Ints position = (x.cell >> kShift) + f.stride_y * (y.cell >> kShift) + f.stride_z * (z.cell >> kShift);
  Ints entry = Vectors::gather(f.index, position & within);
  x.cell &= kCell;
  y.cell &= kCell;
  z.cell &= kCell;
  Doubles low_unit = Doubles{} + f.quantum;
  Doubles high_unit = low_unit;
  const auto refined = [&] { return within & (entry >= 0) & ((entry & static_cast<int>(entry_of::kRefined)) != 0); };
  const Ints halved = refined();
  if (Vectors::bits(halved) != 0) {
    Ints descends = halved;
    HalvedAxis<Vectors> halved_x(x.cell, x.at);
    HalvedAxis<Vectors> halved_y(y.cell, y.at);
    HalvedAxis<Vectors> halved_z(z.cell, z.at);
    for (int level = 0; level < format::kMaxRefinement && Vectors::bits(descends) != 0; ++level) {
      const Ints octant = (halved_x.upper() & 1) | (halved_y.upper() & 2) | (halved_z.upper() & 4);
      const Ints refinement = kRefinedWords * (entry & static_cast<int>(entry_of::kNumber));
      const Ints child = Vectors::gather(f.refined, (refinement + kChild + octant) & descends);
      const Ints coarse = descends & (child < 0);
      if (Vectors::bits(coarse) != 0) {
        const Ints own = Vectors::gather(f.refined, (refinement + kOwn) & coarse);
        entry = coarse ? own | (child & static_cast<int>(entry_of::kEdged)) : entry;
      }
      descends &= ~coarse;
      entry = descends ? child : entry;
      halved_x.halve(descends);
      halved_y.halve(descends);
      halved_z.halve(descends);
      low_unit = Vectors::low_mask(descends) ? 0.5 * low_unit : low_unit;
      high_unit = Vectors::high_mask(descends) ? 0.5 * high_unit : high_unit;
      descends = refined();
    }
    halved_x.locate(halved, x.cell, x.at);
    halved_y.locate(halved, y.cell, y.at);
    halved_z.locate(halved, z.cell, z.at);
  }
  const Ints stored = within & (entry >= 0) & ((entry & static_cast<int>(entry_of::kEdged)) == 0);
  const Ints brick = kBrickWords * (entry & static_cast<int>(entry_of::kNumber) & stored);
  const Ints v = brick + x.cell + kY * y.cell + kZ * z.cell;
  // a node and the next along x
  const auto pair = [&](int at) noexcept { return Vectors::gather_pair(f.bricks + at, v); };
  const auto node = [](Ints two) noexcept { return __builtin_convertvector(first_of(two), Floats); };
  const auto step = [](Ints two) noexcept { return __builtin_convertvector(second_of(two) - first_of(two), Floats); };
  const Ints v00 = pair(0), v10 = pair(kY), v01 = pair(kZ), v11 = pair(kZ + kY);
  const Floats v000 = node(v00), v010 = node(v10), v001 = node(v01), v011 = node(v11);
  const Floats d00 = step(v00), d10 = step(v10), d01 = step(v01), d11 = step(v11);
  const Floats x00 = v000 + x.at * d00;
  const Floats x10 = v010 + x.at * d10;
  const Floats x01 = v001 + x.at * d01;
  const Floats x11 = v011 + x.at * d11;
  const Floats y0 = x00 + y.at * (x10 - x00);
  const Floats y1 = x01 + y.at * (x11 - x01);
  const Floats distance = y0 + z.at * (y1 - y0);
  const Floats d0 = d00 + y.at * (d10 - d00);
  const Floats d1 = d01 + y.at * (d11 - d01);
  const Floats gx = d0 + z.at * (d1 - d0);
  const Floats gy = (x10 - x00) + z.at * ((x11 - x01) - (x10 - x00));
  const Floats gz = y1 - y0;
  const Floats lipschitz = decode_lipschitz<Vectors>(Vectors::gather_pair(f.bricks + kLipschitz, brick));

  constexpr std::uint32_t kHalf = Vectors::kLanes / 2;
  const Doubles low_slope[3] = {Vectors::low(gx), Vectors::low(gy), Vectors::low(gz)};
  const Doubles high_slope[3] = {Vectors::high(gx), Vectors::high(gy), Vectors::high(gz)};
  const Ints known = Vectors::mask(
      store_samples<Vectors>(f, low_unit * Vectors::low(distance), Vectors::low(lipschitz), low_slope, batch, first),
      store_samples<Vectors>(f, high_unit * Vectors::high(distance), Vectors::high(lipschitz), high_slope, batch,
                             first + kHalf));
  constexpr std::uint64_t kLanes = (std::uint64_t{1} << Vectors::kLanes) - 1;
  batch.known = (batch.known & ~(kLanes << first)) | static_cast<std::uint64_t>(Vectors::bits(known & stored)) << first;
  return Vectors::bits(~stored);
}

}  // namespace
}  // namespace godobject::detail
