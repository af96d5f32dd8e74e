#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/scene/field.h"
#include "core/scene/sample_batch.h"
#include "godobject/pose.h"

namespace godobject {

/// The near points of one direction in a sub-step: those with a clearance below the search radius, at the start of the
/// motion. Of the outer ones only a bound is known. One array a component.
struct NearPoints {
  /// Most near points. Chosen: 706 KiB a direction; the demo's peg has up to 4540 in both, an M16 nut on its bolt up to
  /// 10072.
  static constexpr std::uint32_t kCapacity = 16384;
  static constexpr std::uint32_t kAtOnce = 4;  ///< points in a vector
  /// Length of the arrays: longer by a cache line, as ContactRows::kLength.
  static constexpr std::uint32_t kLength = kCapacity + 16;

  std::uint32_t count = 0;
  std::uint32_t bounded = 0;  ///< the first points of the list, of which only a bound was known when they were listed
  alignas(64) float x[kLength];  ///< in the shell's frame [m]
  alignas(64) float y[kLength];
  alignas(64) float z[kLength];
  alignas(64) double distance[kLength];   ///< stored [m]; less if edge pairs imply the row, or only a bound is known
  alignas(64) double clearance[kLength];  ///< FieldSample::clearance, or a bound of it [m]
  alignas(64) float gradient_x[kLength];  ///< of the distance, in the field's frame; 0: not known, or no row [1]
  alignas(64) float gradient_y[kLength];
  alignas(64) float gradient_z[kLength];
  std::uint32_t index[kLength];  ///< number in the shell

  /// Appends the chosen points of a batch while there is room. Returns those that were appended. `chosen` and the
  /// result: bit masks; `numbers`: of the batch's points in the shell. Cost: nine stores a point. Real-time safe.
  std::uint64_t push(const std::uint32_t* numbers, const SampleBatch& batch, std::uint64_t chosen) noexcept {
    std::uint32_t i = count;
    std::uint64_t left = chosen;
    for (; left != 0 && i < kCapacity; left &= left - 1, ++i) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(left));
      index[i] = numbers[k];
      x[i] = batch.x[k];
      y[i] = batch.y[k];
      z[i] = batch.z[k];
      set(i, batch, k);
    }
    count = i;
    return chosen & ~left;
  }

  /// Most points of which only a bound is known: they leave room for a quarter, which are nearer.
  static constexpr std::uint32_t kMostBounded = kCapacity / 4 * 3;

  /// Empties the list.
  void clear() noexcept { count = bounded = 0; }

  /// Appends the chosen points of a batch of which only a lower bound of the clearance is known, while there is room:
  /// it stands for the distance too, and they have no gradient. Comes before `push`. Else as `push`. Cost: some 10
  /// instructions a point.
  std::uint64_t push_bounds(const std::uint32_t* numbers, const PointBatch& batch, std::uint64_t chosen) noexcept;

  /// Returns the place in the list of the point with this number in the shell; `count` if it is not near. Cost: a scan.
  std::uint32_t find(std::uint32_t number) const noexcept {
    return static_cast<std::uint32_t>(std::find(index, index + count, number) - index);
  }

  /// Tells whether only a bound of the clearance of point `i` is known.
  bool is_bound_only(std::uint32_t i) const noexcept {
    return i < bounded && gradient_x[i] == 0.0f && gradient_y[i] == 0.0f && gradient_z[i] == 0.0f;
  }

  /// Replaces the bound of point `i` by what was looked up at element `k` of a batch.
  void set(std::uint32_t i, const SampleBatch& batch, std::uint32_t k) noexcept {
    distance[i] = batch.distance[k];
    clearance[i] = batch.clearance[k];
    const bool is_known = (batch.known >> k & 1) != 0;
    gradient_x[i] = is_known ? static_cast<float>(batch.gradient_x[k]) : 0.0f;
    gradient_y[i] = is_known ? static_cast<float>(batch.gradient_y[k]) : 0.0f;
    gradient_z[i] = is_known ? static_cast<float>(batch.gradient_z[k]) : 0.0f;
  }

  /// Forgets the gradient of point `i`: it gets no row any more.
  void forget_gradient(std::uint32_t i) noexcept { gradient_x[i] = gradient_y[i] = gradient_z[i] = 0.0f; }

  /// Fills the elements behind the last point, which vectors may read. Call it after the last `push`.
  void pad() noexcept {
    for (std::uint32_t i = count; i % kAtOnce != 0; ++i) {
      x[i] = y[i] = z[i] = 0.0f;
      distance[i] = clearance[i] = 0.0;
      gradient_x[i] = gradient_y[i] = gradient_z[i] = 0.0f;
    }
  }

  /// Returns the smallest stored distance [m]; infinity if there is no point. NaN does not count. Cost: about an
  /// instruction a point.
  double least_distance() const noexcept;

  /// Returns point `i` in the shell's frame [m].
  Vector3 point(std::uint32_t i) const noexcept {
    return {static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
  }

  /// Returns the gradient at point `i`, in the field's frame [1].
  Vector3 gradient(std::uint32_t i) const noexcept {
    return {static_cast<double>(gradient_x[i]), static_cast<double>(gradient_y[i]), static_cast<double>(gradient_z[i])};
  }

  /// Returns a bit mask of the 64 points from `first` on: those whose distance, to first order, ends below `gap` [m] if
  /// a point p is displaced by `turn` p + `shift` [m] in the field's frame. Cost: some 7 instructions a point.
  /// Real-time safe.
  std::uint64_t end_below(std::uint32_t first, const Matrix3& turn, const Vector3& shift, double gap) const noexcept;

  /// Returns a bit mask of the 64 points from `first` on: those whose chord needs a look-up. Their stored distance is
  /// positive, and the ball of their clearance does not contain the chord and a gap of `gap` [m] beyond it. A point p
  /// is displaced by `turn` p + `shift` [m]. Cost: some 5 instructions a point. Real-time safe.
  std::uint64_t leave_their_ball(std::uint32_t first, const Matrix3& turn, const Vector3& shift,
                                 double gap) const noexcept;
};
static_assert(sizeof(NearPoints) <= 706 * 1024);

}  // namespace godobject
