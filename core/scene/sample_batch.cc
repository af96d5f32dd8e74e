#include <bit>

#include "core/scene/sample_kernel.h"
#include "core/scene/voxelmap.h"

namespace godobject {
namespace {

/// The widest first.
constexpr detail::SampleKernel kSampleKernels[] = {
#if defined(__x86_64__)
    {"AVX-512", 16, &detail::look_up_samples_avx512, &detail::free_chords_avx512},
    {"AVX2", 8, &detail::look_up_samples_avx2, &detail::free_chords_avx2},
#elif defined(__aarch64__)
    {"NEON", 4, &detail::look_up_samples_neon, &detail::free_chords_neon},
#endif
};

/// Chosen when the program is loaded; null: none.
const detail::SampleKernel* const kSampleKernel =
    detail::sample_kernels().empty() ? nullptr : &detail::sample_kernels().front();

constexpr double kEverywhere = 1e9;  // [m]

}  // namespace

std::span<const detail::SampleKernel> detail::sample_kernels() noexcept {
  // the clearances' kernels are these and the scalar one
  const std::size_t usable = clearance_kernels().size() - 1;
  return std::span(kSampleKernels).last(usable);
}

detail::FieldOfNodes Voxelmap::in_nodes(const Pose& H) const noexcept {
  static constexpr std::uint32_t kNoRefinement = 0;
  detail::FieldOfNodes f{};
  f.index = index_;
  f.bricks = bricks_[0].value;
  f.refined = refined_ != nullptr ? &refined_[0].brick : &kNoRefinement;
  f.exact = reinterpret_cast<const std::uint32_t*>(exact_);
  f.facets = facets_.facets.data();
  f.facet_sets = facets_.sets.data();
  f.facet_numbers = facets_.numbers.data();
  f.facet_offset = facet_offset_;
  f.stride_y = static_cast<std::int32_t>(stride_y_);
  f.stride_z = static_cast<std::int32_t>(stride_z_);
  const Matrix3 R = H.rotation.toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis) {
    for (int column = 0; column < 3; ++column) f.to_field[axis][column] = R(axis, column);
    f.to_field[axis][3] = H.translation[axis];
    f.origin[axis] = origin_[axis];
    f.cells[axis] = cells_[axis];
  }
  f.per_voxel = per_voxel_;
  f.quantum = quantum_;
  f.quantum_per_voxel = quantum_per_voxel_;
  f.band = band_;
  f.near_band = near_band_;
  return f;
}

void Voxelmap::samples_by(const detail::SampleKernel* kernel, const Pose& H, SampleBatch& batch) const noexcept {
  if (kernel == nullptr || !in_batches_) return sample_each(*this, H, batch);
  const detail::FieldOfNodes f = in_nodes(H);
  const std::uint32_t lanes = (batch.count + kernel->lanes - 1) / kernel->lanes * kernel->lanes;
  for (std::uint32_t i = batch.count; i < lanes; ++i) batch.x[i] = batch.y[i] = batch.z[i] = 0.0f;
  for (std::uint32_t first = 0; first < batch.count; first += kernel->lanes) {
    detail::LanesWithFacets with_facets;
    for (std::uint32_t left = kernel->look_up(f, batch, first, with_facets); left != 0; left &= left - 1) {
      const std::uint32_t i = first + static_cast<std::uint32_t>(std::countr_zero(left));
      if (i >= batch.count) break;
      const Vector3 p_field = stored_position(batch, i);
      store_sample(p_field, sample(p_field), batch, i);
    }
    blend_lanes(with_facets, batch, first);
  }
}

void Voxelmap::samples(const Pose& H, SampleBatch& batch) const noexcept { samples_by(kSampleKernel, H, batch); }

std::uint64_t Voxelmap::free_chords_by(const detail::SampleKernel* kernel, const Pose& H0, const Pose& H1,
                                       SampleBatch& batch) const noexcept {
  if (kernel == nullptr || !in_batches_) return 0;
  const detail::FieldOfNodes f = in_nodes(H0);
  detail::ChordEnds ends;
  const Matrix3 change = H1.rotation.toRotationMatrix() - H0.rotation.toRotationMatrix();
  const Vector3 way = H1.translation - H0.translation;
  for (int axis = 0; axis < 3; ++axis) {
    for (int column = 0; column < 3; ++column) ends.change[axis][column] = change(axis, column);
    ends.change[axis][3] = way[axis];
  }
  const std::uint32_t lanes = (batch.count + kernel->lanes - 1) / kernel->lanes * kernel->lanes;
  for (std::uint32_t i = batch.count; i < lanes; ++i) batch.from_clearance[i] = kEverywhere;
  std::uint64_t free = 0;
  for (std::uint32_t first = 0; first < batch.count; first += kernel->lanes) {
    free |= std::uint64_t{kernel->free_chords(f, ends, batch, first)} << first;
  }
  return free;
}

std::uint64_t Voxelmap::free_chords(const Pose& H0, const Pose& H1, SampleBatch& batch) const noexcept {
  return free_chords_by(kSampleKernel, H0, H1, batch);
}

}  // namespace godobject
