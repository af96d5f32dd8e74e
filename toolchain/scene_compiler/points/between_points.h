#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "toolchain/scene_compiler/mesh/surface_sample.h"
#include "toolchain/scene_compiler/points/relief.h"

/// Bounds the depth at which two bodies may meet where no point of either detects it.
///
/// The moving body A has sample points on its surface, the still body B feature points on its own. No sample point is
/// inside B and no feature point inside A, now and along the whole motion from a pose at which the bodies were apart.
/// Let D be the largest depth so far of either surface within the other body. It occurs at x on A's surface, and y is
/// the point of B's surface nearest to x (or the other way round).
///
/// 1. Depth changes by at most a metre per metre, so D <= distance(x, sample points).
///
/// 2. A ball of radius D around x is in B. Every part of B that is deeper than D has never met A's surface, so it is
/// outside A: x and y face each other along one axis, D apart. If a ball of radius D fits into A at x, y is D deep in A
/// too, and D <= distance(y, features).
///
/// 3. Let p be a sample point at distance r_p from the axis, at most alpha farther out than x. If B's surface falls by
/// at most beta from y within r_p, p would be in B if D > alpha + beta. The same holds for a feature point q at r_q, at
/// most beta farther out than y, if A's surface falls by at most alpha within r_q.
///
/// So a place is covered directly if a point is nearer than D. For the other places let R be the distance from the
/// place's axis to the nearest point that serves it (as p or q in 3), and L the radius within which the surface falls
/// by at most alpha or beta. Then D <= alpha + beta for a pair with R_x <= L_y or R_y <= L_x. With any increasing
/// function s two conditions suffice: s(R_x) <= L_x for all x, and R_y <= s(L_y) for all y with L_y < max R_x. For
/// where R_x > L_y they give R_y <= s(L_y) <= s(R_x) <= L_x. We use s(R) = hypot(R, h): beside an edge of B, L is the
/// distance from the edge, and points at most 2 h apart along it serve the faces that meet there.
///
/// R and L are measured on the meshes themselves (Relief), at other places than those for which points were added. The
/// bound holds up to the errors of the stored fields. Where a body is thinner than 2 D no point is D deep in it anyway,
/// but bodies may pass through each other, for surface on the far side meets. Surface between the places is not
/// covered.
namespace godobject::scene_compiler {

/// The reason why the search for points ended.
enum class Stopped : std::uint8_t {
  kReached,  ///< the wanted bound holds
  kPoints,   ///< a body has the largest number of points
  kPlaces,   ///< too fine for the largest number of places
  kRounds,   ///< places were left over after all rounds
};

/// The bound that holds.
struct BetweenPoints {
  double bound = std::numeric_limits<double>::infinity();  ///< D [m]; infinity: no bound is known
  double moving_fall = 0.0;                                ///< alpha [m]
  double still_fall = 0.0;                                 ///< beta [m]
  Stopped stopped = Stopped::kReached;
};

/// The bound that is wanted.
struct Target {
  double bound = 0.0;        ///< D [m]
  double moving_fall = 0.0;  ///< alpha [m]
  double still_fall = 0.0;   ///< beta, D - alpha [m]
  double edge = 0.0;         ///< h [m]

  /// Returns a stricter or looser target with the same s. Points that satisfy a stricter one satisfy a looser one too.
  Target scaled(double by) const { return {by * bound, by * moving_fall, by * still_fall, edge}; }
  /// Argument 3 needs bodies that are solid from the fall down to D. Twice that detects steep walls.
  Relief::Fall moving() const { return {moving_fall, 2.0 * bound}; }
  Relief::Fall still() const { return {still_fall, 2.0 * bound}; }
  double stretched(double aside) const { return std::hypot(aside, edge); }  ///< s
  double unstretched(double level) const { return level > edge ? std::sqrt(level * level - edge * edge) : 0.0; }
};

/// The places at which a target does not hold.
struct Open {
  std::vector<std::uint8_t> is_open;  ///< by place: 1 or 0
  std::size_t count = 0;
  double largest_aside = 0.0;  ///< largest R of the places that are neither open nor covered directly [m]
};

/// Returns A's open places: without a point nearer than D, and without s(R) <= L or R <= `limit` [m]. Checks only the
/// places in `among`, if it is not empty.
Open open_moving(const Relief& relief, std::span<const SurfaceSample> points, const Target& target, double limit,
                 std::span<const std::uint8_t> among = {});

/// Returns B's open places: without a point nearer than D, without R <= s(L), and with L < `largest_aside`, A's largest
/// R [m]. `among` as above.
Open open_still(const Relief& relief, std::span<const SurfaceSample> points, const Target& target, double largest_aside,
                std::span<const std::uint8_t> among = {});

enum class Side : std::uint8_t { kMoving, kStill };

/// The requirement on the points that are added to a surface.
struct Demand {
  Side side;
  Target target;
  double largest_aside;  ///< A: largest R; B: the largest L that matters [m]
  double sharp;          ///< largest distance of any place on an edge to a point [m]
};

/// Returns places of `relief`, the sharpest first, at most `most`, that as new points satisfy the demand at the `open`
/// places. Deterministic.
std::vector<SurfaceSample> points_to_add(const Relief& relief, std::span<const std::uint8_t> open, const Demand& demand,
                                         std::size_t most);

/// Estimates the number of points that a surface without any needs for the demand, from each `stride`-th coarse place.
/// `dense`: density of the points that exist anyway [1/m^2].
double estimated_points(const Relief& relief, const Demand& demand, double dense, std::size_t stride);

}  // namespace godobject::scene_compiler
