#pragma once

#include <algorithm>
#include <cstdint>

#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/pipeline/contact/qp/least_constraint.h"
#include "core/pipeline/cycle/parameters.h"
#include "core/spatial/bounding_sphere.h"

namespace godobject {

/// Lengths of the contact solver, all derived from the voxel edge s and the margin m. Constant for a session.
struct ContactLengths {
  double margin;                  ///< m: the gap that the god object keeps
  double rounding;                ///< of stored distances: a gap that is smaller by no more than this counts as equal
  double wanted_margin;           ///< a gap below this may only grow, unless second looks do not help
  double least_margin;            ///< a gap below this may only grow
  double shortest_search_radius;  ///< bounds of the search radius
  double longest_search_radius;   ///< wanted; `ContactSearch` holds what the fields allow
  double opening;                 ///< a gap that is wider than the margin by more than this is no contact
  double largest_gain;            ///< most that a lost gap regains in a sub-step
  double radius;                  ///< R_max
  BoundingSphere sphere;          ///< around all sample points
  std::uint32_t point_budget;     ///< as Parameters
  CouplingMetric metric;

  /// In steady motion the search radius is this much longer than the last displacement.
  /// Measured (tests/bench/instructions profile): 1.1 misses points that a slightly faster cycle needs, which costs a
  /// second sub-step; 2 looks up twice as many points.
  static constexpr double kSearchRadiusOverDisplacement = 1.25;

  static ContactLengths make(const Parameters& q) noexcept;
  static double shortest_search_radius_of(const Parameters& q) noexcept { return 0.125 * q.voxel_size; }

  /// Search radius of a sub-step that is expected to displace points by up to `displacement`, where the fields can tell
  /// near points from others up to `longest` [m].
  double search_radius_for(double displacement, double longest) const noexcept {
    return std::clamp(displacement + 3.0 * margin, std::min(shortest_search_radius, longest), longest);
  }

  /// How a lost gap is regained.
  GapLaw gap_law() const noexcept;
};

}  // namespace godobject
