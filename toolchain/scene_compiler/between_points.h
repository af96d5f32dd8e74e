#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "toolchain/scene_compiler/parallel.h"
#include "toolchain/scene_compiler/relief.h"
#include "toolchain/scene_compiler/surface_sample.h"

/// How deep two bodies may meet where no point of either sees it.
///
/// The moving body A has sample points on its surface, the still body B feature points on its own; no sample point is
/// inside B, no feature point inside A, and so it was along the whole motion from a pose clear of each other. Let D be
/// the largest depth of either surface within the other body, x a point of A's and y of B's surface where it is met.
///
/// 1. Depth changes by at most a metre a metre, so D <= distance(x, sample points), and D <= distance(y, features).
/// 2. Whatever of B lies deeper than D has never met A's surface, so it is outside of A; and the other way round. Where
///    balls of radius D fit into both bodies at x and y, the straight way inward from y therefore leaves A after D at
///    most, at a point that is D deep in B: x and y face each other along one axis, D apart, each the other's nearest.
/// 3. Seen along that axis, let `a` be how far A's surface falls away from x within the distance r of the nearest
///    sample point on x's side, and `b` B's from y within the same r. The sample point is at most `a` further out than
///    x, and would be inside B if it were less than D - b further out: D <= a + b. With a feature point at distance r
///    of y it is the same.
///
/// Places are of two kinds, then, for given D: covered directly (a point nearer than D), or held by their fall. If all
/// of A's others have a <= alpha over the distance to their sample point, and all of B's others b <= beta over the
/// distance to their feature point or over A's largest such distance, whichever is smaller, then D <= alpha + beta: for
/// a pair with r_A <= r_B point 3 holds for the sample point, otherwise for the feature point.
/// The falls are measured on the meshes themselves (Relief), at places drawn apart from those that points were added
/// for.
namespace godobject::scene_compiler {

/// What a place leaves to its fall.
struct Gap {
  double distance;  ///< to the nearest point [m]; infinity where there is none
  double reach;     ///< to the nearest point on the place's side of the body, as far as it was looked [m]
  double fall;      ///< of the surface over the reach [m]
};

struct BetweenPoints {
  double bound = 0.0;        ///< D [m]
  double moving_fall = 0.0;  ///< alpha [m]
  double still_fall = 0.0;   ///< beta [m]
};

/// The smallest D with alpha + beta <= D. `reach`: how far B was looked at [m]; A's places that reach further count as
/// held by nothing but points nearer than D.
BetweenPoints bound_between(std::span<const Gap> moving, std::span<const Gap> still, double reach);

/// The largest reach of those not nearer than `direct` to a point [m].
double largest_reach(std::span<const Gap> gaps, double direct);

/// The gap of each place of `relief` between `points`, looked at no further than `limit` [m].
std::vector<Gap> gaps_of(const Relief& relief, std::span<const SurfaceSample> points, double limit);

/// What is asked of the points on a surface.
struct Demand {
  double direct;    ///< a point no further than this covers any place [m]
  double fall;      ///< otherwise over the distance to its point a place must not fall by more [m]
  double limit;     ///< nor need it be nearer than this [m]
  bool everywhere;  ///< otherwise places that do not fall so far over the limit need no point at all
};

/// Places of `relief` that, added to `points`, meet the demand; the sharpest first, not more than `most`.
/// Deterministic.
std::vector<SurfaceSample> points_to_add(const Relief& relief, std::span<const SurfaceSample> points,
                                         const Demand& demand, std::size_t most);

}  // namespace godobject::scene_compiler
