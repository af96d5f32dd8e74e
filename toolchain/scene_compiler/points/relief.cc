#include "toolchain/scene_compiler/points/relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

constexpr double kCoarsePerRadius = 3.5;  // coarse places over the reach
constexpr double kFineBelow = 1.75;       // coarse spacings: a fall over more is seen well enough by the coarse cloud
constexpr double kLeastCoarse = 4000.0;
constexpr double kMostCoarse = 1u << 18;
constexpr double kSharpPart = 0.25;  // of the fine spacing, along edges
constexpr std::uint32_t kMostSharp = 1u << 17;
constexpr double kMostFine = 1u << 19;
constexpr double kNearRough = 1.5;         // times the rough area is near it
constexpr double kRoughSlack = 0.8;        // a coarse cloud misses some of the fall
constexpr double kSquareRounding = 1e-12;  // of squared lengths, so that no place is left out
constexpr double kFaceCosine = 0.7;        // of a shell's sample with its triangle, if not on a round

std::vector<SurfaceSample> outer_of(const OuterSurface& outer, const std::vector<SurfaceSample>& samples) {
  const std::vector<std::uint8_t> are_outer = outer.are_outer(samples);
  std::vector<SurfaceSample> outside;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (are_outer[i] != 0) outside.push_back(samples[i]);
  }
  return outside;
}

/// Returns the inward normal of the sample's triangle. Interpolated normals would hide how far a tessellated surface
/// falls away from the planes of its facets.
Vector3d inward_at(const OuterSurface& outer, const SurfaceSample& sample) {
  const double hint = sample.on_shell ? 1.001 * outer.body().half_thickness : 1e-9 * outer.body().diagonal;
  const Vector3d& normal = outer.body().face_normals[outer.surface().closest(sample.point, hint).triangle];
  const double cosine = normal.dot(sample.inward);
  if (sample.place != SurfaceSample::Place::kFace || std::abs(cosine) < kFaceCosine) return sample.inward;
  return cosine > 0.0 ? normal : Vector3d(-normal);
}

}  // namespace

Relief::Relief(const OuterSurface& outer, const Resolution& resolution, std::uint32_t seed,
               const parallel::Progress& progress)
    : fine_below_(kFineBelow / kCoarsePerRadius * resolution.search_radius),
      fine_(resolution.fine),
      coarse_({}),
      all_({}) {
  const double coarse = std::clamp(resolution.search_radius / kCoarsePerRadius, std::sqrt(outer.area() / kMostCoarse),
                                   std::sqrt(outer.area() / kLeastCoarse));
  const std::vector<SurfaceSample> drawn = outer.draw_near(coarse, seed, [](const Vector3d&, double) { return true; });
  std::vector<SurfaceSample> even = outer_of(outer, drawn);
  area_ = outer.area() * static_cast<double>(even.size()) / static_cast<double>(std::max<std::size_t>(drawn.size(), 1));
  evenly_spread_ = even.size();
  if (progress) progress(0.3);
  const std::vector<SurfaceSample> sharp = outer.sharp_samples(kSharpPart * resolution.fine, kMostSharp);
  even.insert(even.end(), sharp.begin(), sharp.end());
  coarse_ = add(outer, even);
  all_ = add(outer, fine_places(outer, resolution, seed, parallel::part_of(progress, 0.3, 1.0)));
}

PointTree Relief::add(const OuterSurface& outer, std::span<const SurfaceSample> samples) {
  const std::size_t first = places_.size();
  places_.insert(places_.end(), samples.begin(), samples.end());
  inward_.resize(places_.size());
  parallel::for_each_index(samples.size(), [&](std::size_t i) { inward_[first + i] = inward_at(outer, samples[i]); });
  std::vector<Vector3d> points;
  points.reserve(places_.size());
  for (const SurfaceSample& place : places_) points.push_back(place.point);
  return PointTree(points);
}

std::vector<SurfaceSample> Relief::fine_places(const OuterSurface& outer, const Resolution& resolution,
                                               std::uint32_t seed, const parallel::Progress& progress) {
  std::vector<std::uint8_t> is_rough(places_.size());
  parallel::for_each_index(places_.size(), [&](std::size_t i) {
    is_rough[i] = falls(i, fine_below_, {kRoughSlack * resolution.fall, resolution.fall + fine_below_}) ? 1 : 0;
  });
  std::vector<Vector3d> rough_points;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (is_rough[i] != 0) rough_points.push_back(places_[i].point);
  }
  const auto rough_part = static_cast<double>(std::count(
                              is_rough.begin(), is_rough.begin() + static_cast<std::ptrdiff_t>(evenly_spread_), 1)) /
                          static_cast<double>(evenly_spread_);
  fine_ = std::max(fine_, std::sqrt(std::min(1.0, kNearRough * rough_part) * area_ / kMostFine));
  const PointTree rough(rough_points);
  const double near = 2.0 * fine_below_ / kFineBelow;  // random places leave holes
  const auto is_near = [&](const Vector3d& center, double radius) {
    return rough.nearest(center, near + radius, [](std::uint32_t) { return true; }).index != PointTree::kNone;
  };
  const std::vector<SurfaceSample> drawn = outer.draw_near(fine_, seed, is_near);
  if (progress) progress(0.5);
  std::vector<SurfaceSample> fine = outer_of(outer, drawn);
  if (progress) progress(1.0);
  return fine;
}

bool Relief::may_fall(std::size_t i, const Vector3d& low, const Vector3d& high, double depth, double radius) const {
  const Vector3d half = 0.5 * (high - low);
  const Vector3d center = low + half - places_[i].point;
  const double center_depth = center.dot(inward_[i]);
  if (center_depth + half.dot(inward_[i].cwiseAbs()) <= depth) return false;
  const double reach = radius + half.norm();
  return (1.0 - kSquareRounding) * center.squaredNorm() - center_depth * center_depth <= reach * reach;
}

bool Relief::falls(std::size_t i, double radius, const Fall& fall) const {
  const SurfaceSample& place = places_[i];
  const auto falls_in = [&](const PointTree& tree, double within) {
    bool found = false;
    const auto skip = [&](const Vector3d& low, const Vector3d& high) {
      return found || !may_fall(i, low, high, fall.depth, within);
    };
    // a search finds a steep wall on its way down: surface far below the plane is not looked up
    tree.within(place.point, std::hypot(within, fall.seen), skip, [&](std::uint32_t j, double squared_distance) {
      const double depth = depth_below(i, places_[j].point);
      if (found || depth <= fall.depth || squared_distance - depth * depth > within * within) return;
      found = same_side(place, places_[j]);
    });
    return found;
  };
  return falls_in(coarse_, radius) || falls_in(all_, std::min(radius, fine_below_));
}

double Relief::level_radius(std::size_t i, const Fall& fall, double limit) const {
  const SurfaceSample& place = places_[i];
  const auto radius_in = [&](const PointTree& tree, double most) {
    const double furthest = std::hypot(most, fall.seen);
    const auto skip = [&](const Vector3d& low, const Vector3d& high) {
      if (!may_fall(i, low, high, fall.depth, most)) return true;
      const Vector3d& at = place.point;
      const double looked_at = std::hypot(most, fall.seen);
      return (low - at).cwiseMax(at - high).cwiseMax(0.0).squaredNorm() >= looked_at * looked_at;
    };
    tree.within(place.point, furthest, skip, [&](std::uint32_t j, double squared_distance) {
      const double depth = depth_below(i, places_[j].point);
      if (depth <= fall.depth || squared_distance - depth * depth >= most * most) return;
      if (same_side(place, places_[j])) most = std::sqrt(std::max(0.0, squared_distance - depth * depth));
    });
    return most;
  };
  const double seen = radius_in(coarse_, limit);
  const double near = std::min(seen, fine_below_);
  const double fine = radius_in(all_, near);
  return fine < near ? fine : seen;
}

}  // namespace godobject::scene_compiler
