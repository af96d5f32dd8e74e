#pragma once

#include <cstdint>
#include <span>

#include "core/scene/sample_batch.h"

/// The kernels of Voxelmap::samples and Voxelmap::free_chords, one for each vector type. The header includes nothing
/// that other sources share, for the reason in clearance_kernel.h.
namespace godobject::format {

struct Facet;
struct FacetSet;

}  // namespace godobject::format

namespace godobject::detail {

/// The parts of a voxelmap that a kernel reads.
struct FieldOfNodes {
  const std::uint32_t* index;
  const std::int16_t* bricks;
  const std::uint32_t* refined;  ///< at least one word
  const std::uint32_t* exact;    ///< words of the exact bricks, if a brick is exact
  const format::Facet* facets;   ///< those of exact bricks, with their sets
  const format::FacetSet* facet_sets;
  const std::uint32_t* facet_numbers;
  double facet_offset;              ///< see format::Grid [m]
  std::int32_t stride_y, stride_z;  ///< of the index
  double to_field[3][4];            ///< from the points' frame; the last column is the translation [m]
  double origin[3];                 ///< of the grid [m]
  double cells[3];                  ///< of the grid
  double per_voxel;                 ///< [1/m]
  double quantum;                   ///< of the nodes [m]
  double quantum_per_voxel;         ///< [1]
  double band, near_band;           ///< [m]
};

/// Lanes whose cells have facets. A kernel leaves them to be blended with the distance to the facets: the batch holds
/// their interpolated distances and gradients, neither bounded by the band nor marked as known.
struct LanesWithFacets {
  static constexpr std::uint32_t kMost = 16;
  std::uint32_t bits;                           ///< one for each lane; the rest is set only if there is one
  alignas(64) std::uint32_t word[kMost];        ///< of their cells: see format::cell_facets
  alignas(64) float cell_edge[kMost];           ///< [voxels]
  alignas(64) float lipschitz[kMost];           ///< of their bricks
  alignas(64) float weight[kMost];              ///< interpolated, in units of 1 / format::kOneWeight
  alignas(64) float weight_gradient[3][kMost];  ///< per edge of the cell, in the same units
};

/// Looks up points `first` to `first + lanes` of a batch; the results equal those of Voxelmap::sample to the last bit.
/// Returns a bit mask of the lanes that it left out: points outside the grid, and points where nothing is stored. These
/// get only their position in the field's frame.
using LookUpSamples = std::uint32_t(const FieldOfNodes& field, SampleBatch& batch, std::uint32_t first,
                                    LanesWithFacets& with_facets) noexcept;

/// The change from the pose at which points are looked up (FieldOfNodes::to_field) to the pose at the end of their
/// chords.
struct ChordEnds {
  double change[3][4];  ///< change of to_field; the last column is the translation [m]
};

/// Returns a bit mask of the lanes, points `first` to `first + lanes` of a batch, whose chord is proved free cell by
/// cell, see DistanceField::free_chords. The batch was looked up at the end of the chords.
using FindFreeChords = std::uint32_t(const FieldOfNodes& field, const ChordEnds& ends, const SampleBatch& batch,
                                     std::uint32_t first) noexcept;

struct SampleKernel {
  const char* name;
  std::uint32_t lanes;  ///< a divisor of SampleBatch::kCapacity
  LookUpSamples* look_up;
  FindFreeChords* free_chords;
};

/// Returns the kernels that this processor can run, the widest first; none if it has no known vectors.
std::span<const SampleKernel> sample_kernels() noexcept;

#if defined(__x86_64__)
/// Eight lanes; needs AVX2.
LookUpSamples look_up_samples_avx2;
FindFreeChords free_chords_avx2;
/// Sixteen lanes; needs AVX-512 F and DQ.
LookUpSamples look_up_samples_avx512;
FindFreeChords free_chords_avx512;
#elif defined(__aarch64__)
/// Four lanes.
LookUpSamples look_up_samples_neon;
FindFreeChords free_chords_neon;
#endif

}  // namespace godobject::detail
