#include "toolchain/scene_compiler/points/moving_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/mass_properties.h"
#include "toolchain/scene_compiler/mesh/outer_surface.h"
#include "toolchain/scene_compiler/points/bounding_sphere.h"
#include "toolchain/scene_compiler/points/point_tree.h"
#include "toolchain/scene_compiler/points/sample_elimination.h"
#include "toolchain/scene_compiler/points/sphere_tree.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kCandidatesPerPoint = 6;
constexpr std::uint32_t kLeastCandidates = 1000;
constexpr double kEdgeCandidates = 4.0;  // per distance between points
constexpr std::uint32_t kCandidateSeed = 1;
constexpr std::uint32_t kProbeSeed = 2;
constexpr std::uint32_t kLeastProbes = 20000;
constexpr std::uint32_t kMostProbes = 1u << 20;
constexpr std::size_t kProbeBlock = 256;

void check_arguments(std::uint32_t points, std::uint32_t levels) {
  if (points < 1 || points > format::kMaxPoints) {
    throw command::Failure(
        command::ExitCode::kBadConfig,
        fmt::format("moving.points = {} is out of range; set it to 1 .. {}", points, format::kMaxPoints));
  }
  if (levels < 1 || levels > format::kMaxLevels) {
    throw command::Failure(
        command::ExitCode::kBadConfig,
        fmt::format("moving.levels = {} is out of range; set it to 1 .. {}", levels, format::kMaxLevels));
  }
  const std::uint32_t deepest = most_levels(points);
  if (levels > deepest) {
    throw command::Failure(
        command::ExitCode::kBadConfig,
        fmt::format("moving.levels = {} is too large for {} points; set levels to {} or less, or points to {} or more",
                    levels, points, deepest, least_points(levels)));
  }
}

double median_neighbour_distance(const std::vector<SurfaceSample>& samples, const PointTree& tree) {
  std::vector<double> squared(samples.size());
  parallel::for_each_index(samples.size(), [&](std::size_t i) {
    const auto other = [&](std::uint32_t j) { return j != i && same_side(samples[i], samples[j]); };
    squared[i] = tree.nearest(samples[i].point, other).squared_distance;
  });
  std::erase_if(squared, [](double s) { return !std::isfinite(s); });  // alone on its side
  if (squared.empty()) return 0.0;
  const auto middle = squared.begin() + static_cast<std::ptrdiff_t>(squared.size() / 2);
  std::nth_element(squared.begin(), middle, squared.end());
  return std::sqrt(*middle);
}

/// Sets the body's frame, inertia and volume from the mass of the enclosed volume, or else of the points. Returns the
/// pose of the body frame.
Eigen::Isometry3d set_mass(const BodyMesh& mesh, const std::vector<Vector3d>& points, format::Body& body) {
  MassMoments moments;
  if (mesh.encloses_volume()) moments = moments_of_volume(mesh.mesh);
  const bool from_points = moments.volume == 0.0;
  if (from_points) moments = moments_of_points(points);
  const PrincipalAxes principal = principal_axes(moments.inertia);

  Eigen::Quaterniond rotation(principal.rotation_MB);
  rotation.normalize();
  if (rotation.w() < 0.0) rotation.coeffs() = -rotation.coeffs();
  const Eigen::Vector4d wxyz(rotation.w(), rotation.x(), rotation.y(), rotation.z());
  std::copy_n(wxyz.data(), 4, body.rotation_MB);
  std::copy_n(moments.center.data(), 3, body.translation_MB);
  std::copy_n(principal.moments.data(), 3, body.inertia);
  body.volume = moments.volume;
  body.inertia_from_points = from_points ? 1 : 0;

  return body_pose(body);
}

}  // namespace

Eigen::Isometry3d body_pose(const format::Body& body) {
  const double* q = body.rotation_MB;
  Eigen::Isometry3d X_MB = Eigen::Isometry3d::Identity();
  X_MB.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  X_MB.translation() = Eigen::Map<const Vector3d>(body.translation_MB);
  return X_MB;
}

MovingSampling sample_moving_body(const OuterSurface& outer, std::uint32_t points, std::uint32_t levels,
                                  const parallel::Progress& progress) {
  check_arguments(points, levels);
  OuterSurface::Spread spread = outer.spread(std::max(kCandidatesPerPoint * points, kLeastCandidates), kCandidateSeed,
                                             parallel::part_of(progress, 0.0, 0.4));
  std::vector<SurfaceSample>& candidates = spread.samples;
  const auto most_sharp = static_cast<std::uint32_t>(candidates.size());
  const double distance = 2.0 * densest_disc_radius(spread.area, points);
  const std::vector<SurfaceSample> sharp = outer.sharp_samples(distance / kEdgeCandidates, most_sharp);
  candidates.insert(candidates.end(), sharp.begin(), sharp.end());

  MovingSampling sampling{{}, points, levels, spread.area};
  for (const std::uint32_t i : eliminate(candidates, all_indices(candidates.size()), spread.area, points,
                                         parallel::part_of(progress, 0.4, 1.0))) {
    sampling.samples.push_back(candidates[i]);
  }
  if (progress) progress(1.0);
  return sampling;
}

/// Tests the probes farthest from any sample first: the first one that is not buried decides.
double largest_gap(const OuterSurface& outer, std::span<const SurfaceSample> samples) {
  const PointTree tree(points_of(samples));
  const auto count = std::clamp(static_cast<std::uint32_t>(4 * samples.size()), kLeastProbes, kMostProbes);
  const std::vector<SurfaceSample> probes = outer.draw_all(count, kProbeSeed);
  std::vector<std::pair<double, std::uint32_t>> far_first(probes.size());
  parallel::for_each_index(probes.size(), [&](std::size_t i) {
    far_first[i] = {-tree.nearest(probes[i].point).squared_distance, static_cast<std::uint32_t>(i)};
  });
  std::sort(far_first.begin(), far_first.end());
  for (std::size_t begin = 0; begin < far_first.size(); begin += kProbeBlock) {
    std::vector<SurfaceSample> block;
    for (std::size_t i = begin; i < std::min(begin + kProbeBlock, far_first.size()); ++i) {
      block.push_back(probes[far_first[i].second]);
    }
    const std::vector<std::uint8_t> are_outer = outer.are_outer(block);
    const auto found = std::find(are_outer.begin(), are_outer.end(), 1);
    if (found != are_outer.end()) {
      return std::sqrt(-far_first[begin + static_cast<std::size_t>(found - are_outer.begin())].first);
    }
  }
  return 0.0;
}

MovingBody make_moving_body(const OuterSurface& outer, const MovingSampling& sampling,
                            std::span<const Vector3d> others) {
  const std::span<const SurfaceSample> spread = std::span(sampling.samples).first(sampling.points);
  std::vector<std::vector<std::uint32_t>> levels =
      nested_levels(spread, level_sizes(sampling.points, sampling.levels), sampling.area);
  levels.back() = all_indices(sampling.samples.size());

  MovingBody moving;
  format::Body& body = moving.body;
  // added samples crowd at edges, so they have no mass
  const Eigen::Isometry3d X_BM = set_mass(outer.body(), points_of(spread), body).inverse();
  std::vector<Eigen::Vector3f> points_B;
  std::vector<Eigen::Vector3f> normals_B;
  double radius = kLeastPointRadius;
  for (const SurfaceSample& sample : sampling.samples) {
    points_B.push_back((X_BM * sample.point).cast<float>());
    normals_B.push_back((X_BM.linear() * sample.inward).cast<float>());
    radius = std::max(radius, points_B.back().cast<double>().norm());
  }
  SphereTree tree = build_sphere_tree(points_B, levels);
  moving.points = by_axis(points_B, tree.order);
  moving.normals = by_axis(normals_B, tree.order);
  moving.nodes = std::move(tree.nodes);
  constexpr double kRoundedUp = 1.0 + 1e-12;
  constexpr double kLeastSphere = 0.25;  // of R_max
  body.radius = radius * kRoundedUp;
  std::vector<Vector3d> stored_B;
  for (const Eigen::Vector3f& p : points_B) stored_B.push_back(p.cast<double>());
  for (const Vector3d& p : others) stored_B.push_back(X_BM * p);
  const Sphere sphere = bounding_sphere(stored_B);
  std::copy_n(sphere.center.data(), 3, body.sphere_center);
  // The sphere must not be so small that points of the still body seem to swing far about a few clustered samples.
  body.sphere_radius = std::max(sphere.radius * kRoundedUp, kLeastSphere * body.radius);
  body.point_count = static_cast<std::uint32_t>(sampling.samples.size());
  body.node_count = static_cast<std::uint32_t>(moving.nodes.size());
  body.level_count = sampling.levels;
  return moving;
}

PointSpread measure_spread(const OuterSurface& outer, const MovingSampling& sampling) {
  PointSpread spread;
  spread.level_sizes = level_sizes(sampling.points, sampling.levels);
  spread.level_sizes.back() = static_cast<std::uint32_t>(sampling.samples.size());
  spread.spacing = median_neighbour_distance(sampling.samples, PointTree(points_of(sampling.samples)));
  spread.coverage = largest_gap(outer, sampling.samples);
  return spread;
}

}  // namespace godobject::scene_compiler
