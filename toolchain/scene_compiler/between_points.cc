#include "toolchain/scene_compiler/between_points.h"

#include <algorithm>
#include <cmath>

#include "toolchain/scene_compiler/point_tree.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using Place = SurfaceSample::Place;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kBisections = 60;

std::vector<Vector3d> points_of(std::span<const SurfaceSample> samples) {
  std::vector<Vector3d> points;
  points.reserve(samples.size());
  for (const SurfaceSample& sample : samples) points.push_back(sample.point);
  return points;
}

/// Distances to the nearest point of all, and of those on the same side.
struct Distances {
  double any, same_side;
};

Distances distances(const SurfaceSample& place, std::span<const SurfaceSample> points, const PointTree& tree) {
  const auto on_side = [&](std::uint32_t j) { return same_side(place, points[j]); };
  return {std::sqrt(tree.nearest(place.point).squared_distance),
          std::sqrt(tree.nearest(place.point, on_side).squared_distance)};
}

double largest_fall(std::span<const Gap> gaps, double beyond, double reach) {
  double largest = 0.0;
  for (const Gap& gap : gaps) {
    if (gap.distance > beyond) largest = std::max(largest, gap.reach <= reach ? gap.fall : kInfinity);
  }
  return largest;
}

/// How near a point must be for each place to meet the demand; infinity where none is needed. Edges are held to half of
/// it, so that their points serve the faces beside them too.
std::vector<double> needed_radii(const Relief& relief, const Demand& demand) {
  const auto places = relief.places();
  std::vector<double> radii(places.size());
  parallel_for(places.size(), [&](std::size_t i) {
    const double level = relief.level_radius(i, demand.fall, demand.limit);
    if (level >= demand.limit) {
      radii[i] = demand.everywhere ? demand.limit : kInfinity;
    } else {
      radii[i] = places[i].place == Place::kFace ? std::max(level, demand.direct) : 0.5 * demand.direct;
    }
  });
  return radii;
}

/// The places without a point that is near enough, sharper ones first, thinned out so that each has one.
class Cover {
 public:
  Cover(const Relief& relief, std::span<const SurfaceSample> points, const Demand& demand)
      : places_(relief.places()), demand_(demand), radii_(needed_radii(relief, demand)) {
    const PointTree tree(points_of(points));
    std::vector<std::uint8_t> open(places_.size());
    parallel_for(places_.size(), [&](std::size_t i) {
      if (!std::isfinite(radii_[i])) return;
      const Distances to = distances(places_[i], points, tree);
      open[i] = to.any > direct(i) && to.same_side > radii_[i] ? 1 : 0;
    });
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
      if (open[i] != 0) open_.push_back(i);
    }
    std::stable_sort(open_.begin(), open_.end(), [this](std::uint32_t a, std::uint32_t b) {
      if (places_[a].place != places_[b].place) return places_[a].place > places_[b].place;
      return radii_[a] < radii_[b];
    });
  }

  std::vector<SurfaceSample> choose(std::size_t most) const {
    std::vector<Vector3d> points;
    double widest = 0.0;
    for (const std::uint32_t i : open_) {
      points.push_back(places_[i].point);
      widest = std::max(widest, radii_[i]);
    }
    const PointTree tree(points);
    std::vector<std::uint8_t> covered(open_.size());
    std::vector<SurfaceSample> chosen;
    for (std::size_t k = 0; k < open_.size() && chosen.size() < most; ++k) {
      if (covered[k] != 0) continue;
      const SurfaceSample& point = places_[open_[k]];
      chosen.push_back(point);
      tree.within(point.point, widest, [&](std::uint32_t j, double squared_distance) {
        const std::uint32_t i = open_[j];
        const double reach = same_side(point, places_[i]) ? radii_[i] : direct(i);
        if (squared_distance <= reach * reach) covered[j] = 1;
      });
    }
    return chosen;
  }

 private:
  double direct(std::size_t i) const { return std::min(demand_.direct, radii_[i]); }

  std::span<const SurfaceSample> places_;
  Demand demand_;
  std::vector<double> radii_;
  std::vector<std::uint32_t> open_;
};

}  // namespace

BetweenPoints bound_between(std::span<const Gap> moving, std::span<const Gap> still, double reach) {
  double low = 0.0;
  double high = 0.0;
  for (const auto gaps : {moving, still}) {
    for (const Gap& gap : gaps) high = std::max(high, std::isfinite(gap.distance) ? gap.distance : 2.0 * gap.fall);
  }
  high *= 2.0;
  const auto alpha = [&](double bound) { return largest_fall(moving, bound, reach); };
  const auto beta = [&](double bound) { return largest_fall(still, bound, kInfinity); };
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (alpha(middle) + beta(middle) <= middle ? high : low) = middle;
  }
  return {high, alpha(high), beta(high)};
}

double largest_reach(std::span<const Gap> gaps, double direct) {
  double largest = 0.0;
  for (const Gap& gap : gaps) {
    if (gap.distance > direct) largest = std::max(largest, gap.reach);
  }
  return largest;
}

std::vector<Gap> gaps_of(const Relief& relief, std::span<const SurfaceSample> points, double limit) {
  const auto places = relief.places();
  const PointTree tree(points_of(points));
  std::vector<Gap> gaps(places.size());
  parallel_for(places.size(), [&](std::size_t i) {
    const Distances to = distances(places[i], points, tree);
    const double reach = std::min(to.same_side, limit);
    gaps[i] = {to.any, reach, relief.fall(i, reach)};
  });
  return gaps;
}

std::vector<SurfaceSample> points_to_add(const Relief& relief, std::span<const SurfaceSample> points,
                                         const Demand& demand, std::size_t most) {
  return Cover(relief, points, demand).choose(most);
}

}  // namespace godobject::scene_compiler
