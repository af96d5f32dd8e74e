#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "toolchain/scene_compiler/mesh/surface_sample.h"
#include "toolchain/scene_compiler/points/relief.h"

/// How deep two bodies may meet where no point of either sees it.
///
/// The moving body A has sample points on its surface, the still body B feature points on its own; no sample point is
/// inside B, no feature point inside A, and so it was along the whole motion from a pose clear of each other. Let D be
/// the largest depth of either surface within the other body so far, met at x of A's surface, and y of B's the nearest
/// to x (or the other way round).
///
/// 1. Depth changes by at most a metre a metre, so D <= distance(x, sample points).
/// 2. A ball of radius D around x is in B. Whatever of B lies deeper than D has never met A's surface, so it is outside
///    of A: x and y face each other along one axis, D apart. If a ball of radius D fits into A at x, y is D deep in A,
///    too, and D <= distance(y, features).
/// 3. Let p be a sample point at distance r_p from the axis, no more than alpha further out than x. If B's surface
///    falls by no more than beta from y within r_p, p would be in B were D > alpha + beta. With a feature point q at
///    r_q, no more than beta further out than y, it is the same if A's surface falls by no more than alpha within r_q.
///
/// A place is covered directly, then, if a point is nearer than D. Of the others let R be the distance of the nearest
/// point that serves it (as p or q in 3) from its axis, and L the radius within which the surface falls by no more than
/// alpha or beta. D <= alpha + beta for a pair with R_x <= L_y or R_y <= L_x. With any increasing function s it is
/// enough that s(R_x) <= L_x for all x, and that R_y <= s(L_y) for all y with L_y < max R_x: where R_x > L_y, this
/// gives R_y <= s(L_y) <= s(R_x) <= L_x. We take s(R) = hypot(R, h): beside an edge of B, L is the distance from it,
/// and points not further apart along it than 2 h serve the faces that meet there.
///
/// R and L are measured on the meshes themselves (Relief), at places drawn apart from those that points were added for.
/// What this does not see: bodies thinner than 2 D, where surface on the far side meets; and what lies between places.
namespace godobject::scene_compiler {

/// Why no more was looked for.
enum class Stopped : std::uint8_t {
  kReached,  ///< what is wanted holds
  kPoints,   ///< as many points of a body as may be
  kPlaces,   ///< too fine for the number of places that are looked at
  kRounds,   ///< places left over after all rounds
};

/// What holds.
struct BetweenPoints {
  double bound = std::numeric_limits<double>::infinity();  ///< D [m]; infinity: none is known
  double moving_fall = 0.0;                                ///< alpha [m]
  double still_fall = 0.0;                                 ///< beta [m]
  Stopped stopped = Stopped::kReached;
};

/// What is to hold.
struct Target {
  double bound = 0.0;        ///< D [m]
  double moving_fall = 0.0;  ///< alpha [m]
  double still_fall = 0.0;   ///< beta, D - alpha [m]
  double edge = 0.0;         ///< h [m]

  /// A stricter or looser one with the same s: what a stricter one holds, a looser one does, too.
  Target scaled(double by) const { return {by * bound, by * moving_fall, by * still_fall, edge}; }
  /// Point 3 needs the bodies to be solid from the fall down to D; twice that, so that steep walls are met.
  Relief::Fall moving() const { return {moving_fall, 2.0 * bound}; }
  Relief::Fall still() const { return {still_fall, 2.0 * bound}; }
  double stretched(double reach) const { return std::hypot(reach, edge); }  ///< s
  double unstretched(double level) const { return level > edge ? std::sqrt(level * level - edge * edge) : 0.0; }
};

/// The places for which it does not hold.
struct Open {
  std::vector<std::uint8_t> is_open;  ///< by place: 1 or 0
  std::size_t count = 0;
  double reach = 0.0;  ///< largest R of the others that are not covered directly [m]
};

/// A's places without a point nearer than D that lack s(R) <= L, or R <= `limit` [m]; of those in `among` only, if it
/// is not empty.
Open open_moving(const Relief& relief, std::span<const SurfaceSample> points, const Target& target, double limit,
                 std::span<const std::uint8_t> among = {});

/// B's places without a point nearer than D that lack R <= s(L), and L >= `reach`, A's largest R [m]; likewise.
Open open_still(const Relief& relief, std::span<const SurfaceSample> points, const Target& target, double reach,
                std::span<const std::uint8_t> among = {});

enum class Side : std::uint8_t { kMoving, kStill };

/// What is asked of the points that are added to a surface.
struct Demand {
  Side side;
  Target target;
  double reach;  ///< A: largest R; B: the largest L that matters [m]
  double sharp;  ///< distance of points on edges from any place there [m]
};

/// Places of `relief`, the sharpest first, not more than `most`, that meet the demand at the `open` ones when they are
/// added. Deterministic.
std::vector<SurfaceSample> points_to_add(const Relief& relief, std::span<const std::uint8_t> open, const Demand& demand,
                                         std::size_t most);

/// How many points it takes to meet the demand on a surface without any, estimated at each `stride`-th coarse place;
/// `dense`: points that are there anyhow [1/m^2].
double estimated_points(const Relief& relief, const Demand& demand, double dense, std::size_t stride);

}  // namespace godobject::scene_compiler
