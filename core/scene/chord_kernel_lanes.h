#pragma once

#include <cstdint>

#include "core/scene/cell_lanes.h"
#include "core/scene/sample_kernel.h"

/// Each vector type's source file includes it once, as clearance_kernel_lanes.h.
namespace godobject::detail {
namespace {

/// Tells whether the field of a cell is proved above `least` [quanta] along a straight line, and computes its value at
/// the `end`. Along a line the trilinear field is a cubic, which stays within the range of its Bernstein coefficients.
/// These are averages of the field at the corners of the box whose diagonal is the line (the cubic's blossom).
template <class Vectors>
[[gnu::always_inline]] inline typename Vectors::Ints stays_above(const NodeLanes<Vectors>& n,
                                                                 const typename Vectors::Floats (&from)[3],
                                                                 const typename Vectors::Floats (&to)[3],
                                                                 typename Vectors::Floats least,
                                                                 typename Vectors::Floats& end) noexcept {
  using Floats = typename Vectors::Floats;
  constexpr float kThird = 1.0f / 3.0f;
  // the digits are the corners' x, y, z: of `from` (0) or of `to` (1)
  struct Between {
    Floats at_from, at_to;
    Between(Floats value, Floats slope, const Floats (&from)[3], const Floats (&to)[3], int axis) noexcept
        : at_from(value + from[axis] * slope), at_to(value + to[axis] * slope) {}
  };
  const auto x = [&](Floats value, Floats slope) noexcept { return Between(value, slope, from, to, 0); };
  const Between x00 = x(n.v000, n.d00), x10 = x(n.v010, n.d10), x01 = x(n.v001, n.d01), x11 = x(n.v011, n.d11);
  const auto y = [&](Floats lower, Floats upper) noexcept { return Between(lower, upper - lower, from, to, 1); };
  const Between y00 = y(x00.at_from, x10.at_from), y10 = y(x00.at_to, x10.at_to);  // at the lower z; x 0, x 1
  const Between y01 = y(x01.at_from, x11.at_from), y11 = y(x01.at_to, x11.at_to);  // at the upper
  const auto z = [&](Floats lower, Floats upper) noexcept { return Between(lower, upper - lower, from, to, 2); };
  const Between z00 = z(y00.at_from, y01.at_from), z10 = z(y10.at_from, y11.at_from);
  const Between z01 = z(y00.at_to, y01.at_to), z11 = z(y10.at_to, y11.at_to);
  end = z11.at_to;
  const Floats second = kThird * (z10.at_from + z01.at_from + z00.at_to);
  const Floats third = kThird * (z11.at_from + z10.at_to + z01.at_to);
  return (z00.at_from > least) & (second > least) & (third > least) & (end > least);
}

/// The heights of both ends of a piece above the planes of one facet [m].
struct FacetHeights {
  double from[4], to[4];  ///< the face's plane, then those of its edges, see format::Facet::plane

  FacetHeights(const double (&plane)[4][4], const double (&from_m)[3], const double (&to_m)[3]) noexcept {
    for (int i = 0; i < 4; ++i) {
      from[i] = plane[0][i] * from_m[0] + plane[1][i] * from_m[1] + plane[2][i] * from_m[2] + plane[3][i];
      to[i] = plane[0][i] * to_m[0] + plane[1][i] * to_m[1] + plane[2][i] * to_m[2] + plane[3][i];
    }
  }

  static double smaller(double a, double b) noexcept { return a < b ? a : b; }
  static double larger(double a, double b) noexcept { return a > b ? a : b; }

  /// Returns a lower bound of the facet's distance from the whole piece, if a plane lies between them [m]; otherwise a
  /// number that is not positive.
  double least_distance() const noexcept {
    double least = larger(smaller(from[0], to[0]), -larger(from[0], to[0]));
    for (int i = 1; i < 4; ++i) least = larger(least, smaller(from[i], to[i]));
    return least;
  }

  /// Tells whether the begin is above the triangle; then its height above the face is its distance.
  bool above_triangle() const noexcept { return from[0] > 0.0 && from[1] <= 0.0 && from[2] <= 0.0 && from[3] <= 0.0; }

  /// Returns a lower bound of the facet's distance from one end, whose heights these are [m].
  static double least_of(const double (&heights)[4]) noexcept {
    double least = larger(heights[0], -heights[0]);
    for (int i = 1; i < 4; ++i) least = larger(least, heights[i]);
    return least;
  }
};

/// Lower bounds of the distance to facets along pieces of chords, each piece in a cell that has them [voxels].
///
/// Where the free space about the cell is convex, the distance is the least height above some planes. Each height
/// changes linearly along the piece. Elsewhere a facet is passed if one of its planes lies between it and the whole
/// piece. A piece that passes all facets of the set meets no surface, and stays on the side on which it begins. It
/// begins outside if its begin is above the triangle of the nearest facet. In a whole cell, where the field is the
/// distance to the facets alone, it also begins outside if the field is positive there.
template <class Vectors>
struct PiecesPastFacets {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;
  using Doubles = typename Vectors::Doubles;

  Floats least;  ///< along the piece; negative where nothing is proved
  Floats end;    ///< at the piece's end

  /// `from`, `to`: ends of the pieces, each component as its low and its high half [voxels from the grid's origin].
  /// `outside`: -1 where the field is positive at the begin of the piece.
  PiecesPastFacets(const FieldOfNodes& f, Ints facets, Ints outside, const Doubles (&from)[3][2],
                   const Doubles (&to)[3][2]) noexcept
      : least(Floats{} - 1.0f), end(least) {
    for (std::uint32_t left = Vectors::bits(facets != 0); left != 0; left &= left - 1) {
      const auto lane = static_cast<std::uint32_t>(__builtin_ctz(left));
      const auto word = static_cast<std::uint32_t>(facets[lane]);
      const format::FacetSet& set = f.facet_sets[(word & format::cell_facets::kSet) - 1];
      double from_m[3], to_m[3];
      for (int axis = 0; axis < 3; ++axis) {
        from_m[axis] = f.origin[axis] + of_lane(from[axis], lane) / f.per_voxel;
        to_m[axis] = f.origin[axis] + of_lane(to[axis], lane) / f.per_voxel;
      }
      Bounds found = above_planes(f, set, from_m, to_m);
      const bool is_whole = (word & format::cell_facets::kWhole) != 0;
      if (found.least < 0.0) found = past_each(f, set, is_whole && outside[lane] != 0, from_m, to_m);
      if (found.least < 0.0) continue;
      least[lane] = static_cast<float>((found.least + f.facet_offset) * f.per_voxel);
      end[lane] = static_cast<float>((found.end + f.facet_offset) * f.per_voxel);
    }
  }

 private:
  /// Lower bounds of the distance to the facets of a set [m]; `least` is negative where nothing is proved.
  struct Bounds {
    double least, end;
  };

  static Bounds above_planes(const FieldOfNodes& f, const format::FacetSet& set, const double (&from_m)[3],
                             const double (&to_m)[3]) noexcept {
    if (set.plane_count == 0) return {-1.0, -1.0};
    double least_from = f.band;
    double least_to = f.band;
    for (std::uint32_t i = set.first; i < set.first + set.plane_count; ++i) {
      const double(&plane)[4][4] = f.facets[f.facet_numbers[i]].plane;
      const auto height = [&plane](const double(&p)[3]) noexcept {
        return plane[0][0] * p[0] + plane[1][0] * p[1] + plane[2][0] * p[2] + plane[3][0];
      };
      least_from = FacetHeights::smaller(least_from, height(from_m));
      least_to = FacetHeights::smaller(least_to, height(to_m));
    }
    return {FacetHeights::smaller(least_from, least_to), least_to};
  }

  /// `outside`: the distance to the facets is known to be positive at the begin.
  static Bounds past_each(const FieldOfNodes& f, const format::FacetSet& set, bool outside, const double (&from_m)[3],
                          const double (&to_m)[3]) noexcept {
    // the field is positive where the distance is above -facet_offset; so is the distance if it is this far from 0
    const double apart = FacetHeights::larger(f.facet_offset, 0.0);
    Bounds bounds{f.band, f.band};
    // If the begin is above the triangle with the least of these bounds, that one is the nearest.
    double nearest = __builtin_inf();
    bool above_nearest = false;
    for (std::uint32_t i = set.first; i < set.first + set.count; ++i) {
      const FacetHeights heights(f.facets[f.facet_numbers[i]].plane, from_m, to_m);
      bounds.least = FacetHeights::smaller(bounds.least, heights.least_distance());
      if (bounds.least <= apart) return {-1.0, -1.0};
      bounds.end = FacetHeights::smaller(bounds.end, FacetHeights::least_of(heights.to));
      const double at_begin = FacetHeights::least_of(heights.from);
      if (at_begin >= nearest) continue;
      nearest = at_begin;
      above_nearest = heights.above_triangle();
    }
    return outside || above_nearest ? bounds : Bounds{-1.0, -1.0};
  }

  static double of_lane(const Doubles (&halves)[2], std::uint32_t lane) noexcept {
    constexpr std::uint32_t kHalf = Vectors::kLanes / 2;
    return halves[lane / kHalf][lane % kHalf];
  }
};

/// The chords of one vector of points, in voxels from the grid's origin.
template <class Vectors>
struct ChordLanes {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;
  using Doubles = typename Vectors::Doubles;
  static constexpr float kShortest = 1e-12f;  // least divisor, chosen far below all rounding [voxels]

  Doubles start[3][2];  ///< each component as its low and its high half
  Floats way[3];        ///< from start to end
  Floats length;
  Floats per_length;

  ChordLanes(const FieldOfNodes& f, const ChordEnds& ends, const SampleBatch& batch, std::uint32_t first) noexcept {
    const Floats px = *reinterpret_cast<const Floats*>(batch.x + first);
    const Floats py = *reinterpret_cast<const Floats*>(batch.y + first);
    const Floats pz = *reinterpret_cast<const Floats*>(batch.z + first);
    const Doubles low[3] = {Vectors::low(px), Vectors::low(py), Vectors::low(pz)};
    const Doubles high[3] = {Vectors::high(px), Vectors::high(py), Vectors::high(pz)};
    const auto mapped = [](const double(&m)[4], const Doubles(&p)[3]) noexcept {
      return m[0] * p[0] + (m[1] * p[1] + m[2] * p[2]) + m[3];
    };
    for (int axis = 0; axis < 3; ++axis) {
      start[axis][0] = (mapped(f.to_field[axis], low) - f.origin[axis]) * f.per_voxel;
      start[axis][1] = (mapped(f.to_field[axis], high) - f.origin[axis]) * f.per_voxel;
      way[axis] = Vectors::narrowed(mapped(ends.change[axis], low) * f.per_voxel,
                                    mapped(ends.change[axis], high) * f.per_voxel);
    }
    const Floats zero = {};
    length = Vectors::root(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    per_length = 1.0f / (length > kShortest ? length : zero + kShortest);
  }

  /// Sets `at` to the place after a share of the chord from another place.
  void place(const Doubles (&from)[3][2], Floats share, Doubles (&at)[3][2]) const noexcept {
    for (int axis = 0; axis < 3; ++axis) {
      const Floats done = share * way[axis];
      at[axis][0] = from[axis][0] + Vectors::low(done);
      at[axis][1] = from[axis][1] + Vectors::high(done);
    }
  }

  /// Returns the length from a place in a cell to its face, at most `most` [voxels]. Sets the chord's direction
  /// [cells per voxel].
  Floats step_to_face(const CellLanes<Vectors>& cell, Floats most, Floats (&direction)[3]) const noexcept {
    Floats step = most;
    for (int axis = 0; axis < 3; ++axis) {
      direction[axis] = way[axis] * per_length / cell.cell_edge;
      const Floats room = direction[axis] > 0.0f ? 1.0f - cell.at[axis] : cell.at[axis];
      const Floats speed = Vectors::larger(direction[axis], -direction[axis]);
      const Ints moves = speed > kShortest;
      const Floats to_face = room / (moves ? speed : Floats{} + 1.0f);
      step = moves ? Vectors::smaller(step, to_face) : step;
    }
    return step;
  }
};

/// FindFreeChords for one vector of points. A piece in a cell with facets is proved if the interpolated distance, where
/// it counts, and the distance to the facets are positive along it.
template <class Vectors>
std::uint32_t chord_lanes(const FieldOfNodes& f, const ChordEnds& ends, const SampleBatch& batch,
                          std::uint32_t first) noexcept {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;
  using Doubles = typename Vectors::Doubles;
  constexpr std::uint32_t kHalf = Vectors::kLanes / 2;
  constexpr int kCells = 4;           // most cells of a chord, chosen: a chord of a voxel crosses at most four
  constexpr float kRounding = 2e-5f;  // of distances and positions at a slope and a length of 1 [voxels]
  const Floats zero = {};

  const ChordLanes<Vectors> chord(f, ends, batch, first);
  const Floats rounding = kRounding * (1.0f + chord.length);
  // [voxels]
  const auto clearance = [&](const double* of) noexcept {
    const Floats found = Vectors::narrowed(*reinterpret_cast<const Doubles*>(of + first) * f.per_voxel,
                                           *reinterpret_cast<const Doubles*>(of + first + kHalf) * f.per_voxel);
    return Vectors::larger(found - rounding, zero);
  };
  const Floats length_to_cover = chord.length - clearance(batch.clearance);
  Floats covered = clearance(batch.from_clearance);
  Ints free = covered > length_to_cover;
  Ints searched = ~free;
  const Doubles none = {};
  // a free ball about the start; each later piece begins at the end of one that was proved
  const Ints outside = Vectors::mask(*reinterpret_cast<const Doubles*>(batch.from_clearance + first) > none,
                                     *reinterpret_cast<const Doubles*>(batch.from_clearance + first + kHalf) > none);
  const auto quantum = static_cast<float>(f.quantum_per_voxel);
  const auto near_band = static_cast<float>(f.near_band * f.per_voxel);
  for (int cells = 0; cells < kCells && Vectors::bits(searched) != 0; ++cells) {
    const Floats share = Vectors::smaller(covered * chord.per_length, zero + 1.0f);  // also where the chord is done
    Doubles from[3][2];
    chord.place(chord.start, share, from);
    const auto axis_at = [&](int axis) noexcept {
      return CellAxis<Vectors>(from[axis][0], from[axis][1], f.cells[axis]);
    };
    const CellLanes<Vectors> cell(f, axis_at(0), axis_at(1), axis_at(2));
    searched &= cell.stored;
    const Floats left = Vectors::larger(length_to_cover - covered, zero);  // also where the chord is done
    Floats direction[3];
    const Floats step = chord.step_to_face(cell, left, direction);
    const Floats to[3] = {cell.at[0] + step * direction[0], cell.at[1] + step * direction[1],
                          cell.at[2] + step * direction[2]};
    const Floats unit = quantum * cell.cell_edge;  // [voxels]
    const Floats lipschitz = cell.lipschitz(f);
    const Floats least = rounding * lipschitz;  // [voxels]
    Floats end;
    const Ints above = stays_above<Vectors>(NodeLanes<Vectors>(f.bricks, cell.node), cell.at, to, least / unit, end);
    Floats distance = unit * end;
    const Ints facets = cell.facets & searched;
    if (Vectors::bits(facets != 0) == 0) {
      searched &= above;
    } else {
      Doubles until[3][2];
      chord.place(from, step * chord.per_length, until);
      const PiecesPastFacets<Vectors> past(f, facets, outside, from, until);
      const Ints whole = facets < 0;  // the sign is format::cell_facets::kWhole
      searched &= (above | whole) & ((facets == 0) | (past.least > least));
      distance = facets != 0 ? (whole ? past.end : Vectors::smaller(distance, past.end)) : distance;
    }
    // and the free ball at the end of the step
    const Floats ball = (distance < near_band ? distance : zero + near_band) / lipschitz - rounding;
    covered += step + (ball > 0.0f ? ball : zero);
    const Ints done = searched & (covered >= length_to_cover);
    free |= done;
    searched &= ~done;
  }
  return Vectors::bits(free);
}

}  // namespace
}  // namespace godobject::detail
