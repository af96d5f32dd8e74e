#pragma once

#include <concepts>
#include <cstdint>

#include "core/scene/sample_batch.h"
#include "godobject/pose.h"

namespace godobject {

/// A body's signed distance field at a point, in the field's frame; positive outside.
struct FieldSample {
  double distance = 0.0;               ///< phi [m]; +band or -band where `known` is false
  Vector3 gradient = Vector3::Zero();  ///< grad phi, not normalised [1]; 0 where `known` is false
  bool known = false;                  ///< the point lies within the stored band
  double clearance = 0.0;              ///< radius of a ball without a distance <= 0; 0 where none is proved [m]
};

/// A gradient shorter than this has no direction: in the middle of a wall or of a gap. Chosen: regular gradients have a
/// length of about 1, and rounding tilts one of this length by up to 1e-3.
inline constexpr double kFlat = 1e-3;

/// The layer of the voxel around a point, for step #1 of the paper (its Figure 3 g). Voxels are centred at the nodes.
struct LayerSample {
  int layer = 0;                        ///< v: 0 on the surface, negative outside, positive inside
  Vector3 to_center = Vector3::Zero();  ///< e: from the point to the voxel's centre C, in the field's frame [m]
};

/// A batch of points whose clearances are looked up together.
struct PointBatch {
  static constexpr std::uint32_t kCapacity = 64;

  alignas(64) float x[kCapacity];  ///< in the points' own frame [m]
  alignas(64) float y[kCapacity];
  alignas(64) float z[kCapacity];
  alignas(64) float clearance[kCapacity];  ///< the result [m]
  std::uint32_t count = 0;
};

/// Looks up DistanceField::clearances by `sample`, for fields without a faster way.
template <class Field>
void sample_clearances(const Field& field, const Pose& H, PointBatch& batch) noexcept {
  constexpr double kRoundedDown = 1.0 - 1e-6;  // derived: more than the rounding to single precision, 6e-8
  for (std::uint32_t i = 0; i < batch.count; ++i) {
    const Vector3 p(static_cast<double>(batch.x[i]), static_cast<double>(batch.y[i]), static_cast<double>(batch.z[i]));
    batch.clearance[i] = static_cast<float>(kRoundedDown * field.sample(H * p).clearance);
  }
}

/// Stores the sample of point `i` of a batch, which is at p_field in the field's frame.
inline void store_sample(const Vector3& p_field, const FieldSample& sample, SampleBatch& batch,
                         std::uint32_t i) noexcept {
  batch.field_x[i] = p_field.x();
  batch.field_y[i] = p_field.y();
  batch.field_z[i] = p_field.z();
  batch.distance[i] = sample.distance;
  batch.clearance[i] = sample.clearance;
  batch.gradient_x[i] = sample.gradient.x();
  batch.gradient_y[i] = sample.gradient.y();
  batch.gradient_z[i] = sample.gradient.z();
  batch.known = (batch.known & ~(std::uint64_t{1} << i)) | std::uint64_t{sample.known} << i;
}

/// Returns point `i` of a batch that was looked up, in the field's frame [m].
inline Vector3 stored_position(const SampleBatch& batch, std::uint32_t i) noexcept {
  return {batch.field_x[i], batch.field_y[i], batch.field_z[i]};
}
/// Returns the sample of point `i` of a batch that was looked up.
inline FieldSample stored_sample(const SampleBatch& batch, std::uint32_t i) noexcept {
  return {batch.distance[i],
          {batch.gradient_x[i], batch.gradient_y[i], batch.gradient_z[i]},
          (batch.known >> i & 1) != 0,
          batch.clearance[i]};
}

/// Looks up DistanceField::samples by `sample`, for fields without a faster way.
template <class Field>
void sample_each(const Field& field, const Pose& H, SampleBatch& batch) noexcept {
  const Matrix3 R = H.rotation.toRotationMatrix();
  for (std::uint32_t i = 0; i < batch.count; ++i) {
    const Vector3 p(static_cast<double>(batch.x[i]), static_cast<double>(batch.y[i]), static_cast<double>(batch.z[i]));
    const Vector3 p_field = R * p + H.translation;
    store_sample(p_field, field.sample(p_field), batch, i);
  }
  for (std::uint32_t i = batch.count; i % SampleBatch::kAtOnce != 0; ++i) store_sample({0.0, 0.0, 0.0}, {}, batch, i);
}

/// The distance field of a body for steps #1-#7: the compiled `Voxelmap`, or an analytic world in tests. Points p, x, c
/// are in the field's frame [m], H is the pose of the points' frame in the field's frame.
///
/// `sample(p)`          Returns distance, gradient and clearance at p.
/// `layer(p)`           Returns the paper's integer layer at p.
/// `clearances(H, b)`   Sets for each point p of the batch a clearance C at H p for which the guarantee of lipschitz()
///                      holds. It may cost much less than sample(H p).clearance, and be smaller.
/// `samples(H, b)`      Sets for each point p of the batch H p, up to rounding, and sample() there. It may cost less.
/// `free_chords(H0, H1, b)`
///                      Returns a bit mask of the batch's points p: those whose chord from H0 p to H1 p is proved to
///                      meet no distance <= 0; possibly none. The batch was looked up at H1 and contains
///                      sample(H0 p).clearance in `from_clearance`. Bits beyond the batch's count are undefined.
/// `lower_bound(c, r)`  Returns a lower bound of the distance at all x with |x - c| <= r: sample(x).distance is at
///                      least the bound or the band. The bound may exceed the band and may be loose. It is negative
///                      infinity where no bound of at least 0 is proved.
/// `lipschitz()`        Returns L >= 1. With A of `assured_clearance()`: for any points p and x, sample(x).clearance is
///                      at least min((sample(p).clearance - |x - p|) / L, A).
/// `assured_clearance()`
///                      Returns A [m].
/// `voxel_size()`       Returns s [m].
/// `band()`             Returns the largest stored distance [m].
template <class F>
concept DistanceField = requires(const F& field, const Vector3& p, double r, const Pose& H, PointBatch& batch,
                                 SampleBatch& samples) {
  { field.sample(p) }
  noexcept->std::same_as<FieldSample>;
  { field.clearances(H, batch) }
  noexcept->std::same_as<void>;
  { field.samples(H, samples) }
  noexcept->std::same_as<void>;
  { field.free_chords(H, H, samples) }
  noexcept->std::same_as<std::uint64_t>;
  { field.layer(p) }
  noexcept->std::same_as<LayerSample>;
  { field.lower_bound(p, r) }
  noexcept->std::same_as<double>;
  { field.lipschitz() }
  noexcept->std::same_as<double>;
  { field.assured_clearance() }
  noexcept->std::same_as<double>;
  { field.voxel_size() }
  noexcept->std::same_as<double>;
  { field.band() }
  noexcept->std::same_as<double>;
};

}  // namespace godobject
