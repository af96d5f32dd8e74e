#pragma once

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/qp/dual_active_set.h"
#include "core/pipeline/contact/search/near_points.h"
#include "core/pipeline/contact/surroundings.h"
#include "godobject/pose.h"

namespace godobject::detail {

/// The way out of an overlap in which no motion meets all rows, as of a nut that starts on its bolt half a degree out
/// of phase: what pushes it out all round cancels, and what pushes it along remains.
///
/// It is the motion (x, r) with the least sum of squares of n . (x + r x P) - gain over all points that have lost a
/// part of their margin, by the normal equations in the coupling's metric (one step of Gauss and Newton). Directions in
/// which no point pushes lead to the device.
class Overlap {
 public:
  explicit Overlap(const ContactLengths& lengths) noexcept : lengths_(lengths) {}

  /// Adds the near points of one direction; H is the pose of the shell in the field's frame. Cost: some 100
  /// instructions for a point that lost its margin, 2 for another. Real-time safe.
  template <class Direction>
  void add(const NearPoints& near, const Pose& H) noexcept {
    const NearRows<Direction> near_rows(near, H, lengths_, 1.0);
    for (std::uint32_t k = 0; k < near.count; ++k) {
      if (!(near.distance[k] < lengths_.margin)) continue;
      const NearRow row = near_rows.row(k);
      if (!row.exists) continue;
      Vector6 gradient;
      gradient << row.normal_S, row.point_S.cross(row.normal_S) / lengths_.metric.gyration;
      squares_.noalias() += gradient * gradient.transpose();
      sums_ += row.required_gain * gradient;
    }
  }

  /// Returns the way out of one cycle in S [m, rad]. `wanted`: the motion to the device, with the weight of a
  /// thousandth of the points.
  Motion way_out(const Motion& wanted) const noexcept;

 private:
  const ContactLengths& lengths_;
  Matrix6 squares_ = Matrix6::Zero();
  Vector6 sums_ = Vector6::Zero();
};

}  // namespace godobject::detail
