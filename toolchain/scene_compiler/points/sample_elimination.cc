#include "toolchain/scene_compiler/points/sample_elimination.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/box.h"
#include "toolchain/scene_compiler/points/point_tree.h"

namespace godobject::scene_compiler {
namespace {

// Constants of the paper. They weight all pairs nearer than the final distance alike, so elimination does not wait for
// pairs that disappear anyway.
constexpr double kLimitFactor = 0.65;
constexpr double kLimitExponent = 1.5;
constexpr double kNothing = 1e-13;  // weight without neighbours: the rounding of sums of weights up to 1
constexpr double kCoarsest = 8.0;   // samples of level 1, chosen
/// Growth from level to level. The nodes, of all levels but the last, are fewer than (1 / 1.5) / (1 - 1 / 1.5) = 2
/// times the points.
constexpr double kLeastRefinement = 1.5;
constexpr double kWider = 1.5;  // growth of the search radius once no sample has neighbours, chosen
constexpr std::size_t kReportEvery = 1u << 16;

/// The rule by which samples crowd each other.
struct Crowding {
  double search_radius;  ///< largest distance of crowding samples [m]
  double limit;          ///< nearer samples count as at this distance [m]
  bool across_body;      ///< samples on opposite sides crowd each other too

  /// True if `sample` yields to `neighbour`.
  bool yields(const SurfaceSample& sample, const SurfaceSample& neighbour) const {
    return neighbour.place >= sample.place && (across_body || same_side(sample, neighbour));
  }

  double weight(double squared_distance) const {
    const double relative = std::max(std::sqrt(squared_distance), limit) / search_radius;
    const double nearness = std::max(0.0, 1.0 - relative);
    const double squared = nearness * nearness;
    return squared * squared * squared * squared;
  }
};

/// Samples that crowd each other, and the queue of their elimination.
class Crowd {
 public:
  Crowd(std::span<const SurfaceSample> samples, const std::vector<std::uint32_t>& chosen, const Crowding& crowding)
      : samples_(samples),
        chosen_(chosen),
        crowding_(crowding),
        tree_(points_of(samples, chosen)),
        alive_(chosen.size(), 1),
        weights_(chosen.size()) {
    parallel::for_each_index(chosen.size(), [&](std::size_t i) { weights_[i] = weight_of(i); });
    for (std::uint32_t i = 0; i < chosen.size(); ++i) queue_.push_back({weights_[i], i});
    std::make_heap(queue_.begin(), queue_.end(), later);
  }

  /// Removes the most crowded sample. False if no sample has a neighbour.
  bool eliminate_one() {
    for (;;) {
      std::pop_heap(queue_.begin(), queue_.end(), later);
      const Entry entry = queue_.back();
      queue_.pop_back();
      const double weight = weights_[entry.sample];
      if (weight < entry.weight) {  // neighbours were removed after it was queued
        queue_.push_back({weight, entry.sample});
        std::push_heap(queue_.begin(), queue_.end(), later);
        continue;
      }
      if (weight < kNothing) return false;
      alive_[entry.sample] = 0;
      release_neighbours(entry.sample);
      return true;
    }
  }

  std::vector<std::uint32_t> survivors() const {
    std::vector<std::uint32_t> left;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      if (alive_[i]) left.push_back(chosen_[i]);
    }
    return left;
  }

 private:
  struct Entry {
    double weight;  ///< at least the present weight of the sample
    std::uint32_t sample;
  };

  static bool later(const Entry& a, const Entry& b) {
    return a.weight != b.weight ? a.weight < b.weight : a.sample > b.sample;
  }

  static std::vector<Eigen::Vector3d> points_of(std::span<const SurfaceSample> samples,
                                                const std::vector<std::uint32_t>& chosen) {
    std::vector<Eigen::Vector3d> points;
    points.reserve(chosen.size());
    for (const std::uint32_t i : chosen) points.push_back(samples[i].point);
    return points;
  }

  const SurfaceSample& sample(std::size_t i) const { return samples_[chosen_[i]]; }

  double weight_of(std::size_t i) const {
    double sum = 0.0;
    tree_.within(sample(i).point, crowding_.search_radius, [&](std::uint32_t j, double squared_distance) {
      if (j != i && crowding_.yields(sample(i), sample(j))) sum += crowding_.weight(squared_distance);
    });
    return sum;
  }

  void release_neighbours(std::uint32_t removed) {
    tree_.within(sample(removed).point, crowding_.search_radius, [&](std::uint32_t j, double squared_distance) {
      if (alive_[j] && crowding_.yields(sample(j), sample(removed))) weights_[j] -= crowding_.weight(squared_distance);
    });
  }

  std::span<const SurfaceSample> samples_;
  const std::vector<std::uint32_t>& chosen_;
  Crowding crowding_;
  PointTree tree_;
  std::vector<std::uint8_t> alive_;
  std::vector<double> weights_;
  std::vector<Entry> queue_;
};

double extent_of(std::span<const SurfaceSample> samples, const std::vector<std::uint32_t>& chosen) {
  Box box;
  for (const std::uint32_t i : chosen) box.add(samples[i].point);
  return box.diagonal();
}

}  // namespace

double densest_disc_radius(double area, std::uint32_t count) {
  return std::sqrt(area / (2.0 * std::numbers::sqrt3 * static_cast<double>(count)));
}

std::vector<std::uint32_t> eliminate(std::span<const SurfaceSample> samples, std::vector<std::uint32_t> chosen,
                                     double area, std::uint32_t count, const parallel::Progress& progress) {
  if (chosen.size() <= count) return chosen;
  const std::size_t to_remove = chosen.size() - count;
  const double remaining_part = static_cast<double>(count) / static_cast<double>(chosen.size());
  const double limit_part = kLimitFactor * (1.0 - std::pow(remaining_part, kLimitExponent));
  std::size_t removed = 0;
  const double extent = extent_of(samples, chosen);
  // The first radius suits a surface. Samples along a needle, for example, lie farther apart. If only a few are left,
  // all on different sides, the last radius makes them crowd each other.
  for (double radius = 2.0 * densest_disc_radius(area, count); removed < to_remove; radius *= kWider) {
    Crowd crowd(samples, chosen, {radius, limit_part * radius, radius > extent});
    while (removed < to_remove && crowd.eliminate_one()) {
      ++removed;
      if (progress && removed % kReportEvery == 0)
        progress(static_cast<double>(removed) / static_cast<double>(to_remove));
    }
    chosen = crowd.survivors();
  }
  return chosen;
}

std::vector<std::uint32_t> all_indices(std::size_t count) {
  std::vector<std::uint32_t> indices(count);
  std::iota(indices.begin(), indices.end(), 0u);
  return indices;
}

std::uint32_t most_levels(std::uint32_t points) {
  const double deepest = 1.0 + std::floor(std::log(points / kCoarsest) / std::log(kLeastRefinement));
  return static_cast<std::uint32_t>(std::max(1.0, deepest));
}

std::uint32_t least_points(std::uint32_t levels) {
  return static_cast<std::uint32_t>(std::ceil(kCoarsest * std::pow(kLeastRefinement, levels - 1.0)));
}

std::vector<std::uint32_t> level_sizes(std::uint32_t points, std::uint32_t levels) {
  std::vector<std::uint32_t> sizes;
  for (std::uint32_t k = 1; k < levels; ++k) {
    const double exponent = static_cast<double>(k - 1) / static_cast<double>(levels - 1);
    sizes.push_back(static_cast<std::uint32_t>(std::lround(kCoarsest * std::pow(points / kCoarsest, exponent))));
  }
  sizes.push_back(points);
  return sizes;
}

std::vector<std::vector<std::uint32_t>> nested_levels(std::span<const SurfaceSample> samples,
                                                      const std::vector<std::uint32_t>& sizes, double area) {
  std::vector<std::vector<std::uint32_t>> levels{all_indices(samples.size())};
  for (std::size_t k = sizes.size() - 1; k > 0; --k) {
    levels.push_back(eliminate(samples, levels.back(), area, sizes[k - 1], {}));
  }
  std::reverse(levels.begin(), levels.end());
  return levels;
}

}  // namespace godobject::scene_compiler
