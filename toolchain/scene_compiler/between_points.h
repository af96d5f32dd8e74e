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
/// Places are of two kinds, then, for given D: covered directly (a point nearer than D), or held by their fall. Let r_A
/// be the distance of the sample point from the axis at x, r_B that of the feature point from the axis at y; neither
/// lies further below the place than its alpha or beta. If all of A's places that are not covered directly have a <=
/// alpha over stretch r_A, and all of B's b <= beta over r_B / stretch, or over A's largest r_A, whichever is smaller,
/// then D <= alpha + beta: point 3 holds for the sample point of a pair with stretch r_A <= r_B, otherwise for the
/// feature point. The stretch lets the points along an edge of B serve the faces beside it: they are hardly further
/// from a place there than the edge is.
/// The falls are measured on the meshes themselves (Relief), at places drawn apart from those that points were added
/// for.
namespace godobject::scene_compiler {

/// What a place leaves to its fall.
struct Gap {
  double distance;  ///< to the nearest point [m]; infinity where there is none
  double reach;     ///< of the nearest point that serves it from its normal, as far as it was looked [m]
  double fall;      ///< of the surface over the stretched reach [m]
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

inline constexpr double kStretch = 1.25;  ///< of the moving body's reaches; 1 / kStretch of the still one's

/// How gaps are looked at.
struct Look {
  double fall;     ///< a point serves a place on its side that is no further below it [m]
  double limit;    ///< of the reach [m]
  double stretch;  ///< of the reach
};

/// The gap of each place of `relief` between `points`.
std::vector<Gap> gaps_of(const Relief& relief, std::span<const SurfaceSample> points, const Look& look);

/// What is asked of the points on a surface.
struct Demand {
  double direct;    ///< a point no further than this covers any place [m]
  double fall;      ///< otherwise over the stretched reach of its point a place must not fall by more [m]
  double limit;     ///< nor need the reach be less than this [m]
  double stretch;   ///< of the reach
  bool everywhere;  ///< otherwise places that do not fall so far over the limit need no point at all
};

/// Places of `relief` that, added to `points`, meet the demand; the sharpest first, not more than `most`. `gaps`
/// between the points where they are known, by place, or empty: then only places whose gap does not meet the demand are
/// looked at. Deterministic.
std::vector<SurfaceSample> points_to_add(const Relief& relief, std::span<const SurfaceSample> points,
                                         const Demand& demand, std::span<const Gap> gaps, std::size_t most);

}  // namespace godobject::scene_compiler
