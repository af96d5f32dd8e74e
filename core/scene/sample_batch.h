#pragma once

#include <cstdint>

namespace godobject {

/// Points whose distances and gradients are looked up together.
struct SampleBatch {
  static constexpr std::uint32_t kCapacity = 64;
  static constexpr std::uint32_t kAtOnce = 4;  ///< the results are finite up to the next multiple of it

  alignas(64) float x[kCapacity];  ///< in the points' own frame [m]
  alignas(64) float y[kCapacity];
  alignas(64) float z[kCapacity];
  std::uint32_t count = 0;

  // values at the start of the points' chords, if they have one; the batch is looked up at the end
  alignas(64) double from_clearance[kCapacity];  ///< [m]
  alignas(64) double from_distance[kCapacity];   ///< [m]

  // the results, as in FieldSample; there is no gradient where `known` is 0
  alignas(64) double field_x[kCapacity];  ///< in the field's frame [m]
  alignas(64) double field_y[kCapacity];
  alignas(64) double field_z[kCapacity];
  alignas(64) double distance[kCapacity];   ///< [m]
  alignas(64) double clearance[kCapacity];  ///< [m]
  alignas(64) double gradient_x[kCapacity];
  alignas(64) double gradient_y[kCapacity];
  alignas(64) double gradient_z[kCapacity];
  std::uint64_t known;  ///< one bit for each point
};
static_assert(SampleBatch::kCapacity == 64, "one bit for each point");

}  // namespace godobject
