#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/scene/format.h"

/// The inner loop of Voxelmap::clearances, once for each kind of vectors; with nothing that other sources share, so
/// that what is compiled for wider ones cannot be linked into the rest.
namespace godobject::detail {

inline constexpr int kBrickWords = sizeof(format::Brick) / sizeof(std::int16_t);
inline constexpr int kLipschitzAt = offsetof(format::Brick, lipschitz) / sizeof(std::int16_t);
static_assert(offsetof(format::Brick, deviation) == offsetof(format::Brick, lipschitz) + sizeof(std::int16_t));
inline constexpr int kRefinedWords = sizeof(format::Refined) / sizeof(std::uint32_t);
static_assert(offsetof(format::Refined, brick) == 0);
inline constexpr int kBrickShift = std::countr_zero(static_cast<unsigned>(format::kBrickCells));
static_assert(1 << kBrickShift == format::kBrickCells);

/// A voxelmap as the kernel reads it. Cells are those of its grid, from its origin.
struct FieldOfCells {
  const std::uint32_t* index;
  const std::int16_t* bricks;
  const std::uint32_t* refined;          ///< at least one word
  std::int32_t stride_y, stride_z;       ///< of the index
  float to_cells[3][4];                  ///< from the points' frame; the last column is the translation
  float cells[3];                        ///< of the grid
  float surface_min[3], surface_max[3];  ///< [cells]
  float cell_edge;                       ///< [m]
  float quantum;                         ///< of the nodes [m]
  float near_band, assured;              ///< [m]
  float outside_off;                     ///< of the distance to the surface's box, as clearance [cells]
  float offset;                          ///< sum of |translation| [cells]
};

inline constexpr float kBrickCenter = 0.5f * format::kBrickCells;  ///< [cells]
/// Of a distance in single precision.
inline constexpr float kWayRoundedUp = 1.0f + 1e-6f;
/// A transformed point is a sum of four rounded products of rounded factors: this much of them all, with room to spare.
inline constexpr float kPointRounding = 1e-6f;

/// Clearances of `count` points. A kernel of several lanes takes a multiple of them, in arrays aligned to its vectors.
using LookUpClearances = void(const FieldOfCells& field, const float* x, const float* y, const float* z,
                              float* clearance, std::uint32_t count) noexcept;

struct ClearanceKernel {
  const char* name;
  std::uint32_t lanes;  ///< a divisor of PointBatch::kCapacity
  LookUpClearances* look_up;
};

/// Those that this processor can run, the widest first.
std::span<const ClearanceKernel> clearance_kernels() noexcept;

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
