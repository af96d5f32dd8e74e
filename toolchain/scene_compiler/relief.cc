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
constexpr double kSharpPart = 0.5;  // of the fine spacing, along edges
constexpr std::uint32_t kMostSharp = 1u << 17;
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
  const std::vector<SurfaceSample> sharp = outer.sharp_samples(kSharpPart * resolution.fine, kMostSharp);
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
  const auto is_near = [&](const Vector3d& center, double radius) {
    return rough.nearest(center, near + radius, [](std::uint32_t) { return true; }).index != PointTree::kNone;
  };
  const std::vector<SurfaceSample> drawn = outer.draw_near(resolution.fine, seed, is_near);
  if (progress) progress(0.5);
  const std::vector<std::uint8_t> are_outer = outer.are_outer(drawn);
  std::vector<SurfaceSample> fine;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (are_outer[i] != 0) fine.push_back(drawn[i]);
  }
  if (progress) progress(1.0);
  return fine;
}

double Relief::lowest(std::size_t i, const Vector3d& low, const Vector3d& high) const {
  return depth_below(i, 0.5 * (low + high)) + 0.5 * (high - low).dot(inward_[i].cwiseAbs());
}

double Relief::fall(std::size_t i, double radius) const {
  const SurfaceSample& place = places_[i];
  double deepest = 0.0;
  const auto above = [&](const Vector3d& low, const Vector3d& high) { return lowest(i, low, high) <= deepest; };
  tree(radius).within(place.point, std::numbers::sqrt2 * radius, above, [&](std::uint32_t j, double squared_distance) {
    const double depth = depth_below(i, places_[j].point);
    if (depth <= deepest || squared_distance - depth * depth > radius * radius) return;
    if (same_side(place, places_[j])) deepest = depth;
  });
  return std::min(deepest, radius);
}

double Relief::level_radius(std::size_t i, double fall, double limit) const {
  const SurfaceSample& place = places_[i];
  const auto radius_in = [&](const PointTree& tree, double most) {
    const auto above = [&](const Vector3d& low, const Vector3d& high) {
      if (lowest(i, low, high) <= fall) return true;
      const Vector3d& at = place.point;
      return (low - at).cwiseMax(at - high).cwiseMax(0.0).squaredNorm() >= 2.0 * most * most;
    };
    tree.within(place.point, std::numbers::sqrt2 * most, above, [&](std::uint32_t j, double squared_distance) {
      const double depth = depth_below(i, places_[j].point);
      if (depth <= fall || squared_distance >= 2.0 * most * most) return;
      const double radius = std::sqrt(std::max(squared_distance - depth * depth, 0.5 * squared_distance));
      if (radius < most && same_side(place, places_[j])) most = radius;
    });
    return most;
  };
  const double seen = radius_in(coarse_, limit);
  const double near = std::min(seen, fine_below_);
  const double fine = radius_in(all_, near);
  return std::clamp(fine < near ? fine : seen, std::min(fall, limit), limit);
}

}  // namespace godobject::scene_compiler
