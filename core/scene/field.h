#pragma once

#include <concepts>
#include <cstdint>

#include "core/scene/sample_batch.h"
#include "godobject/pose.h"

namespace godobject {

/// The still body's signed distance at a point of W, positive outside.
struct FieldSample {
  double distance = 0.0;               ///< phi [m]; +band or -band where `known` is false
  Vector3 gradient = Vector3::Zero();  ///< grad phi in W, not normalised; 0 where `known` is false
  bool known = false;                  ///< the point lies within the stored band
  double clearance = 0.0;              ///< no point nearer than this has a distance <= 0; 0 where none is known [m]
};

/// A gradient that is shorter than this has no direction: the middle of a wall or of a gap.
inline constexpr double kFlat = 1e-3;

/// What the paper's step #1 reads (its Figure 3 g): the layer of the voxel around a point. Voxels are centred at the
/// nodes.
struct LayerSample {
  int layer = 0;                        ///< v: 0 on the surface, negative outside, positive inside
  Vector3 to_center = Vector3::Zero();  ///< e: from the point to the voxel's centre C, in W [m]
};

/// Points whose clearances are looked up together.
struct PointBatch {
  static constexpr std::uint32_t kCapacity = 64;

  alignas(64) float x[kCapacity];  ///< [m]
  alignas(64) float y[kCapacity];
  alignas(64) float z[kCapacity];
  alignas(64) float clearance[kCapacity];  ///< [m]
  std::uint32_t count = 0;
};

/// DistanceField::clearances of a field that has nothing quicker than `sample`.
template <class Field>
void sample_clearances(const Field& field, const Pose& H, PointBatch& batch) noexcept {
  constexpr double kRoundedDown = 1.0 - 1e-6;
  for (std::uint32_t i = 0; i < batch.count; ++i) {
    const Vector3 p(static_cast<double>(batch.x[i]), static_cast<double>(batch.y[i]), static_cast<double>(batch.z[i]));
    batch.clearance[i] = static_cast<float>(kRoundedDown * field.sample(H * p).clearance);
  }
}

/// Keeps the sample of point `i` of a batch, at p_field.
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

/// Point `i` of a batch that was looked up, in the field's frame, and what was found there.
inline Vector3 stored_position(const SampleBatch& batch, std::uint32_t i) noexcept {
  return {batch.field_x[i], batch.field_y[i], batch.field_z[i]};
}
inline FieldSample stored_sample(const SampleBatch& batch, std::uint32_t i) noexcept {
  return {batch.distance[i],
          {batch.gradient_x[i], batch.gradient_y[i], batch.gradient_z[i]},
          (batch.known >> i & 1) != 0,
          batch.clearance[i]};
}

/// DistanceField::samples of a field that has nothing quicker than `sample`.
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

/// A still body as steps #1-#7 see it: the compiled `Voxelmap`, or an analytic world in tests.
///
/// `sample(p)`          distance, gradient and clearance at p_W.
/// `layer(p)`           the paper's integer layer at p_W.
/// `clearances(H, b)`   for each point p of the batch what lipschitz() says of sample(H p).clearance, about H p; it may
///                      cost much less, and be less.
/// `samples(H, b)`      H p for each point p of the batch, to rounding, and sample() there; may cost less.
/// `free_chords(H0, H1, b)`  for the points p of a batch that was looked up at H1 and knows sample(H0 p).clearance, a
///                      bit each: the chord from H0 p to H1 p is known to meet no distance <= 0. It may be known of
///                      none. Bits beyond the batch's count mean nothing.
/// `lower_bound(c, r)`  no point x with |x - c| <= r is nearer to the surface: sample(x).distance is not below it, or
///                      is the band. May exceed the band, and may be loose; negative infinity wherever no bound of at
///                      least 0 is known.
/// `lipschitz()`        L >= 1, and
/// `assured_clearance()`  C [m]: for any points p and x, sample(x).clearance is at least
///                      min((sample(p).clearance - |x - p|) / L, C).
/// `voxel_size()`       s [m];  `band()`  distances beyond it are not known [m].
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
