#pragma once

#include <cstdint>
#include <span>

#include "core/scene/sample_batch.h"

/// The inner loops of Voxelmap::samples and Voxelmap::free_chords, once for each kind of vectors; with nothing that
/// other sources share, as clearance_kernel.h.
namespace godobject::detail {

/// A voxelmap as the kernel reads it.
struct FieldOfNodes {
  const std::uint32_t* index;
  const std::int16_t* bricks;
  const std::uint32_t* refined;     ///< at least one word
  std::int32_t stride_y, stride_z;  ///< of the index
  double to_field[3][4];            ///< from the points' frame; the last column is the translation [m]
  double origin[3];                 ///< of the grid [m]
  double cells[3];                  ///< of the grid
  double per_voxel;                 ///< [1/m]
  double quantum;                   ///< of the nodes [m]
  double quantum_per_voxel;         ///< [1]
  double band, near_band;           ///< [m]
};

/// Looks up points `first` to `first + lanes` of a batch, as Voxelmap::sample does it, to the last bit. Gives those
/// that it left out, a bit a lane: outside the grid, where nothing is stored, and in bricks with an edge; of them only
/// the position in the field's frame is found.
using LookUpSamples = std::uint32_t(const FieldOfNodes& field, SampleBatch& batch, std::uint32_t first) noexcept;

/// From where points are (FieldOfNodes::to_field) to where their chords end.
struct ChordEnds {
  double change[3][4];  ///< the change of to_field; the last column [m]
};

/// Of points `first` to `first + lanes` of a batch that was looked up where their chords end, a bit a lane: those whose
/// chord is free, see DistanceField::free_chords. Chords are gone through cell by cell.
using FindFreeChords = std::uint32_t(const FieldOfNodes& field, const ChordEnds& ends, const SampleBatch& batch,
                                     std::uint32_t first) noexcept;

struct SampleKernel {
  const char* name;
  std::uint32_t lanes;  ///< a divisor of SampleBatch::kCapacity
  LookUpSamples* look_up;
  FindFreeChords* free_chords;
};

/// Those that this processor can run, the widest first; none where no vectors are known.
std::span<const SampleKernel> sample_kernels() noexcept;

#if defined(__x86_64__)
/// Eight lanes; needs AVX2.
std::uint32_t look_up_samples_avx2(const FieldOfNodes& field, SampleBatch& batch, std::uint32_t first) noexcept;
FindFreeChords free_chords_avx2;
/// Sixteen lanes; needs AVX-512 F and DQ.
std::uint32_t look_up_samples_avx512(const FieldOfNodes& field, SampleBatch& batch, std::uint32_t first) noexcept;
FindFreeChords free_chords_avx512;
#elif defined(__aarch64__)
/// Four lanes.
std::uint32_t look_up_samples_neon(const FieldOfNodes& field, SampleBatch& batch, std::uint32_t first) noexcept;
FindFreeChords free_chords_neon;
#endif

}  // namespace godobject::detail
