#include "toolchain/scene_compiler/relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

constexpr double kCoarsePerReach = 5.0;  // coarse places over the reach
constexpr double kFineBelow = 2.5;       // coarse spacings: a fall over more is seen well enough by the coarse cloud
constexpr std::uint32_t kLeastCoarse = 4000;
constexpr std::uint32_t kMostCoarse = 1u << 18;
constexpr std::uint64_t kMostFine = 1u << 19;  // draws, most of which are not near rough places
constexpr std::uint32_t kMostSharp = 1u << 17;
constexpr std::uint32_t kBlock = 1u << 16;
constexpr double kRoughSlack = 0.8;  // a coarse cloud misses some of the fall
constexpr double kFaceCosine = 0.7;  // of a shell's sample with its triangle, if not on a round

std::uint32_t draws_for(double area, double spacing, std::uint64_t most) {
  const double count = std::ceil(area / (spacing * spacing));
  return static_cast<std::uint32_t>(std::min(count, static_cast<double>(most)));
}

/// Interpolated normals would hide how far a tessellated surface falls away from its facets' planes.
Vector3d inward_at(const OuterSurface& outer, const SurfaceSample& sample) {
  const double hint = sample.on_shell ? 1.001 * outer.body().half_thickness : 1e-9 * outer.body().diagonal;
  const Vector3d& normal = outer.body().face_normals[outer.surface().closest(sample.point, hint).triangle];
  const double cosine = normal.dot(sample.inward);
  if (sample.place != SurfaceSample::Place::kFace || std::abs(cosine) < kFaceCosine) return sample.inward;
  return cosine > 0.0 ? normal : Vector3d(-normal);
}

}  // namespace

Relief::Relief(const OuterSurface& outer, const Resolution& resolution, std::uint32_t seed, const Progress& progress)
    : fine_below_(kFineBelow / kCoarsePerReach * resolution.reach), coarse_({}), all_({}) {
  const double coarse = resolution.reach / kCoarsePerReach;
  const std::uint32_t wanted = std::max(draws_for(outer.area(), coarse, kMostCoarse), kLeastCoarse);
  OuterSurface::Spread spread = outer.spread(wanted, seed, part_of(progress, 0.0, 0.3));
  area_ = spread.area;
  const std::vector<SurfaceSample> sharp = outer.sharp_samples(resolution.fine, kMostSharp);
  spread.samples.insert(spread.samples.end(), sharp.begin(), sharp.end());
  coarse_ = add(outer, spread.samples);
  all_ = coarse_;
  all_ = add(outer, fine_places(outer, resolution, seed, part_of(progress, 0.3, 1.0)));
}

PointTree Relief::add(const OuterSurface& outer, std::span<const SurfaceSample> samples) {
  const std::size_t first = places_.size();
  places_.insert(places_.end(), samples.begin(), samples.end());
  inward_.resize(places_.size());
  parallel_for(samples.size(), [&](std::size_t i) { inward_[first + i] = inward_at(outer, samples[i]); });
  std::vector<Vector3d> points;
  points.reserve(places_.size());
  for (const SurfaceSample& place : places_) points.push_back(place.point);
  return PointTree(points);
}

std::vector<SurfaceSample> Relief::fine_places(const OuterSurface& outer, const Resolution& resolution,
                                               std::uint32_t seed, const Progress& progress) const {
  std::vector<std::uint8_t> is_rough(places_.size());
  parallel_for(places_.size(), [&](std::size_t i) {
    is_rough[i] = level_radius(i, kRoughSlack * resolution.fall, fine_below_) < fine_below_ ? 1 : 0;
  });
  std::vector<Vector3d> rough_points;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (is_rough[i] != 0) rough_points.push_back(places_[i].point);
  }
  const PointTree rough(rough_points);
  const double near = 2.0 * fine_below_ / kFineBelow;  // random places leave holes
  std::vector<SurfaceSample> fine;
  const std::uint32_t draws = draws_for(outer.area(), resolution.fine, kMostFine);
  const std::uint32_t blocks = draws / kBlock + 1;
  for (std::uint32_t block = 0; block < blocks; ++block) {
    const std::vector<SurfaceSample> drawn = outer.draw_all(draws / blocks, (seed << 8) + 1 + block);
    std::vector<std::uint8_t> kept(drawn.size());
    parallel_for(drawn.size(), [&](std::size_t i) {
      kept[i] = rough.nearest(drawn[i].point).squared_distance < near * near ? 1 : 0;
    });
    std::vector<SurfaceSample> candidates;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (kept[i] != 0) candidates.push_back(drawn[i]);
    }
    const std::vector<std::uint8_t> are_outer = outer.are_outer(candidates);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (are_outer[i] != 0) fine.push_back(candidates[i]);
    }
    if (progress) progress(static_cast<double>(block + 1) / blocks);
  }
  return fine;
}

double Relief::fall(std::size_t i, double radius) const {
  const SurfaceSample& place = places_[i];
  double deepest = 0.0;
  tree(radius).within(place.point, std::numbers::sqrt2 * radius, [&](std::uint32_t j, double squared_distance) {
    const double depth = (places_[j].point - place.point).dot(inward_[i]);
    if (depth <= deepest || squared_distance - depth * depth > radius * radius) return;
    if (same_side(place, places_[j])) deepest = depth;
  });
  return std::min(deepest, radius);
}

double Relief::level_radius(std::size_t i, double fall, double limit) const {
  const SurfaceSample& place = places_[i];
  const auto radius_in = [&](const PointTree& tree, double most) {
    const auto depth = [&](std::uint32_t j) { return (places_[j].point - place.point).dot(inward_[i]); };
    const auto falls = [&](std::uint32_t j) { return depth(j) > fall && same_side(place, places_[j]); };
    const PointTree::Nearest found = tree.nearest(place.point, std::hypot(most, 2.0 * fall), falls);
    if (found.index == PointTree::kNone) return most;
    const double below = depth(found.index);
    return std::min(most, std::sqrt(std::max(0.0, found.squared_distance - below * below)));
  };
  const double seen = radius_in(coarse_, limit);
  return seen < fine_below_ ? radius_in(all_, seen) : seen;
}

}  // namespace godobject::scene_compiler
