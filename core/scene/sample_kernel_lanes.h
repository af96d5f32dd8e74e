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

/// Stores half of the results in double precision, as Voxelmap::sample computes them. Those of `open` lanes (-1) are
/// not bounded.
template <class Vectors>
[[gnu::always_inline]] inline typename Vectors::Longs store_samples(const FieldOfNodes& f,
                                                                    typename Vectors::Doubles distance,
                                                                    typename Vectors::Doubles lipschitz,
                                                                    const typename Vectors::Doubles (&slope)[3],
                                                                    typename Vectors::Longs open, SampleBatch& batch,
                                                                    std::uint32_t first) noexcept {
  using Doubles = typename Vectors::Doubles;
  using Longs = typename Vectors::Longs;
  const Doubles zero = {};
  const Longs known = (distance < f.band) & (-distance < f.band);
  const Longs kept = known | open;
  const Doubles nearest = f.near_band < distance ? zero + f.near_band : distance;
  *reinterpret_cast<Doubles*>(batch.clearance + first) = distance > 0.0 ? nearest / lipschitz : zero;
  *reinterpret_cast<Doubles*>(batch.distance + first) =
      kept ? distance : (distance < 0.0 ? zero - f.band : zero + f.band);
  *reinterpret_cast<Doubles*>(batch.gradient_x + first) = kept ? f.quantum_per_voxel * slope[0] : zero;
  *reinterpret_cast<Doubles*>(batch.gradient_y + first) = kept ? f.quantum_per_voxel * slope[1] : zero;
  *reinterpret_cast<Doubles*>(batch.gradient_z + first) = kept ? f.quantum_per_voxel * slope[2] : zero;
  return known;
}

/// Sets what is blended with the distance to facets. One of the cells has facets.
template <class Vectors>
void store_facets(const FieldOfNodes& f, const CellLanes<Vectors>& cell, typename Vectors::Floats lipschitz,
                  LanesWithFacets& with_facets) noexcept {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;
  constexpr int kExact = sizeof(format::ExactBrick) / sizeof(std::int16_t);
  constexpr int kWeight = offsetof(format::ExactBrick, weight) / sizeof(std::int16_t);
  *reinterpret_cast<Ints*>(with_facets.word) = cell.facets;
  *reinterpret_cast<Floats*>(with_facets.cell_edge) = cell.cell_edge;
  *reinterpret_cast<Floats*>(with_facets.lipschitz) = lipschitz;
  // the sign is format::cell_facets::kWhole
  if (Vectors::bits(cell.facets > 0) == 0) return;
  const Ints of_weight = (kExact * cell.exact_brick(f) + cell.node - cell.brick) & (cell.facets > 0);
  const NodeLanes<Vectors> nodes(reinterpret_cast<const std::int16_t*>(f.exact) + kWeight, of_weight);
  const TrilinearLanes<Vectors> weight(nodes, cell.at);
  *reinterpret_cast<Floats*>(with_facets.weight) = weight.value;
  for (int axis = 0; axis < 3; ++axis) {
    *reinterpret_cast<Floats*>(with_facets.weight_gradient[axis]) = weight.gradient[axis];
  }
}

template <class Vectors>
std::uint32_t sample_lanes(const FieldOfNodes& f, SampleBatch& batch, std::uint32_t first,
                           LanesWithFacets& with_facets) noexcept {
  using Floats = typename Vectors::Floats;
  using Ints = typename Vectors::Ints;
  using Doubles = typename Vectors::Doubles;

  const Floats px = *reinterpret_cast<const Floats*>(batch.x + first);
  const Floats py = *reinterpret_cast<const Floats*>(batch.y + first);
  const Floats pz = *reinterpret_cast<const Floats*>(batch.z + first);
  const CellLanes<Vectors> cell(f, store_position<Vectors>(f, 0, px, py, pz, batch.field_x + first),
                                store_position<Vectors>(f, 1, px, py, pz, batch.field_y + first),
                                store_position<Vectors>(f, 2, px, py, pz, batch.field_z + first));
  const TrilinearLanes<Vectors> field(NodeLanes<Vectors>(f.bricks, cell.node), cell.at);
  const Floats lipschitz = cell.lipschitz(f);
  const Ints open = cell.facets != 0;
  with_facets.bits = Vectors::bits(open);
  if (with_facets.bits != 0) store_facets(f, cell, lipschitz, with_facets);

  constexpr std::uint32_t kHalf = Vectors::kLanes / 2;
  const auto& [gx, gy, gz] = field.gradient;
  const Doubles low_slope[3] = {Vectors::low(gx), Vectors::low(gy), Vectors::low(gz)};
  const Doubles high_slope[3] = {Vectors::high(gx), Vectors::high(gy), Vectors::high(gz)};
  const Doubles low_unit = f.quantum * Vectors::low(cell.cell_edge);
  const Doubles high_unit = f.quantum * Vectors::high(cell.cell_edge);
  const Ints known =
      Vectors::mask(store_samples<Vectors>(f, low_unit * Vectors::low(field.value), Vectors::low(lipschitz), low_slope,
                                           Vectors::low_mask(open), batch, first),
                    store_samples<Vectors>(f, high_unit * Vectors::high(field.value), Vectors::high(lipschitz),
                                           high_slope, Vectors::high_mask(open), batch, first + kHalf));
  constexpr std::uint64_t kLanes = (std::uint64_t{1} << Vectors::kLanes) - 1;
  const auto bits = static_cast<std::uint64_t>(Vectors::bits(known & cell.stored & ~open));
  batch.known = (batch.known & ~(kLanes << first)) | bits << first;
  return Vectors::bits(~cell.stored);
}

}  // namespace
}  // namespace godobject::detail
