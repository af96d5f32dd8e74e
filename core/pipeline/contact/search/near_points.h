#pragma once

#include <bit>
#include <cstdint>

#include "core/scene/sample_batch.h"
#include "godobject/pose.h"

namespace godobject {

/// Points of one direction that the motion of a sub-step may bring to a surface, as they are at its start. One array a
/// component.
struct NearPoints {
  static constexpr std::uint32_t kCapacity = 8192;
  static constexpr std::uint32_t kAtOnce = 4;
  /// A cache line longer, as ContactRows::kLength.
  static constexpr std::uint32_t kLength = kCapacity + 16;

  std::uint32_t count = 0;
  alignas(64) float x[kLength];  ///< in the shell's frame [m]
  alignas(64) float y[kLength];
  alignas(64) float z[kLength];
  alignas(64) double distance[kLength];   ///< stored [m]
  alignas(64) double clearance[kLength];  ///< FieldSample::clearance [m]
  std::uint32_t index[kLength];           ///< in the shell

  /// Appends the chosen points of a batch, a bit each, while there is room; gives those that found it. `numbers`: of
  /// the batch's points in the shell. Cost: six words a point.
  std::uint64_t push(const std::uint32_t* numbers, const SampleBatch& batch, std::uint64_t chosen) noexcept {
    std::uint32_t i = count;
    std::uint64_t left = chosen;
    for (; left != 0 && i < kCapacity; left &= left - 1, ++i) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(left));
      index[i] = numbers[k];
      x[i] = batch.x[k];
      y[i] = batch.y[k];
      z[i] = batch.z[k];
      distance[i] = batch.distance[k];
      clearance[i] = batch.clearance[k];
    }
    count = i;
    return chosen & ~left;
  }

  /// After the last push: what goes over the points by vectors may read a few further ones.
  void pad() noexcept {
    for (std::uint32_t i = count; i % kAtOnce != 0; ++i) {
      x[i] = y[i] = z[i] = 0.0f;
      distance[i] = clearance[i] = 0.0;
    }
  }

  /// Infinity if there are none; NaN does not count. About an instruction a point.
  double least_distance() const noexcept;

  Vector3 point(std::uint32_t i) const noexcept {
    return {static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
  }

  /// Of the 64 points from `first` on those whose chord a look-up must follow, a bit each: they are outside, and the
  /// ball of their clearance does not hold the chord and `kept` [m] beyond it. A point p goes by `turn` p + `shift`
  /// [m]. Real-time safe; some 5 instructions a point.
  std::uint64_t leave_their_ball(std::uint32_t first, const Matrix3& turn, const Vector3& shift,
                                 double kept) const noexcept;
};

}  // namespace godobject
