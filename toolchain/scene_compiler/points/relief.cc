#include "toolchain/scene_compiler/points/relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "toolchain/scene_compiler/mesh/box.h"

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
constexpr double kNearRough = 1.5;          // times the rough area is near it
constexpr double kRoughSlack = 0.8;         // a coarse cloud misses some of the fall
constexpr double kSquareRounding = 1e-12;   // of squared lengths, so that no place is left out
constexpr int kFaces = 4;                   // groups of similar normals among them
constexpr double kSimilar = 0.5;            // difference of similar normals
constexpr std::uint32_t kPlacesOfRun = 32;  // places that are asked about together
constexpr double kFaceCosine = 0.7;         // of a shell's sample with its triangle, if not on a round

/// False if same_side is false for all samples whose normals have at most this product.
bool may_share_side(double most) { return most > -0.5 - kSquareRounding; }

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
  const Fall rough_fall{kRoughSlack * resolution.fall, resolution.fall + fine_below_};
  for_each_run(coarse_, [&](const Run& run) {
    Vicinity vicinity(*this, run, fine_below_, rough_fall);
    for (const std::uint32_t i : run) is_rough[i] = vicinity.falls(i, fine_below_) ? 1 : 0;
  });
  std::vector<Vector3d> rough_points;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (is_rough[i] != 0) rough_points.push_back(places_[i].point);
  }
  const auto rough_part = static_cast<double>(std::count(
                              is_rough.begin(), is_rough.begin() + static_cast<std::ptrdiff_t>(evenly_spread_), 1)) /
                          static_cast<double>(evenly_spread_);
  fine_ = std::max(fine_, std::sqrt(std::min(1.0, kNearRough * rough_part) * area_ / kMostFine));
  const PointTree rough_places(rough_points);
  const double near = 2.0 * fine_below_ / kFineBelow;  // random places leave holes
  const auto is_near = [&](const Vector3d& center, double radius) {
    return rough_places.any_within(center, near + radius);
  };
  const std::vector<SurfaceSample> drawn = outer.draw_near(fine_, seed, is_near);
  if (progress) progress(0.5);
  std::vector<SurfaceSample> fine = outer_of(outer, drawn);
  if (progress) progress(1.0);
  return fine;
}

bool Relief::may_fall(std::size_t i, const PointTree::Bounds& box, double depth, double radius) const {
  const Vector3d half = 0.5 * (box.high - box.low);
  const Vector3d center = box.low + half - places_[i].point;
  const double center_depth = center.dot(inward_[i]);
  if (center_depth + half.dot(inward_[i].cwiseAbs()) <= depth) return false;
  const double reach = radius + box.half_diagonal;
  return (1.0 - kSquareRounding) * center.squaredNorm() - center_depth * center_depth <= reach * reach;
}

void Relief::for_each_run(const PointTree& tree, const std::function<void(const Run&)>& work) const {
  const std::vector<PointTree::Run> runs = tree.runs(kPlacesOfRun);
  parallel::for_each_index(runs.size(), [&](std::size_t r) {
    std::array<std::uint32_t, kPlacesOfRun> places;
    std::size_t count = 0;
    for (std::uint32_t entry = runs[r].begin; entry < runs[r].end; ++entry) places[count++] = tree.index(entry);
    const auto end = places.begin() + static_cast<std::ptrdiff_t>(count);
    auto begin = places.begin();
    for (int faces = 1; begin != end; ++faces) {  // such as those of a thin plate
      const Vector3d& normal = inward_[*begin];
      const auto next = faces == kFaces ? end : std::partition(begin, end, [&](std::uint32_t i) {
        return (inward_[i] - normal).squaredNorm() <= kSimilar * kSimilar;
      });
      work(Run(begin, next));
      begin = next;
    }
  });
}

bool Relief::falls(std::size_t i, double radius, const Fall& fall) const {
  const SurfaceSample& place = places_[i];
  const auto falls_in = [&](const PointTree& tree, double within) {
    bool found = false;
    const auto skip = [&](const PointTree::Bounds& box) { return found || !may_fall(i, box, fall.depth, within); };
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

Relief::Vicinity::Vicinity(const Relief& relief, const Run& places, double radius, const Fall& fall)
    : relief_(relief), fall_(fall) {
  const Bounds bounds = bounds_of(places);
  coarse_ = near(relief.coarse_, bounds, radius);
  all_ = near(relief.all_, bounds, std::min(radius, relief.fine_below_));
}

Relief::Vicinity::Bounds Relief::Vicinity::bounds_of(const Run& places) const {
  Box box;
  Vector3d inward = Vector3d::Zero();
  Vector3d side = Vector3d::Zero();
  for (const std::uint32_t i : places) {
    box.add(relief_.places_[i].point);
    inward += relief_.inward_[i];
    side += relief_.places_[i].inward;
  }
  Bounds bounds{0.5 * (box.low + box.high), 0.0, inward.normalized(), 0.0, 0.0, side.normalized(), 0.0};
  for (const std::uint32_t i : places) {
    const Vector3d from = bounds.center - relief_.places_[i].point;
    bounds.radius = std::max(bounds.radius, from.norm());
    bounds.turned = std::max(bounds.turned, (relief_.inward_[i] - bounds.inward).norm());
    bounds.above = std::max(bounds.above, from.dot(relief_.inward_[i]));
    bounds.side_turned = std::max(bounds.side_turned, (relief_.places_[i].inward - bounds.side).norm());
  }
  return bounds;
}

/// Leaves out what is too far from every place, not below the plane of any, or too far aside of all normals. Turning a
/// normal by `turned` changes depths and distances from it by as much times the distance.
Relief::Vicinity::Cloud Relief::Vicinity::near(const PointTree& tree, const Bounds& places, double radius) const {
  const double furthest = (std::hypot(radius, fall_.seen) + places.radius) * (1.0 + kSquareRounding);
  const Vector3d across = places.inward.cwiseAbs();
  const auto skip = [&](const PointTree::Bounds& box) {
    const Vector3d half = 0.5 * (box.high - box.low);
    const Vector3d middle = box.low + half - places.center;
    if ((middle.cwiseAbs() - half).cwiseMax(0.0).squaredNorm() > furthest * furthest) return true;
    const double size = box.half_diagonal;
    const double turned = (places.turned + kSquareRounding) * std::min(middle.norm() + size, furthest);
    const double depth = middle.dot(places.inward);
    if (depth + half.dot(across) + turned + places.above <= fall_.depth) return true;
    const double reach = radius + places.radius + size + turned;
    return (1.0 - kSquareRounding) * middle.squaredNorm() - depth * depth > reach * reach;
  };
  Cloud cloud;
  tree.leaves(skip, [&](const PointTree::Run& run) { add(tree, run, places, radius, cloud); });
  return cloud;
}

/// Adds the points of a leaf that `near` does not leave out and that may be on the side of a place.
void Relief::Vicinity::add(const PointTree& tree, const PointTree::Run& run, const Bounds& places, double radius,
                           Cloud& cloud) const {
  Box box;
  const auto begin = static_cast<std::uint32_t>(cloud.candidates.size());
  for (std::uint32_t entry = run.begin; entry < run.end; ++entry) {
    const Vector3d from = tree.point(entry) - places.center;
    const double turned = (places.turned + kSquareRounding) * from.norm();
    const double depth = from.dot(places.inward);
    if (depth + turned + places.above <= fall_.depth) continue;
    const double reach = radius + places.radius + turned;
    if ((1.0 - kSquareRounding) * from.squaredNorm() - depth * depth > reach * reach) continue;
    const std::uint32_t place = tree.index(entry);
    if (!may_share_side(relief_.places_[place].inward.dot(places.side) + places.side_turned)) continue;
    box.add(tree.point(entry));
    cloud.candidates.push_back({tree.point(entry), place});
  }
  const auto end = static_cast<std::uint32_t>(cloud.candidates.size());
  if (end > begin) cloud.parts.push_back({{box, 0.5 * box.diagonal()}, begin, end});
}

bool Relief::Vicinity::falls(std::size_t place, double radius) {
  return falls_in(coarse_, place, radius) || falls_in(all_, place, std::min(radius, relief_.fine_below_));
}

bool Relief::Vicinity::falls_in(Cloud& cloud, std::size_t i, double radius) const {
  const double furthest = std::hypot(radius, fall_.seen);
  for (Part& part : cloud.parts) {
    if (!relief_.may_fall(i, part.box, fall_.depth, radius)) continue;
    for (std::uint32_t k = part.begin; k < part.end; ++k) {
      if (!shows_fall(i, cloud.candidates[k], radius, furthest)) continue;
      std::swap(part, cloud.parts.front());  // the next place finds it soon
      return true;
    }
  }
  return false;
}

/// The conditions of Relief::falls.
bool Relief::Vicinity::shows_fall(std::size_t i, const Candidate& candidate, double radius, double furthest) const {
  const SurfaceSample& place = relief_.places_[i];
  const Vector3d from = candidate.point - place.point;
  const double depth = from.dot(relief_.inward_[i]);
  if (depth <= fall_.depth) return false;
  const double squared_distance = from.squaredNorm();
  if (squared_distance > furthest * furthest || squared_distance - depth * depth > radius * radius) return false;
  return same_side(place, relief_.places_[candidate.place]);
}

double Relief::level_radius(std::size_t i, const Fall& fall, double limit) const {
  const SurfaceSample& place = places_[i];
  const auto radius_in = [&](const PointTree& tree, double most) {
    double squared_reach = most * most + fall.seen * fall.seen;
    const auto skip = [&](const PointTree::Bounds& box) {
      return box.squared_distance(place.point) >= squared_reach || !may_fall(i, box, fall.depth, most);
    };
    tree.within(place.point, std::sqrt(squared_reach), skip, [&](std::uint32_t j, double squared_distance) {
      const double depth = depth_below(i, places_[j].point);
      if (depth <= fall.depth || squared_distance - depth * depth >= most * most) return;
      if (!same_side(place, places_[j])) return;
      most = std::sqrt(std::max(0.0, squared_distance - depth * depth));
      squared_reach = most * most + fall.seen * fall.seen;
    });
    return most;
  };
  const double seen = radius_in(coarse_, limit);
  const double near = std::min(seen, fine_below_);
  const double fine = radius_in(all_, near);
  return fine < near ? fine : seen;
}

}  // namespace godobject::scene_compiler
