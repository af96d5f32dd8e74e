#pragma once

#include <cstdint>

#include "core/scene/field.h"
#include "core/scene/sample_bits.h"
#include "godobject/pose.h"

namespace godobject::test {

/// A field that counts its look-ups. It claims `slope` times the Lipschitz constant of the field.
template <class Field>
struct Counted {
  Field field;
  double slope = 1.0;
  mutable int single = 0;  ///< calls of `sample`
  mutable int bounds = 0;  ///< points of `clearances`
  mutable int exact = 0;   ///< points of `samples`
  mutable int lower = 0;   ///< calls of `lower_bound`

  int looks() const noexcept { return single + bounds + exact + lower; }

  FieldSample sample(const Vector3& p) const noexcept {
    ++single;
    return field.sample(p);
  }
  void clearances(const Pose& H, PointBatch& batch) const noexcept {
    bounds += static_cast<int>(batch.count);
    field.clearances(H, batch);
  }
  void samples(const Pose& H, SampleBatch& batch) const noexcept {
    exact += static_cast<int>(batch.count);
    field.samples(H, batch);
  }
  std::uint64_t free_chords(const Pose& H0, const Pose& H1, SampleBatch& batch) const noexcept {
    return field.free_chords(H0, H1, batch);
  }
  LayerSample layer(const Vector3& p) const noexcept { return field.layer(p); }
  double lower_bound(const Vector3& c, double r) const noexcept {
    ++lower;
    return field.lower_bound(c, r);
  }
  double lipschitz() const noexcept { return slope * field.lipschitz(); }
  double assured_clearance() const noexcept { return field.assured_clearance(); }
  double voxel_size() const noexcept { return field.voxel_size(); }
  double band() const noexcept { return field.band(); }
};

}  // namespace godobject::test
