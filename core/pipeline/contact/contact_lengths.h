#pragma once

#include <algorithm>
#include <cstdint>

#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/pipeline/contact/qp/least_constraint.h"
#include "core/pipeline/cycle/parameters.h"
#include "core/spatial/bounding_sphere.h"

namespace godobject {

/// The lengths of the contact solver [m], all derived from the voxel edge s and the margin m. Constant for a session.
struct ContactLengths {
  double margin;                  ///< m: the gap that the god object maintains
  double rounding;                ///< of stored distances: gaps that differ by at most this count as equal
  double wanted_margin;           ///< a gap below this may only grow while second looks remain
  double least_margin;            ///< a gap below this may only grow
  double shortest_search_radius;  ///< lower bound of the search radius
  double longest_search_radius;   ///< upper bound; ContactScene lowers it to what both fields allow
  double opening;                 ///< a gap that exceeds the margin by more than this is not a contact
  double largest_gain;            ///< most that a lost gap regains in a sub-step
  double longest_way_out;         ///< longest stretch of the coupling on the way out of an overlap
  double deepest_overlap;         ///< of two edges at the start; a thin body may lie between edges farther apart
  double radius;                  ///< R_max
  BoundingSphere sphere;          ///< around all sample points, in S
  std::uint32_t point_budget;     ///< as Parameters::point_budget
  CouplingMetric metric;

  /// Search radius over the expected displacement. Measured (godobject-replay on the demo's paths;
  /// tests/bench/instructions): with 1.0 a second sub-step follows in 46 instead of 24 cycles over the teapot, and a
  /// sliding cycle takes 5 % fewer instructions. With 2 it takes 11 % more, and the rows overflow in 517 instead of 14
  /// cycles in the peg's hole.
  static constexpr double kSearchRadiusOverDisplacement = 1.25;

  /// Returns the lengths for the parameters of a session.
  static ContactLengths make(const Parameters& q) noexcept;

  /// Returns the search radius of a sub-step that is expected to displace points by up to `displacement` [m].
  /// `longest`: up to this distance the fields tell near points from others [m]. Three margins are added. Measured: 1.5
  /// takes a second sub-step in 41 instead of 36 cycles in the handle, 6 takes 1.5 % more instructions in a sliding
  /// cycle.
  double search_radius_for(double displacement, double longest) const noexcept {
    return std::clamp(displacement + 3.0 * margin, std::min(shortest_search_radius, longest), longest);
  }

  /// Returns the law by which a lost gap is regained.
  GapLaw gap_law() const noexcept;
};

}  // namespace godobject
