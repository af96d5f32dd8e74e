#include "toolchain/scene_compiler/between_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "toolchain/scene_compiler/point_tree.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using Place = SurfaceSample::Place;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kBisections = 60;
constexpr double kEdgePart = 0.55;      // of the direct distance, between an edge and its points
constexpr std::size_t kCandidates = 8;  // for a point, that are tried

std::vector<Vector3d> points_of(std::span<const SurfaceSample> samples) {
  std::vector<Vector3d> points;
  points.reserve(samples.size());
  for (const SurfaceSample& sample : samples) points.push_back(sample.point);
  return points;
}

double largest_fall(std::span<const Gap> gaps, double beyond, double reach) {
  double largest = 0.0;
  for (const Gap& gap : gaps) {
    if (gap.distance > beyond) largest = std::max(largest, gap.reach <= reach ? gap.fall : kInfinity);
  }
  return largest;
}

/// Whether `point` serves place `i` over its distance: on its side, and no further below it than `fall`.
bool serves(const Relief& relief, std::size_t i, const SurfaceSample& point, double fall) {
  return same_side(relief.places()[i], point) && relief.depth_below(i, point.point) <= fall;
}

/// Distance of `point` from the normal at place `i`.
double aside(const Relief& relief, std::size_t i, const Vector3d& point) {
  const double depth = relief.depth_below(i, point);
  return std::sqrt(std::max(0.0, (point - relief.places()[i].point).squaredNorm() - depth * depth));
}

bool meets(const Gap& gap, const Demand& demand) {
  return gap.distance <= demand.direct ||
         (gap.fall <= demand.fall && (!demand.everywhere || gap.reach <= demand.limit));
}

/// How near a point must be for each place to meet the demand; infinity where none is needed. Edges are held to half of
/// it, so that their points serve the faces beside them too. Places with a gap that meets the demand need none.
std::vector<double> needed_radii(const Relief& relief, const Demand& demand, std::span<const Gap> gaps) {
  const auto places = relief.places();
  std::vector<double> radii(places.size());
  parallel_for(places.size(), [&](std::size_t i) {
    radii[i] = kInfinity;
    if (!gaps.empty() && meets(gaps[i], demand)) return;
    const double level = relief.level_radius(i, demand.fall, demand.limit * demand.stretch);
    if (level >= demand.limit * demand.stretch) {
      if (demand.everywhere) radii[i] = demand.limit;
    } else {
      radii[i] =
          places[i].place == Place::kFace ? std::max(level / demand.stretch, demand.direct) : kEdgePart * demand.direct;
    }
  });
  return radii;
}

/// The places without a point that is near enough, sharper ones first, and points of them that leave none.
class Cover {
 public:
  Cover(const Relief& relief, std::span<const SurfaceSample> points, const Demand& demand, std::span<const Gap> gaps)
      : relief_(relief), places_(relief.places()), demand_(demand), radii_(needed_radii(relief, demand, gaps)) {
    const PointTree tree(points_of(points));
    std::vector<std::uint8_t> is_open(places_.size());
    parallel_for(places_.size(), [&](std::size_t i) {
      if (!std::isfinite(radii_[i])) return;
      const auto covers = [&](std::uint32_t j) { return this->covers(points[j], i); };
      is_open[i] = tree.nearest(places_[i].point, furthest(i), covers).index == PointTree::kNone ? 1 : 0;
    });
    std::vector<Vector3d> open_points;
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
      if (is_open[i] == 0) continue;
      open_.push_back(i);
      open_points.push_back(places_[i].point);
      furthest_ = std::max(furthest_, furthest(i));
    }
    tree_ = PointTree(open_points);
  }

  std::vector<SurfaceSample> choose(std::size_t most) const {
    std::vector<std::uint32_t> order(open_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [this](std::uint32_t k, std::uint32_t l) {
      const std::uint32_t a = open_[k];
      const std::uint32_t b = open_[l];
      return places_[a].place != places_[b].place ? places_[a].place > places_[b].place : radii_[a] < radii_[b];
    });
    std::vector<std::uint8_t> covered(open_.size());
    std::vector<SurfaceSample> chosen;
    for (const std::uint32_t k : order) {
      if (covered[k] != 0) continue;
      if (chosen.size() == most) break;
      chosen.push_back(places_[open_[best_for(k, covered)]]);
      for_each_covered(chosen.back(), covered, [&](std::uint32_t l) { covered[l] = 1; });
    }
    return chosen;
  }

 private:
  double direct(std::size_t i) const { return std::min(demand_.direct, radii_[i]); }
  /// A point that serves a place may be as far above or below it as beside it.
  double furthest(std::size_t i) const { return std::max(direct(i), std::numbers::sqrt2 * radii_[i]); }

  bool covers(const SurfaceSample& point, std::size_t i) const {
    if ((point.point - places_[i].point).squaredNorm() <= direct(i) * direct(i)) return true;
    if (places_[i].place != Place::kFace) return false;
    return serves(relief_, i, point, demand_.fall) && aside(relief_, i, point.point) <= radii_[i];
  }

  template <class Visit>
  void for_each_covered(const SurfaceSample& point, const std::vector<std::uint8_t>& covered,
                        const Visit& visit) const {
    tree_.within(point.point, furthest_, [&](std::uint32_t l, double squared_distance) {
      const double furthest = this->furthest(open_[l]);
      if (covered[l] == 0 && squared_distance <= furthest * furthest && covers(point, open_[l])) visit(l);
    });
  }

  /// Of the open places of the same sharpness that cover the one at `k`, that which covers most: it stands off what is
  /// covered already. A corner stands for itself.
  std::uint32_t best_for(std::uint32_t k, const std::vector<std::uint8_t>& covered) const {
    const SurfaceSample& place = places_[open_[k]];
    if (place.place == Place::kVertex) return k;
    std::vector<std::uint32_t> candidates;
    tree_.within(place.point, furthest(open_[k]), [&](std::uint32_t l, double) {
      const SurfaceSample& other = places_[open_[l]];
      if (covered[l] == 0 && other.place == place.place && covers(other, open_[k])) candidates.push_back(l);
    });
    std::uint32_t best = k;
    std::size_t most = 0;
    const std::size_t stride = candidates.size() / kCandidates + 1;
    for (std::size_t c = 0; c < candidates.size(); c += stride) {
      std::size_t count = 0;
      for_each_covered(places_[open_[candidates[c]]], covered, [&count](std::uint32_t) { ++count; });
      if (count > most) {
        most = count;
        best = candidates[c];
      }
    }
    return best;
  }

  const Relief& relief_;
  std::span<const SurfaceSample> places_;
  Demand demand_;
  std::vector<double> radii_;
  std::vector<std::uint32_t> open_;
  double furthest_ = 0.0;  ///< of the open ones
  PointTree tree_{{}};     ///< of the open ones
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

std::vector<Gap> gaps_of(const Relief& relief, std::span<const SurfaceSample> points, const Look& look) {
  const auto places = relief.places();
  const PointTree tree(points_of(points));
  std::vector<Gap> gaps(places.size());
  parallel_for(places.size(), [&](std::size_t i) {
    const auto serving = [&](std::uint32_t j) { return serves(relief, i, points[j], look.fall); };
    const Vector3d& at = places[i].point;
    const PointTree::Nearest near = tree.nearest(at, std::numbers::sqrt2 * look.limit, serving);
    double reach = look.limit;
    double below = 0.0;
    if (near.index != PointTree::kNone) {
      reach = std::min(reach, aside(relief, i, points[near.index].point));
      below = relief.depth_below(i, points[near.index].point);
    }
    const double fall = std::max(below, relief.fall(i, look.stretch * reach));
    gaps[i] = {std::sqrt(tree.nearest(at).squared_distance), reach, fall};
  });
  return gaps;
}

std::vector<SurfaceSample> points_to_add(const Relief& relief, std::span<const SurfaceSample> points,
                                         const Demand& demand, std::span<const Gap> gaps, std::size_t most) {
  return Cover(relief, points, demand, gaps).choose(most);
}

}  // namespace godobject::scene_compiler
