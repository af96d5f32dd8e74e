#pragma once

#include "core/scene/field.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::precision {

/// The exact signed distance to a mesh in the interface of the pipeline's fields, without voxels. Cost: some
/// microseconds for each look-up.
class MeshField {
 public:
  /// Stores a reference: `surface` must outlive this object. `voxel_size`: unit of the solvers' lengths [m].
  MeshField(const scene_compiler::SolidSurface& surface, double voxel_size)
      : surface_(&surface), voxel_size_(voxel_size) {}

  double distance(const Vector3& p) const noexcept { return surface_->signed_distance(p); }

  FieldSample sample(const Vector3& p) const noexcept;
  void clearances(const Pose& H, PointBatch& batch) const noexcept { sample_clearances(*this, H, batch); }
  void samples(const Pose& H, SampleBatch& batch) const noexcept { sample_each(*this, H, batch); }
  std::uint64_t free_chords(const Pose&, const Pose&, SampleBatch&) const noexcept { return 0; }
  LayerSample layer(const Vector3& p) const noexcept;
  double lower_bound(const Vector3& center, double radius) const noexcept;
  double lipschitz() const noexcept { return 1.0; }
  double assured_clearance() const noexcept { return band(); }
  double voxel_size() const noexcept { return voxel_size_; }
  double band() const noexcept { return 1e3; }

 private:
  const scene_compiler::SolidSurface* surface_;
  double voxel_size_;
};

static_assert(DistanceField<MeshField>);

}  // namespace godobject::precision
