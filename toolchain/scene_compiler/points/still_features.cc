#include "toolchain/scene_compiler/points/still_features.h"

#include <algorithm>
#include <cmath>

#include "toolchain/scene_compiler/points/bounding_sphere.h"
#include "toolchain/scene_compiler/points/sample_elimination.h"
#include "toolchain/scene_compiler/points/sphere_tree.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using Place = SurfaceSample::Place;

constexpr double kGrowth = 3.0;  // of a level over the one before it

std::uint32_t levels_for(std::uint32_t points) {
  const double levels = 1.0 + std::round(std::log(static_cast<double>(points)) / std::log(kGrowth)) - 2.0;
  const auto wanted = static_cast<std::uint32_t>(std::max(1.0, levels));
  return std::min({wanted, most_levels(points), format::kMaxLevels});
}

std::uint32_t count_on(std::span<const SurfaceSample> samples, Place place) {
  const auto at_place = [place](const SurfaceSample& sample) { return sample.place == place; };
  return static_cast<std::uint32_t>(std::count_if(samples.begin(), samples.end(), at_place));
}

}  // namespace

StillFeatures make_still_features(std::span<const SurfaceSample> chosen, double area) {
  StillFeatures features;
  if (chosen.empty()) return features;
  const std::vector<Vector3d> points_W = points_of(chosen);
  const Vector3d origin = bounding_sphere(points_W).center;
  std::vector<Eigen::Vector3f> points_F;
  double radius = kLeastPointRadius;
  for (const Vector3d& point : points_W) {
    points_F.push_back((point - origin).cast<float>());
    radius = std::max(radius, points_F.back().cast<double>().norm());
  }

  format::Features& header = features.header;
  std::copy_n(origin.data(), 3, header.origin);
  header.radius = radius * (1.0 + 1e-12);
  header.point_count = static_cast<std::uint32_t>(chosen.size());
  header.level_count = levels_for(header.point_count);
  const SphereTree tree =
      build_sphere_tree(points_F, nested_levels(chosen, level_sizes(header.point_count, header.level_count), area));
  features.points = by_axis(points_F, tree.order);
  features.nodes = tree.nodes;
  header.node_count = static_cast<std::uint32_t>(features.nodes.size());
  features.corners = count_on(chosen, Place::kVertex);
  features.on_edges = count_on(chosen, Place::kEdge);
  features.on_faces = count_on(chosen, Place::kFace);
  return features;
}

}  // namespace godobject::scene_compiler
