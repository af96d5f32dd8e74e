#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/scene/format.h"

/// The kernels of Voxelmap::clearances, one for each vector type. The header includes nothing that other sources share,
/// so that the linker cannot use code for wider vectors elsewhere.
namespace godobject::detail {

inline constexpr int kBrickWords = sizeof(format::Brick) / sizeof(std::int16_t);
inline constexpr int kLipschitzAt = offsetof(format::Brick, lipschitz) / sizeof(std::int16_t);
static_assert(offsetof(format::Brick, deviation) == offsetof(format::Brick, lipschitz) + sizeof(std::int16_t));
inline constexpr int kRefinedWords = sizeof(format::Refined) / sizeof(std::uint32_t);
static_assert(offsetof(format::Refined, brick) == 0);
inline constexpr int kBrickShift = std::countr_zero(static_cast<unsigned>(format::kBrickCells));
static_assert(1 << kBrickShift == format::kBrickCells);

/// The parts of a voxelmap that a kernel reads. Positions in cells are relative to the grid's origin.
struct FieldOfCells {
  const std::uint32_t* index;            ///< brick index
  const std::int16_t* bricks;            ///< format::Brick[] as words
  const std::uint32_t* refined;          ///< format::Refined[] as words, at least one
  std::int32_t stride_y, stride_z;       ///< of the index
  float to_cells[3][4];                  ///< from the points' frame [m] to cells; the last column is the translation
  float cells[3];                        ///< number of cells of the grid
  float surface_min[3], surface_max[3];  ///< [cells]
  float cell_edge;                       ///< [m]
  float quantum;                         ///< unit of the nodes [m]
  float near_band, assured;              ///< [m]
  float outside_off;                     ///< distance to the surface's box minus clearance [cells]
  float offset;                          ///< sum of |translation| [cells]
};

inline constexpr float kBrickCenter = 0.5f * format::kBrickCells;  ///< [cells]
/// Factor against the rounding of a length in single precision. Derived: some roundings of 6e-8 each.
inline constexpr float kLengthRoundedUp = 1.0f + 1e-6f;
/// Rounding of a transformed point over the sum of its terms. Derived: four rounded products of rounded factors and
/// their sum, at most nine roundings of 6e-8, and room to spare.
inline constexpr float kPointRounding = 1e-6f;

/// Looks up the clearances [m] of `count` points, a multiple of the kernel's lanes, as Voxelmap::clearances. x, y, z:
/// in the points' frame [m]; arrays aligned to the kernel's vectors. Real-time safe.
using LookUpClearances = void(const FieldOfCells& field, const float* x, const float* y, const float* z,
                              float* clearance, std::uint32_t count) noexcept;

/// A kernel for one vector type.
struct ClearanceKernel {
  const char* name;     ///< of the vectors
  std::uint32_t lanes;  ///< a divisor of PointBatch::kCapacity
  LookUpClearances* look_up;
};

/// Returns the kernels that this processor can run, the widest first, the scalar one last.
std::span<const ClearanceKernel> clearance_kernels() noexcept;

/// Scalar; any processor.
void look_up_clearances(const FieldOfCells& field, const float* x, const float* y, const float* z, float* clearance,
                        std::uint32_t count) noexcept;

#if defined(__x86_64__)
/// Eight lanes; needs AVX2 and FMA.
void look_up_clearances_avx2(const FieldOfCells& field, const float* x, const float* y, const float* z,
                             float* clearance, std::uint32_t count) noexcept;
/// Sixteen lanes; needs AVX-512 F and DQ.
void look_up_clearances_avx512(const FieldOfCells& field, const float* x, const float* y, const float* z,
                               float* clearance, std::uint32_t count) noexcept;
#elif defined(__aarch64__)
/// Four lanes.
void look_up_clearances_neon(const FieldOfCells& field, const float* x, const float* y, const float* z,
                             float* clearance, std::uint32_t count) noexcept;
#endif

}  // namespace godobject::detail
