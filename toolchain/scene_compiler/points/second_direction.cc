#include "toolchain/scene_compiler/points/second_direction.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "toolchain/scene_compiler/points/relief.h"

namespace godobject::scene_compiler {
namespace {

// All are chosen. The result is checked at all places afterwards (`holds`), so other values change the number of points
// and the compile time, not the bound that is kept. "The bound" is [contact] between_points.

/// Share of the bound that points are added for: places between the checked ones are a little worse.
constexpr double kAim = 0.78;
/// Share of the bound above which a place gets more points, although it keeps the bound.
constexpr double kStrict = 0.82;
/// Rounds of adding points; each checks other places than the round before.
constexpr int kRounds = 14;
constexpr std::uint32_t kFirstSeed = 11;
/// Target::edge over the bound [1].
constexpr double kEdge = 0.6;
/// Largest distance from a place on an edge to a point, share of the aim.
constexpr double kSharp = 0.5;
/// Largest distance at which a point serves a place of the moving body, in coverages.
constexpr double kFurthest = 1.1;
/// Requested distance of places near which the surface falls off, share of the aim.
constexpr double kFinePart = 0.5;
/// Largest distance of such places with which the bound can be proved, share of the bound.
constexpr double kMostDense = 0.5;
/// Fall of the moving and of the still surface with which the search begins, share of the bound.
constexpr double kMovingRough = 0.5;
constexpr double kStillRough = 0.25;
/// Places by which the number of points is estimated.
constexpr std::size_t kEstimates = 4000;
/// Shares of the bound that are tried for the fall of the still surface.
constexpr std::array kStillParts{0.04, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
/// Multiples of the bound that are tried if the bound itself cannot be kept.
constexpr std::array kLarger{1.1, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0, 8.0};

void append(const std::vector<SurfaceSample>& more, std::vector<SurfaceSample>& samples) {
  samples.insert(samples.end(), more.begin(), more.end());
}

std::size_t stride_of(const Relief& relief) { return relief.evenly_spread() / kEstimates + 1; }

/// The places of both bodies.
struct Reliefs {
  Relief moving, still;
};

class Search {
 public:
  Search(double wanted, MovingSampling& sampling, BothDirections& both, double coverage)
      : sampling_(sampling), both_(both), coverage_(coverage) {
    target_.bound = wanted;
    target_.edge = kEdge * wanted;
    target_.moving_fall = kMovingRough * wanted;
    target_.still_fall = kStillRough * wanted;
  }

  /// Divides the bound between the bodies so that the fewest points suffice.
  void share_out(const Reliefs& reliefs) {
    double fewest = std::numeric_limits<double>::infinity();
    for (const double part : kStillParts) {
      Target target = target_;
      target.still_fall = part * target.bound;
      target.moving_fall = target.bound - target.still_fall;
      const double dense = sampling_.points / reliefs.moving.area();
      const double count = estimated_points(reliefs.moving, moving_demand(target), dense, stride_of(reliefs.moving)) +
                           estimated_points(reliefs.still, still_demand(target), 0.0, stride_of(reliefs.still));
      if (count >= fewest) continue;
      fewest = count;
      target_ = target;
    }
  }

  /// True if `target` holds at all places. Leaves places open at which it hardly holds.
  bool holds(const Reliefs& reliefs, const Target& target) {
    const Target strict = target.scaled(kStrict);
    const double limit = kFurthest * coverage_;
    moving_ = open_moving(reliefs.moving, sampling_.samples, strict, limit);
    const Open moving = open_moving(reliefs.moving, sampling_.samples, target, limit, moving_.is_open);
    moving_.largest_aside = std::max(moving_.largest_aside, moving.largest_aside);
    still_ = open_still(reliefs.still, both_.features, strict, moving_.largest_aside);
    return moving.count == 0 &&
           open_still(reliefs.still, both_.features, target, moving_.largest_aside, still_.is_open).count == 0;
  }

  void add_first(const Reliefs& reliefs) {
    const Target asked = target_.scaled(kAim);
    moving_ = open_moving(reliefs.moving, sampling_.samples, asked, coverage_);
    const auto places = reliefs.moving.places();
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].place != SurfaceSample::Place::kFace) moving_.is_open[i] = 1;
    }
    still_ = open_still(reliefs.still, {}, asked, kFurthest * coverage_);
    add(reliefs);
  }

  /// Adds points for the open places. False if a limit was met.
  bool add(const Reliefs& reliefs) {
    const std::size_t most =
        std::min<std::uint64_t>(std::uint64_t{kMostPointsForOne} * sampling_.points, format::kMaxPoints);
    const auto points =
        points_to_add(reliefs.moving, moving_.is_open, moving_demand(target_), most - sampling_.samples.size());
    const auto features =
        points_to_add(reliefs.still, still_.is_open, still_demand(target_), kMostFeatures - both_.features.size());
    append(points, sampling_.samples);
    append(features, both_.features);
    return sampling_.samples.size() < most && both_.features.size() < kMostFeatures;
  }

  const Target& target() const { return target_; }

  /// Returns the resolution of the places to check.
  Relief::Resolution resolution(Side side) const {
    const double fall = side == Side::kMoving ? target_.moving_fall : target_.still_fall;
    return {coverage_, fall, kFinePart * kAim * target_.bound};
  }

 private:
  Demand moving_demand(const Target& target) const {
    const Target asked = target.scaled(kAim);
    return {Side::kMoving, asked, coverage_, kSharp * asked.bound};
  }
  Demand still_demand(const Target& target) const {
    Target asked = target.scaled(kAim);
    asked.edge *= kAim;
    return {Side::kStill, asked, kFurthest * coverage_, kSharp * asked.bound};
  }

  MovingSampling& sampling_;
  BothDirections& both_;
  double coverage_;
  Target target_;
  Open moving_, still_;
};

}  // namespace

BothDirections see_both_directions(const OuterSurface& still, const OuterSurface& moving, double wanted,
                                   MovingSampling& sampling, const parallel::Progress& progress) {
  BothDirections both;
  const double coverage = largest_gap(moving, sampling.samples);
  Search search(wanted, sampling, both, coverage);
  for (int round = 0;; ++round) {
    const std::uint32_t seed = kFirstSeed + static_cast<std::uint32_t>(round);
    const auto share = [&](double part) { return (round + part) / (kRounds + 1); };
    const Reliefs reliefs{
        Relief(moving, search.resolution(Side::kMoving), seed, parallel::part_of(progress, share(0.0), share(0.4))),
        Relief(still, search.resolution(Side::kStill), seed, parallel::part_of(progress, share(0.4), share(0.8)))};
    const double dense_for = std::max(reliefs.moving.fine(), reliefs.still.fine()) / kMostDense;
    both.area = reliefs.still.area();
    if (round == 0) {
      search.share_out(reliefs);
      search.add_first(reliefs);
      continue;
    }
    const bool holds = search.holds(reliefs, search.target());
    if (holds && dense_for <= wanted) {
      both.between = {wanted, search.target().moving_fall, search.target().still_fall};
      break;
    }
    if (!holds && dense_for <= wanted && round < kRounds && search.add(reliefs)) continue;
    both.between.stopped = dense_for > wanted ? Stopped::kPlaces
                           : round < kRounds  ? Stopped::kPoints
                                              : Stopped::kRounds;
    for (const double larger : kLarger) {
      const Target target = search.target().scaled(larger);
      if (dense_for > target.bound || !search.holds(reliefs, target)) continue;
      both.between = {target.bound, target.moving_fall, target.still_fall, both.between.stopped};
      break;
    }
    break;
  }
  both.added_points = static_cast<std::uint32_t>(sampling.samples.size()) - sampling.points;
  if (progress) progress(1.0);
  return both;
}

}  // namespace godobject::scene_compiler
