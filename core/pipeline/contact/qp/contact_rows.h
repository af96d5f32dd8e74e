#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>

#include "godobject/pose.h"

namespace godobject {

/// The id of the rows of the workspace's faces, which have no friction. It is no point: format::kMaxPoints is less.
inline constexpr std::uint32_t kFaceOfWorkspace = (1u << 31) - 1u;

/// The law by which a gap that differs from the margin grows or may shrink.
struct GapLaw {
  double margin;        ///< the gap to maintain [m]
  double tolerance;     ///< a gap within this of the margin counts as the margin, so that a body at rest stays [m]
  double recovery;      ///< share of the lost gap that one sub-step regains [1]
  double largest_gain;  ///< most that one sub-step regains [m]

  /// Returns the required gap increase of one sub-step from `lost` = margin - gap; negative: the gap may shrink [m].
  double required_gain(double lost) const noexcept {
    if (std::fabs(lost) <= tolerance) return 0.0;
    return lost > 0.0 ? std::min(recovery * lost, largest_gain) : lost;
  }
};

/// Share of a lost gap that one sub-step regains. Measured (godobject-replay, the demo's paths): peak forces are the
/// same from 0.05 to 1; with 1 a cycle in the handle takes all eight sub-steps.
inline constexpr double kRecovery = 0.3;

/// The linear constraints on the motion (x, r) of the god object in one sub-step, in the body frame S, one a contact
/// point:
///     n . (x + r x P) >= required gain
/// n is the unit direction in which the gap grows, P the point. The required gain is the gap increase that the motion
/// must bring [m]; if negative, the decrease that it may bring. The numbers are in single precision, one array a
/// component: the solver spends most of its time in scans over all rows.
struct ContactRows {
  /// Most rows. Chosen: the arrays take 89 KiB, and of the demo's paths only the peg's exceeds it, in 14 cycles.
  static constexpr std::uint32_t kCapacity = 2048;
  /// Length of the arrays: a cache line more. With a power of two, row i of all arrays would fall into one set of the
  /// cache.
  static constexpr std::uint32_t kLength = kCapacity + 16;

  /// Contacts that are appended together.
  struct Batch {
    static constexpr std::uint32_t kCapacity = 64;

    std::uint32_t count = 0;
    std::uint32_t id[kCapacity];            ///< of the contact point
    alignas(64) double point_x[kCapacity];  ///< P, in S [m]
    alignas(64) double point_y[kCapacity];
    alignas(64) double point_z[kCapacity];
    alignas(64) double gradient_x[kCapacity];  ///< of the distance, in the field's frame, not normalised [1]
    alignas(64) double gradient_y[kCapacity];
    alignas(64) double gradient_z[kCapacity];
    alignas(64) double distance[kCapacity];  ///< stored distance at P [m]
  };

  std::uint32_t count = 0;
  alignas(64) float normal_x[kLength];  ///< n, in S
  alignas(64) float normal_y[kLength];
  alignas(64) float normal_z[kLength];
  alignas(64) float torque_x[kLength];  ///< P x n [m]
  alignas(64) float torque_y[kLength];
  alignas(64) float torque_z[kLength];
  alignas(64) float required_gain[kLength];  ///< [m]
  float point_x[kLength];                    ///< P, in S [m]
  float point_y[kLength];
  float point_z[kLength];
  std::uint32_t id[kLength];  ///< of the contact point, the same from cycle to cycle

  bool full() const noexcept { return count == kCapacity; }

  /// Appends one row: n, P in S [m] and the required gain [m]. Only if there is room.
  void push(std::uint32_t point_id, const Vector3& normal, const Vector3& point, double gain) noexcept {
    const Vector3 torque = point.cross(normal);
    const std::uint32_t i = count++;
    normal_x[i] = static_cast<float>(normal.x());
    normal_y[i] = static_cast<float>(normal.y());
    normal_z[i] = static_cast<float>(normal.z());
    torque_x[i] = static_cast<float>(torque.x());
    torque_y[i] = static_cast<float>(torque.y());
    torque_z[i] = static_cast<float>(torque.z());
    point_x[i] = static_cast<float>(point.x());
    point_y[i] = static_cast<float>(point.y());
    point_z[i] = static_cast<float>(point.z());
    required_gain[i] = static_cast<float>(gain);
    id[i] = point_id;
  }

  /// Removes row `i`; the last row takes its place. Real-time safe.
  void remove(std::uint32_t i) noexcept;

  /// Appends the contacts as rows while there is room; returns how many found none. No gradient may be zero. As P moves
  /// by dP in S, the distance grows by gradient^T R_S dP with R_S = `S_to_gradient`. May change the batch behind its
  /// count.
  std::uint32_t push(Batch& batch, const Matrix3& S_to_gradient, const GapLaw& gap) noexcept;

  static constexpr std::uint32_t kNone = ~0u;

  /// Returns the first row of the contact point from row `begin` on; `count` if there is none.
  std::uint32_t find(std::uint32_t point_id, std::uint32_t begin) const noexcept;

  /// The result of `most_violated`.
  struct Violated {
    std::uint32_t row = kNone;  ///< kNone: no row is violated by more than the tolerance
    double violation{};         ///< required gain - n . (x + r x P), the largest of all rows [m]
  };

  /// Returns the row that the motion violates most, if by more than `tolerance` [m]. Cost: about 0.25 ns a row with
  /// eight lanes. Real-time safe.
  Violated most_violated(const Motion& motion, double tolerance) const noexcept;

  Vector3 normal(std::uint32_t i) const noexcept {
    return {static_cast<double>(normal_x[i]), static_cast<double>(normal_y[i]), static_cast<double>(normal_z[i])};
  }
  Vector3 point(std::uint32_t i) const noexcept {
    return {static_cast<double>(point_x[i]), static_cast<double>(point_y[i]), static_cast<double>(point_z[i])};
  }
};
static_assert(sizeof(ContactRows) <= 89 * 1024);

}  // namespace godobject
