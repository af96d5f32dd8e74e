#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/scene/brick_lanes.h"
#include "core/scene/format.h"
#include "core/scene/sample_kernel.h"

/// The grid cells of a vector of points. Each vector type's source file includes it once, as clearance_kernel_lanes.h.
/// `Vectors` have `kLanes` elements of 32 bits (`Floats`, `Ints`). Elements of 64 bits (`Doubles`, `Longs`) fill two
/// vectors, the low and the high half.
namespace godobject::detail {
namespace {

/// One component of the points' positions: the cell, and in single precision the position within it.
template <class Vectors>
struct CellAxis {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;
  using Doubles = typename Vectors::Doubles;

  Ints within;  ///< -1 inside of the grid; 0 outside and for NaN
  Ints cell;    ///< of the grid; 0 outside
  Floats at;    ///< position in the cell, 0 .. 1

  /// Splits the component, given in voxels from the origin of a grid of `cells` cells.
  [[gnu::always_inline]] CellAxis(Doubles low, Doubles high, double cells) noexcept
      : within(Vectors::mask((low >= 0.0) & (low < cells), (high >= 0.0) & (high < cells))),
        cell(Vectors::truncated(low, high) & within),
        at(Vectors::narrowed(low - Vectors::low(cell), high - Vectors::high(cell))) {}
};

/// One component of the position in a refined brick [cells], halved once for each level: as Voxelmap::descend.
template <class Vectors>
struct HalvedAxis {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;
  using Doubles = typename Vectors::Doubles;
  using Longs = typename Vectors::Longs;

  Doubles low, high;

  [[gnu::always_inline]] HalvedAxis(Ints cell, Floats at) noexcept
      : low(Vectors::low(cell) + Vectors::low(at)), high(Vectors::high(cell) + Vectors::high(at)) {}

  /// Returns the half that contains each point; -1: the upper.
  Ints upper() const noexcept { return Vectors::mask(low >= kMiddle, high >= kMiddle); }

  /// Moves the points of `refined` to the coordinates of their half.
  void halve(Ints refined) noexcept {
    halve(low, Vectors::low_mask(refined));
    halve(high, Vectors::high_mask(refined));
  }

  /// Sets cell and position in it of the points of `refined`.
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

/// The cells' nodes, found through the brick index and its refinements as in Voxelmap::sample.
template <class Vectors>
struct CellLanes {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;

  static constexpr int kY = format::kBrickNodes;
  static constexpr int kZ = format::kBrickNodes * format::kBrickNodes;

  Ints stored;   ///< -1: the nodes define the field, with the facets if there are any; 0: outside of the grid, or far
  Ints facets;   ///< format::cell_facets; 0: none
  Ints brick;    ///< index of the brick's first word
  Ints node;     ///< index of the cell's first node
  Floats at[3];  ///< position in the cell, 0 .. 1
  Floats cell_edge;  ///< [voxels]

  [[gnu::always_inline]] CellLanes(const FieldOfNodes& f, const CellAxis<Vectors>& x, const CellAxis<Vectors>& y,
                                   const CellAxis<Vectors>& z) noexcept
      : at{x.at, y.at, z.at}, cell_edge(1.0f + Floats{}) {
    namespace entry_of = format::index_entry;
    constexpr int kShift = std::countr_zero(static_cast<unsigned>(format::kBrickCells));
    constexpr int kCell = format::kBrickCells - 1;
    constexpr int kBrickWords = sizeof(format::Brick) / sizeof(std::int16_t);
    static_assert(entry_of::kCoarse == 1u << 31);

    const Ints within = x.within & y.within & z.within;
    const Ints position = (x.cell >> kShift) + f.stride_y * (y.cell >> kShift) + f.stride_z * (z.cell >> kShift);
    Ints entry = Vectors::gather(f.index, position & within);
    Ints cell[3] = {x.cell & kCell, y.cell & kCell, z.cell & kCell};
    const Ints refined = within & is_refined(entry);
    if (Vectors::bits(refined) != 0) descend(f, refined, entry, cell);
    stored = within & (entry >= 0);
    brick = kBrickWords * (entry & static_cast<int>(entry_of::kNumber) & stored);
    node = brick + cell[0] + kY * cell[1] + kZ * cell[2];
    const Ints exact = stored & ((entry & static_cast<int>(entry_of::kExact)) != 0);
    facets = Ints{};
    if (Vectors::bits(exact) != 0) {
      constexpr int kExactWords = sizeof(format::ExactBrick) / sizeof(std::uint32_t);
      static_assert(offsetof(format::ExactBrick, cell) == 0);
      const Ints number = cell[0] + format::kBrickCells * (cell[1] + format::kBrickCells * cell[2]);
      facets = Vectors::gather(f.exact, (kExactWords * exact_brick(f) + number) & exact) & exact;
    }
  }

  /// Returns the numbers of the exact bricks; of no meaning where the brick is not exact.
  Ints exact_brick(const FieldOfNodes& f) const noexcept {
    constexpr int kDeviation = offsetof(format::Brick, deviation) / sizeof(std::int16_t);
    static_assert(offsetof(format::Brick, exact) == offsetof(format::Brick, deviation) + sizeof(std::uint16_t));
    return ((Vectors::gather_pair(f.bricks + kDeviation, brick) >> 16) & 0xffff) - 1;
  }

  /// Returns the brick's bound of the gradient [1].
  Floats lipschitz(const FieldOfNodes& f) const noexcept {
    constexpr int kLipschitz = offsetof(format::Brick, lipschitz) / sizeof(std::int16_t);
    return decode_lipschitz<Vectors>(Vectors::gather_pair(f.bricks + kLipschitz, brick));
  }

 private:
  static Ints is_refined(Ints entry) noexcept {
    return (entry >= 0) & ((entry & static_cast<int>(format::index_entry::kRefined)) != 0);
  }

  /// Descends the refinements as Voxelmap::descend.
  void descend(const FieldOfNodes& f, Ints refined, Ints& entry, Ints (&cell)[3]) noexcept {
    namespace entry_of = format::index_entry;
    constexpr int kRefinedWords = sizeof(format::Refined) / sizeof(std::uint32_t);
    constexpr int kOwn = offsetof(format::Refined, brick) / sizeof(std::uint32_t);
    constexpr int kChild = offsetof(format::Refined, child) / sizeof(std::uint32_t);
    Ints descends = refined;
    HalvedAxis<Vectors> x(cell[0], at[0]);
    HalvedAxis<Vectors> y(cell[1], at[1]);
    HalvedAxis<Vectors> z(cell[2], at[2]);
    for (int level = 0; level < format::kMaxRefinement && Vectors::bits(descends) != 0; ++level) {
      const Ints octant = (x.upper() & 1) | (y.upper() & 2) | (z.upper() & 4);
      const Ints refinement = kRefinedWords * (entry & static_cast<int>(entry_of::kNumber));
      const Ints child = Vectors::gather(f.refined, (refinement + kChild + octant) & descends);
      const Ints coarse = descends & (child < 0);
      if (Vectors::bits(coarse) != 0) {
        const Ints own = Vectors::gather(f.refined, (refinement + kOwn) & coarse);
        entry = coarse ? own | (child & static_cast<int>(entry_of::kExact)) : entry;
      }
      descends &= ~coarse;
      entry = descends ? child : entry;
      x.halve(descends);
      y.halve(descends);
      z.halve(descends);
      cell_edge = descends ? 0.5f * cell_edge : cell_edge;
      descends &= is_refined(entry);
    }
    x.locate(refined, cell[0], at[0]);
    y.locate(refined, cell[1], at[1]);
    z.locate(refined, cell[2], at[2]);
  }
};

/// The numbers at the cells' eight nodes: distances or weights.
template <class Vectors>
struct NodeLanes {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;

  Floats v000, v010, v001, v011;  ///< at the lower x; the digits are x, y, z
  Floats d00, d10, d01, d11;      ///< difference from the lower to the upper x; the digits are y, z

  /// `first`: indices of the cells' first nodes.
  [[gnu::always_inline]] NodeLanes(const std::int16_t* nodes, Ints first) noexcept {
    constexpr int kY = CellLanes<Vectors>::kY;
    constexpr int kZ = CellLanes<Vectors>::kZ;
    // a node and the next along x
    const auto pair = [&](int at) noexcept { return Vectors::gather_pair(nodes + at, first); };
    const auto node = [](Ints two) noexcept { return __builtin_convertvector(first_of(two), Floats); };
    const auto step = [](Ints two) noexcept { return __builtin_convertvector(second_of(two) - first_of(two), Floats); };
    const Ints p00 = pair(0), p10 = pair(kY), p01 = pair(kZ), p11 = pair(kZ + kY);
    v000 = node(p00), v010 = node(p10), v001 = node(p01), v011 = node(p11);
    d00 = step(p00), d10 = step(p10), d01 = step(p01), d11 = step(p11);
  }
};

/// Trilinear interpolation of the numbers at the cells' nodes.
template <class Vectors>
struct TrilinearLanes {
  using Floats = typename Vectors::Floats;

  Floats value;
  Floats gradient[3];  ///< per cell

  [[gnu::always_inline]] TrilinearLanes(const NodeLanes<Vectors>& n, const Floats (&at)[3]) noexcept {
    const auto& [fx, fy, fz] = at;
    const Floats x00 = n.v000 + fx * n.d00;
    const Floats x10 = n.v010 + fx * n.d10;
    const Floats x01 = n.v001 + fx * n.d01;
    const Floats x11 = n.v011 + fx * n.d11;
    const Floats y0 = x00 + fy * (x10 - x00);
    const Floats y1 = x01 + fy * (x11 - x01);
    const Floats d0 = n.d00 + fy * (n.d10 - n.d00);
    const Floats d1 = n.d01 + fy * (n.d11 - n.d01);
    value = y0 + fz * (y1 - y0);
    gradient[0] = d0 + fz * (d1 - d0);
    gradient[1] = (x10 - x00) + fz * ((x11 - x01) - (x10 - x00));
    gradient[2] = y1 - y0;
  }
};

}  // namespace
}  // namespace godobject::detail
