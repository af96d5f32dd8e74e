#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>

#include "godobject/pose.h"

namespace godobject {

/// How a contact whose gap is not the margin regains it, or may lose it.
struct GapLaw {
  double margin;        ///< the gap that is kept [m]
  double tolerance;     ///< a gap this near to the margin counts as the margin: a body at rest stays where it is [m]
  double recovery;      ///< share of a lost gap that is regained in one sub-step [1]
  double largest_gain;  ///< most that is regained in one sub-step [m]

  /// Required gap increase of one sub-step, from `lost` = margin - gap; negative: the gap may shrink [m].
  double required_gain(double lost) const noexcept {
    if (std::fabs(lost) <= tolerance) return 0.0;
    return lost > 0.0 ? std::min(recovery * lost, largest_gain) : lost;
  }
};

/// Share of a lost gap that is regained in one sub-step.
/// Chosen: 0.1 to 0.5 rest on the same poses; above 0.5 a tilted face that regains its gap at one end loses it at the
/// other and swings, below 0.1 a body that was pushed too near takes tens of cycles to come back.
inline constexpr double kRecovery = 0.3;

/// Linear constraints of one cycle on the motion (x, r) of the god object, in the body frame S, one a contact point:
///     n . (x + r x P) >= required gain
/// n is the unit direction in which the gap grows, P the point; the required gain is the gap increase that the motion must
/// bring [m], and if negative the decrease that it may bring. Single precision, one array a component: the solver spends
/// most of its time in scans over all rows.
struct ContactRows {
  static constexpr std::uint32_t kCapacity = 2048;
  /// A cache line longer: at a power of two apart, the arrays' first rows would all fall into one set of the cache.
  static constexpr std::uint32_t kLength = kCapacity + 16;

  /// Contacts that become rows together.
  struct Batch {
    static constexpr std::uint32_t kCapacity = 64;

    std::uint32_t count = 0;
    std::uint32_t id[kCapacity];
    alignas(64) double point_x[kCapacity];  ///< P, in S [m]
    alignas(64) double point_y[kCapacity];
    alignas(64) double point_z[kCapacity];
    alignas(64) double gradient_x[kCapacity];  ///< of the distance, in the field's frame
    alignas(64) double gradient_y[kCapacity];
    alignas(64) double gradient_z[kCapacity];
    alignas(64) double distance[kCapacity];  ///< [m]
  };

  std::uint32_t count = 0;
  alignas(64) float normal_x[kLength];
  alignas(64) float normal_y[kLength];
  alignas(64) float normal_z[kLength];
  alignas(64) float torque_x[kLength];  ///< P x n
  alignas(64) float torque_y[kLength];
  alignas(64) float torque_z[kLength];
  alignas(64) float required_gain[kLength];
  float point_x[kLength];
  float point_y[kLength];
  float point_z[kLength];
  std::uint32_t id[kLength];  ///< of the contact point, the same from cycle to cycle

  bool full() const noexcept { return count == kCapacity; }

  /// Not when full.
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

  /// Appends the contacts, as far as there is room; gives how many found none. No gradient is zero; as P moves by dP
  /// in S the distance grows by gradient^T R_S dP, with R_S = `S_to_gradient`.
  std::uint32_t push(Batch& batch, const Matrix3& S_to_gradient, const GapLaw& gap) noexcept;

  static constexpr std::uint32_t kNone = ~0u;

  /// The first row from `begin` on of the contact point; `count` if there is none.
  std::uint32_t find(std::uint32_t point_id, std::uint32_t begin) const noexcept;

  struct Violated {
    std::uint32_t row = kNone;  ///< kNone: none by more than the tolerance
    double violation = 0.0;     ///< required gain - n . (x + r x P), the largest of all rows [m]
  };

  /// The row that a motion violates most. About 0.25 ns a row with eight lanes.
  Violated most_violated(const Motion& motion, double tolerance) const noexcept;

  Vector3 normal(std::uint32_t i) const noexcept {
    return {static_cast<double>(normal_x[i]), static_cast<double>(normal_y[i]), static_cast<double>(normal_z[i])};
  }
  Vector3 point(std::uint32_t i) const noexcept {
    return {static_cast<double>(point_x[i]), static_cast<double>(point_y[i]), static_cast<double>(point_z[i])};
  }
};

}  // namespace godobject
