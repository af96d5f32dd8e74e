#include <algorithm>
#include <cmath>

#include "core/scene/clearance_kernel.h"
#include "core/scene/voxelmap.h"

namespace godobject {
namespace {

/// The widest first, the scalar one last.
constexpr detail::ClearanceKernel kKernels[] = {
#if defined(__x86_64__)
    {"AVX-512", 16, &detail::look_up_clearances_avx512},
    {"AVX2", 8, &detail::look_up_clearances_avx2},
#elif defined(__aarch64__)
    {"NEON", 4, &detail::look_up_clearances_neon},
#endif
    {"scalar", 1, &detail::look_up_clearances},
};

/// Returns how many of the kernels are too wide for this processor.
std::size_t too_wide() noexcept {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return 0;
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? 1 : 2;
#else
  return 0;
#endif
}

/// The widest kernel of this processor, chosen when the program is loaded.
const detail::ClearanceKernel kKernel = kKernels[too_wide()];

constexpr std::uint32_t kNoRefinement = 0;
constexpr float kRoundedUp = 1.0f + 1e-6f;  // derived: more than the rounding to single precision, 6e-8

}  // namespace

std::span<const detail::ClearanceKernel> detail::clearance_kernels() noexcept {
  return std::span(kKernels).subspan(too_wide());
}

detail::FieldOfCells Voxelmap::in_cells(const Pose& H) const noexcept {
  detail::FieldOfCells f{};
  f.index = index_;
  f.bricks = bricks_[0].value;
  f.refined = refined_ != nullptr ? &refined_[0].brick : &kNoRefinement;
  f.stride_y = static_cast<std::int32_t>(stride_y_);
  f.stride_z = static_cast<std::int32_t>(stride_z_);
  const Matrix3 R = per_voxel_ * H.rotation.toRotationMatrix();
  const Vector3 t = per_voxel_ * (H.translation - origin_);
  for (int axis = 0; axis < 3; ++axis) {
    for (int column = 0; column < 3; ++column) f.to_cells[axis][column] = static_cast<float>(R(axis, column));
    f.to_cells[axis][3] = static_cast<float>(t[axis]);
    f.cells[axis] = static_cast<float>(cells_[axis]);
    f.surface_min[axis] = static_cast<float>(per_voxel_ * (surface_min_[axis] - origin_[axis]));
    f.surface_max[axis] = static_cast<float>(per_voxel_ * (surface_max_[axis] - origin_[axis]));
  }
  f.offset = static_cast<float>(t.cwiseAbs().sum());
  f.cell_edge = static_cast<float>(voxel_size_);
  f.quantum = static_cast<float>(quantum_);
  f.near_band = static_cast<float>(near_band_);
  f.assured = static_cast<float>(assured_clearance_);
  f.outside_off = kRoundedUp * static_cast<float>(per_voxel_ * outside_off_);
  return f;
}

void Voxelmap::clearances(const Pose& H, PointBatch& batch) const noexcept {
  if (!in_batches_) return sample_clearances(*this, H, batch);
  const std::uint32_t count = (batch.count + kKernel.lanes - 1) / kKernel.lanes * kKernel.lanes;
  for (std::uint32_t i = batch.count; i < count; ++i) batch.x[i] = batch.y[i] = batch.z[i] = 0.0f;
  kKernel.look_up(in_cells(H), batch.x, batch.y, batch.z, batch.clearance, count);
}

}  // namespace godobject
