#include "toolchain/scene_compiler/points/between_points.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/points/point_tree.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using Place = SurfaceSample::Place;

constexpr std::size_t kCandidates = 8;  // for a point, that are tried
constexpr double kOverlap = 2.6;        // squared radii, that one of many overlapping discs covers alone

/// Returns the distance of `point` from the normal at place `i`.
double aside(const Relief& relief, std::size_t i, const Vector3d& point) {
  const double depth = relief.depth_below(i, point);
  return std::sqrt(std::max(0.0, (point - relief.places()[i].point).squaredNorm() - depth * depth));
}

/// True if `point` is on the side of place `i`, and at most `fall` below it.
bool serves(const Relief& relief, std::size_t i, const SurfaceSample& point, double fall) {
  return same_side(relief.places()[i], point) && relief.depth_below(i, point.point) <= fall;
}

/// Points that may cover places.
class Points {
 public:
  explicit Points(std::span<const SurfaceSample> points) : points_(points), tree_(points_of(points)) {}

  bool any_within(const Vector3d& at, double distance) const { return tree_.any_within(at, distance); }

  /// Returns R of place `i`; infinity beyond `limit`.
  double nearest_aside(const Relief& relief, std::size_t i, double fall, double limit) const {
    const auto serving = [&](std::uint32_t j) { return serves(relief, i, points_[j], fall); };
    const PointTree::Nearest near = tree_.nearest(relief.places()[i].point, std::numbers::sqrt2 * limit, serving);
    if (near.index == PointTree::kNone) return std::numeric_limits<double>::infinity();
    const double found = aside(relief, i, points_[near.index].point);
    return found <= limit ? found : std::numeric_limits<double>::infinity();
  }

 private:
  std::span<const SurfaceSample> points_;
  PointTree tree_;
};

/// Collects the open places. `judge` gets some of the places and sets is_open where one is open, and the aside where it
/// is not and R matters.
template <class Judge>
Open open_places(const Relief& relief, std::span<const std::uint8_t> among, const Judge& judge) {
  const std::size_t count = relief.places().size();
  Open open;
  open.is_open.resize(count);
  std::vector<double> asides(count);
  relief.for_each_run([&](const Relief::Run& run) {
    std::vector<std::uint32_t> asked;
    for (const std::uint32_t i : run) {
      if (among.empty() || among[i] != 0) asked.push_back(i);
    }
    judge(std::move(asked), open.is_open, asides);
  });
  open.count = static_cast<std::size_t>(std::count(open.is_open.begin(), open.is_open.end(), 1));
  for (const double aside : asides) open.largest_aside = std::max(open.largest_aside, aside);
  return open;
}

/// Returns the largest distance from the normal of a place at which a point serves it; infinity if it needs no point.
double served_within(const Relief& relief, std::size_t i, const Demand& demand) {
  const Target& target = demand.target;
  if (demand.side == Side::kMoving) {
    const double most = target.stretched(demand.largest_aside);
    return target.unstretched(relief.level_radius(i, target.moving(), most));
  }
  const double level = relief.level_radius(i, target.still(), demand.largest_aside);
  return level < demand.largest_aside ? target.stretched(level) : std::numeric_limits<double>::infinity();
}

/// Chooses points from the open places, sharper ones first, until no place is open.
class Cover {
 public:
  Cover(const Relief& relief, std::span<const std::uint8_t> open, const Demand& demand)
      : relief_(relief),
        demand_(demand),
        fall_(demand.side == Side::kMoving ? demand.target.moving_fall : demand.target.still_fall) {
    for (std::uint32_t i = 0; i < open.size(); ++i) {
      if (open[i] != 0) open_.push_back(i);
    }
    radii_.resize(open_.size());
    parallel::for_each_index(open_.size(), [&](std::size_t k) { radii_[k] = served_within(relief, open_[k], demand); });
    std::vector<Vector3d> open_points;
    for (std::size_t k = 0; k < open_.size(); ++k) {
      open_points.push_back(place(k).point);
      if (std::isfinite(radii_[k])) furthest_ = std::max(furthest_, furthest(k));
    }
    tree_ = PointTree(open_points);
  }

  std::vector<SurfaceSample> choose(std::size_t most) const {
    std::vector<std::uint32_t> order(open_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [this](std::uint32_t k, std::uint32_t l) {
      return place(k).place != place(l).place ? place(k).place > place(l).place : radii_[k] < radii_[l];
    });
    std::vector<std::uint8_t> covered(open_.size());
    std::vector<SurfaceSample> chosen;
    for (const std::uint32_t k : order) {
      if (covered[k] != 0 || !std::isfinite(radii_[k])) continue;
      if (chosen.size() == most) break;
      chosen.push_back(place(best_for(k, covered)));
      for_each_covered(chosen.back(), covered, [&](std::uint32_t l) { covered[l] = 1; });
    }
    return chosen;
  }

 private:
  const SurfaceSample& place(std::size_t k) const { return relief_.places()[open_[k]]; }
  double direct(std::size_t k) const { return place(k).place == Place::kFace ? demand_.target.bound : demand_.sharp; }
  /// A point that serves a place may be as far above or below it as beside it.
  double furthest(std::size_t k) const {
    return place(k).place == Place::kFace ? std::max(direct(k), std::numbers::sqrt2 * radii_[k]) : direct(k);
  }

  bool covers(const SurfaceSample& point, std::size_t k) const {
    if ((point.point - place(k).point).squaredNorm() <= direct(k) * direct(k)) return true;
    if (place(k).place != Place::kFace) return false;
    return serves(relief_, open_[k], point, fall_) && aside(relief_, open_[k], point.point) <= radii_[k];
  }

  template <class Visit>
  void for_each_covered(const SurfaceSample& point, const std::vector<std::uint8_t>& covered,
                        const Visit& visit) const {
    tree_.within(point.point, furthest_, [&](std::uint32_t l, double squared_distance) {
      const double furthest = this->furthest(l);
      if (covered[l] == 0 && squared_distance <= furthest * furthest && covers(point, l)) visit(l);
    });
  }

  /// Returns, among the open places of the same sharpness that cover the one at `k`, the one that covers most: it lies
  /// away from places that are covered already. A corner covers itself.
  std::uint32_t best_for(std::uint32_t k, const std::vector<std::uint8_t>& covered) const {
    if (place(k).place == Place::kVertex) return k;
    std::vector<std::uint32_t> candidates;
    tree_.within(place(k).point, furthest(k), [&](std::uint32_t l, double) {
      if (covered[l] == 0 && place(l).place == place(k).place && covers(place(l), k)) candidates.push_back(l);
    });
    std::uint32_t best = k;
    std::size_t most = 0;
    const std::size_t stride = candidates.size() / kCandidates + 1;
    for (std::size_t c = 0; c < candidates.size(); c += stride) {
      std::size_t count = 0;
      for_each_covered(place(candidates[c]), covered, [&count](std::uint32_t) { ++count; });
      if (count > most) {
        most = count;
        best = candidates[c];
      }
    }
    return best;
  }

  const Relief& relief_;
  Demand demand_;
  double fall_;
  std::vector<std::uint32_t> open_;
  std::vector<double> radii_;  ///< by open place
  double furthest_ = 0.0;
  PointTree tree_{{}};  ///< of the open places
};

}  // namespace

Open open_moving(const Relief& relief, std::span<const SurfaceSample> points, const Target& target, double limit,
                 std::span<const std::uint8_t> among) {
  const Points near(points);
  using Places = std::vector<std::uint32_t>;
  return open_places(relief, among, [&](Places asked, std::vector<std::uint8_t>& is_open, std::vector<double>& asides) {
    double furthest = 0.0;
    std::erase_if(asked, [&](std::uint32_t i) {
      if (near.any_within(relief.places()[i].point, target.bound)) return true;
      const double found = near.nearest_aside(relief, i, target.moving_fall, limit);
      is_open[i] = found <= limit ? 0 : 1;
      if (is_open[i] != 0) return true;
      asides[i] = found;
      furthest = std::max(furthest, target.stretched(found));
      return false;
    });
    if (asked.empty()) return;
    Relief::Vicinity vicinity(relief, asked, furthest, target.moving());
    for (const std::uint32_t i : asked) {
      if (!vicinity.falls(i, target.stretched(asides[i]))) continue;
      is_open[i] = 1;
      asides[i] = 0.0;
    }
  });
}

Open open_still(const Relief& relief, std::span<const SurfaceSample> points, const Target& target, double largest_aside,
                std::span<const std::uint8_t> among) {
  const Points near(points);
  using Places = std::vector<std::uint32_t>;
  return open_places(relief, among, [&](Places asked, std::vector<std::uint8_t>& is_open, std::vector<double>&) {
    std::erase_if(asked, [&](std::uint32_t i) { return near.any_within(relief.places()[i].point, target.bound); });
    if (asked.empty()) return;
    Relief::Vicinity vicinity(relief, asked, largest_aside, target.still());
    for (const std::uint32_t i : asked) {
      if (!vicinity.falls(i, largest_aside)) continue;
      const double found = near.nearest_aside(relief, i, target.still_fall, target.stretched(largest_aside));
      is_open[i] = !std::isfinite(found) || vicinity.falls(i, target.unstretched(found)) ? 1 : 0;
    }
  });
}

std::vector<SurfaceSample> points_to_add(const Relief& relief, std::span<const std::uint8_t> open, const Demand& demand,
                                         std::size_t most) {
  return Cover(relief, open, demand).choose(most);
}

double estimated_points(const Relief& relief, const Demand& demand, double dense, std::size_t stride) {
  const std::size_t count = relief.evenly_spread() / stride;
  std::vector<double> needed(count);
  parallel::for_each_index(count, [&](std::size_t k) {
    const double radius = std::max(served_within(relief, k * stride, demand), demand.target.bound);
    needed[k] = std::max(0.0, 1.0 / (kOverlap * radius * radius) - dense);
  });
  return std::accumulate(needed.begin(), needed.end(), 0.0) * relief.area() /
         static_cast<double>(std::max<std::size_t>(count, 1));
}

}  // namespace godobject::scene_compiler
