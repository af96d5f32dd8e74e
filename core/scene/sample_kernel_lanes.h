#pragma once

#include <cstdint>

#include "core/scene/cell_lanes.h"
#include "core/scene/sample_kernel.h"

/// Included once by a source for each kind of vectors, as clearance_kernel_lanes.h.
namespace godobject::detail {
namespace {

/// Stores one component of the positions in the field's frame at `position` and gives it in voxels.
template <class Vectors>
[[gnu::always_inline]] inline CellAxis<Vectors> store_position(const FieldOfNodes& f, int axis,
                                                               typename Vectors::Floats x, typename Vectors::Floats y,
                                                               typename Vectors::Floats z, double* position) noexcept {
  using Doubles = typename Vectors::Doubles;
  constexpr std::uint32_t kHalf = Vectors::kLanes / 2;
  const double(&m)[4] = f.to_field[axis];
  const Doubles low = m[0] * Vectors::low(x) + (m[1] * Vectors::low(y) + m[2] * Vectors::low(z)) + m[3];
  const Doubles high = m[0] * Vectors::high(x) + (m[1] * Vectors::high(y) + m[2] * Vectors::high(z)) + m[3];
  *reinterpret_cast<Doubles*>(position) = low;
  *reinterpret_cast<Doubles*>(position + kHalf) = high;
  return {(low - f.origin[axis]) * f.per_voxel, (high - f.origin[axis]) * f.per_voxel, f.cells[axis]};
}

/// Stores half of the results in double precision, as Voxelmap::sample computes them.
template <class Vectors>
[[gnu::always_inline]] inline typename Vectors::Longs store_samples(const FieldOfNodes& f,
                                                                    typename Vectors::Doubles distance,
                                                                    typename Vectors::Doubles lipschitz,
                                                                    const typename Vectors::Doubles (&slope)[3],
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

  const Floats px = *reinterpret_cast<const Floats*>(batch.x + first);
  const Floats py = *reinterpret_cast<const Floats*>(batch.y + first);
  const Floats pz = *reinterpret_cast<const Floats*>(batch.z + first);
  const CellLanes<Vectors> cell(f, store_position<Vectors>(f, 0, px, py, pz, batch.field_x + first),
                                store_position<Vectors>(f, 1, px, py, pz, batch.field_y + first),
                                store_position<Vectors>(f, 2, px, py, pz, batch.field_z + first));
  const auto& [fx, fy, fz] = cell.at;
  const NodeLanes<Vectors> n(f, cell);
  const Floats x00 = n.v000 + fx * n.d00;
  const Floats x10 = n.v010 + fx * n.d10;
  const Floats x01 = n.v001 + fx * n.d01;
  const Floats x11 = n.v011 + fx * n.d11;
  const Floats y0 = x00 + fy * (x10 - x00);
  const Floats y1 = x01 + fy * (x11 - x01);
  const Floats distance = y0 + fz * (y1 - y0);
  const Floats d0 = n.d00 + fy * (n.d10 - n.d00);
  const Floats d1 = n.d01 + fy * (n.d11 - n.d01);
  const Floats gx = d0 + fz * (d1 - d0);
  const Floats gy = (x10 - x00) + fz * ((x11 - x01) - (x10 - x00));
  const Floats gz = y1 - y0;
  const Floats lipschitz = cell.lipschitz(f);

  constexpr std::uint32_t kHalf = Vectors::kLanes / 2;
  const Doubles low_slope[3] = {Vectors::low(gx), Vectors::low(gy), Vectors::low(gz)};
  const Doubles high_slope[3] = {Vectors::high(gx), Vectors::high(gy), Vectors::high(gz)};
  const Doubles low_unit = f.quantum * Vectors::low(cell.cell_edge);
  const Doubles high_unit = f.quantum * Vectors::high(cell.cell_edge);
  const Ints known = Vectors::mask(
      store_samples<Vectors>(f, low_unit * Vectors::low(distance), Vectors::low(lipschitz), low_slope, batch, first),
      store_samples<Vectors>(f, high_unit * Vectors::high(distance), Vectors::high(lipschitz), high_slope, batch,
                             first + kHalf));
  constexpr std::uint64_t kLanes = (std::uint64_t{1} << Vectors::kLanes) - 1;
  const auto bits = static_cast<std::uint64_t>(Vectors::bits(known & cell.stored));
  batch.known = (batch.known & ~(kLanes << first)) | bits << first;
  return Vectors::bits(~cell.stored);
}

}  // namespace
}  // namespace godobject::detail
