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

/// FindFreeChords for one vector of points.
template <class Vectors>
std::uint32_t chord_lanes(const FieldOfNodes& f, const ChordEnds& ends, const SampleBatch& batch,
                          std::uint32_t first) noexcept {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;
  using Doubles = typename Vectors::Doubles;
  constexpr std::uint32_t kHalf = Vectors::kLanes / 2;
  constexpr int kCells = 4;            // most cells of a chord, chosen: a chord of a voxel crosses at most four
  constexpr float kRounding = 2e-5f;   // of distances and positions at a slope and a length of 1 [voxels]
  constexpr float kShortest = 1e-12f;  // least divisor, chosen far below kRounding [voxels]
  const Floats zero = {};

  const Floats px = *reinterpret_cast<const Floats*>(batch.x + first);
  const Floats py = *reinterpret_cast<const Floats*>(batch.y + first);
  const Floats pz = *reinterpret_cast<const Floats*>(batch.z + first);
  const Doubles low_p[3] = {Vectors::low(px), Vectors::low(py), Vectors::low(pz)};
  const Doubles high_p[3] = {Vectors::high(px), Vectors::high(py), Vectors::high(pz)};
  const auto mapped = [](const double(&m)[4], const Doubles(&p)[3]) noexcept {
    return m[0] * p[0] + (m[1] * p[1] + m[2] * p[2]) + m[3];
  };
  Doubles low[3], high[3];  // start of the chord
  Floats chord[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = (mapped(f.to_field[axis], low_p) - f.origin[axis]) * f.per_voxel;
    high[axis] = (mapped(f.to_field[axis], high_p) - f.origin[axis]) * f.per_voxel;
    chord[axis] = Vectors::narrowed(mapped(ends.change[axis], low_p) * f.per_voxel,
                                    mapped(ends.change[axis], high_p) * f.per_voxel);
  }
  const Floats length = Vectors::root(chord[0] * chord[0] + chord[1] * chord[1] + chord[2] * chord[2]);
  const Floats per_length = 1.0f / (length > kShortest ? length : zero + kShortest);
  const Floats rounding = kRounding * (1.0f + length);
  // [voxels]
  const auto clearance = [&](const double* of) noexcept {
    const Floats found = Vectors::narrowed(*reinterpret_cast<const Doubles*>(of + first) * f.per_voxel,
                                           *reinterpret_cast<const Doubles*>(of + first + kHalf) * f.per_voxel);
    return Vectors::larger(found - rounding, zero);
  };
  const Floats length_to_cover = length - clearance(batch.clearance);
  Floats covered = clearance(batch.from_clearance);
  Ints free = covered > length_to_cover;
  Ints searched = ~free;
  const auto quantum = static_cast<float>(f.quantum_per_voxel);
  const auto near_band = static_cast<float>(f.near_band * f.per_voxel);
  for (int cells = 0; cells < kCells && Vectors::bits(searched) != 0; ++cells) {
    const Floats share = Vectors::smaller(covered * per_length, zero + 1.0f);  // also where the chord is done
    const auto axis_at = [&](int axis) noexcept {
      const Floats done = share * chord[axis];
      return CellAxis<Vectors>(low[axis] + Vectors::low(done), high[axis] + Vectors::high(done), f.cells[axis]);
    };
    const CellLanes<Vectors> cell(f, axis_at(0), axis_at(1), axis_at(2));
    searched &= cell.stored;
    // to the face of the cell
    Floats step = Vectors::larger(length_to_cover - covered, zero);  // also where the chord is done
    Floats direction[3];
    for (int axis = 0; axis < 3; ++axis) {
      direction[axis] = chord[axis] * per_length / cell.cell_edge;
      const Floats room = direction[axis] > 0.0f ? 1.0f - cell.at[axis] : cell.at[axis];
      const Floats speed = Vectors::larger(direction[axis], -direction[axis]);
      const Ints moves = speed > kShortest;
      const Floats to_face = room / (moves ? speed : zero + 1.0f);
      step = moves ? Vectors::smaller(step, to_face) : step;
    }
    const Floats to[3] = {cell.at[0] + step * direction[0], cell.at[1] + step * direction[1],
                          cell.at[2] + step * direction[2]};
    const Floats unit = quantum * cell.cell_edge;  // [voxels]
    const Floats lipschitz = cell.lipschitz(f);
    Floats end;
    searched &= stays_above<Vectors>(NodeLanes<Vectors>(f, cell), cell.at, to, rounding * lipschitz / unit, end);
    // and the free ball at the end of the step
    const Floats distance = unit * end;
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
