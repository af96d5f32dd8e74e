#include "toolchain/scene_compiler/mesh/thin_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "toolchain/scene_compiler/mesh/voxel_too_large.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

constexpr double kSpacing = 0.5;      // of samples [voxels]: a patch of one voxel face has four samples on either side
constexpr double kMostSamples = 2e6;  // chosen: bounds time and memory
/// [voxels] reported: the field stores a depth of at most 0.6 voxels in a wall of two.
constexpr double kThin = 2.0;
constexpr double kLost = 1.0;                // [voxels] lost: a thinner wall may have no node of the grid inside
constexpr double kThicknessRounding = 1e-4;  // relative: a plate of exactly two voxels is not thinner
constexpr double kFacing = -0.9;  // cosine between the normals of two faces that make a wall: within 26 degrees
/// Cosine between the normals of near-parallel faces: within 10 degrees; others are wedges.
constexpr double kParallel = -0.985;

struct Sample {
  Vector3d point;
  Vector3d normal;  // outward
  bool shell;
};

struct Thin {
  double thickness;
  Vector3d middle;
  bool parallel;
};

struct Samples {
  std::vector<Sample> all;
  double area = 0.0;  // of each sample
};

/// Returns samples spread evenly by area. Every stretch of `area` along the cumulated triangles gets one, at its own
/// place within the triangle.
Samples sample(const SolidSurface& surface, double voxel_size) {
  const TriangleMesh& mesh = surface.mesh();
  double total = 0.0;
  std::vector<Vector3d> areas;
  for (const auto& t : mesh.triangles) {
    areas.push_back(0.5 * (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]));
    total += areas.back().norm();
  }
  Samples samples;
  samples.area = std::max(kSpacing * kSpacing * voxel_size * voxel_size, total / kMostSamples);
  double cumulated = 0.0;
  double next = 0.5 * samples.area;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const SolidSurface::Component& component = surface.components()[surface.component_of_triangle()[i]];
    const Vector3d normal = areas[i].normalized() * (component.inside_out ? -1.0 : 1.0);
    cumulated += areas[i].norm();
    while (next < cumulated) {
      next += samples.area;
      const auto k = static_cast<double>(samples.all.size());
      double u = std::fmod(0.5 + 0.7548776662466927 * k, 1.0);
      double v = std::fmod(0.5 + 0.5698402909980532 * k, 1.0);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      const Vector3d& a = mesh.vertices[t[0]];
      samples.all.push_back(
          {a + u * (mesh.vertices[t[1]] - a) + v * (mesh.vertices[t[2]] - a), normal, component.shell});
    }
  }
  return samples;
}

/// Returns the first facing triangle of a solid along the sample's normal behind which the side changes, within the
/// search radius. `wall` looks inward, through solid; otherwise outward, through free space.
std::optional<Thin> look_through_solid(const SolidSurface& surface, const Sample& from, bool wall,
                                       double search_radius) {
  const double step = 1e-4 * search_radius;
  const auto is_inside = [&](const Vector3d& p) { return surface.winding_number(p) > 0.5; };
  const Vector3d direction = wall ? Vector3d(-from.normal) : from.normal;
  TriangleTree::RayHit hit{};
  for (double begin = step; surface.solid_triangles().first_hit(from.point, direction, begin, search_radius, hit);
       begin = hit.t + step) {
    const double cosine = hit.normal.dot(from.normal);
    if (cosine > kFacing) continue;
    const Vector3d middle = from.point + 0.5 * hit.t * direction;
    const bool separates = is_inside(middle) == wall && is_inside(from.point + (hit.t + step) * direction) != wall &&
                           is_inside(from.point - step * direction) != wall;
    if (separates) return Thin{hit.t, middle, cosine < kParallel};
  }
  return std::nullopt;
}

/// Returns the free space between a thickened sheet and the surface that faces it in `direction`.
std::optional<Thin> look_from_shell(const SolidSurface& surface, const Sample& from, const Vector3d& direction,
                                    double search_radius) {
  const double half = 0.5 * surface.thickness();
  const double step = 1e-4 * search_radius;
  std::optional<Thin> nearest;
  for (const bool other_is_shell : {true, false}) {
    const double covered = half + (other_is_shell ? half : 0.0);
    const TriangleTree& tree = other_is_shell ? surface.shell_triangles() : surface.solid_triangles();
    TriangleTree::RayHit hit{};
    if (!tree.first_hit(from.point, direction, step, covered + search_radius, hit)) continue;
    if (std::abs(hit.normal.dot(direction)) < -kFacing || hit.t <= covered) continue;
    const double gap = hit.t - covered;
    if (!nearest || gap < nearest->thickness) nearest = Thin{gap, from.point + (half + 0.5 * gap) * direction, false};
  }
  return nearest;
}

/// Measures the largest set of lost places that are connected by steps of one and a half voxels.
void measure_lost(const std::vector<Thin>& lost, double area_each, double voxel_size, ThinPlaces& places) {
  using Cell = std::array<int, 3>;
  struct Hash {
    std::size_t operator()(const Cell& c) const noexcept {
      return static_cast<std::size_t>(c[0]) * 73856093u ^ static_cast<std::size_t>(c[1]) * 19349663u ^
             static_cast<std::size_t>(c[2]) * 83492791u;
    }
  };
  const double width = 1.5 * voxel_size;
  std::unordered_map<Cell, std::vector<std::size_t>, Hash> cells;
  const auto cell_of = [&](const Vector3d& p) {
    return Cell{static_cast<int>(std::floor(p.x() / width)), static_cast<int>(std::floor(p.y() / width)),
                static_cast<int>(std::floor(p.z() / width))};
  };
  for (std::size_t i = 0; i < lost.size(); ++i) cells[cell_of(lost[i].middle)].push_back(i);
  std::vector<bool> taken(lost.size());
  for (std::size_t seed = 0; seed < lost.size(); ++seed) {
    if (taken[seed]) continue;
    taken[seed] = true;
    std::vector<std::size_t> patch = {seed};
    for (std::size_t next = 0; next < patch.size(); ++next) {
      const Vector3d& p = lost[patch[next]].middle;
      const Cell center = cell_of(p);
      for (int n = 0; n < 27; ++n) {
        const auto found = cells.find({center[0] + n % 3 - 1, center[1] + n / 3 % 3 - 1, center[2] + n / 9 - 1});
        if (found == cells.end()) continue;
        for (const std::size_t other : found->second) {
          if (taken[other] || (lost[other].middle - p).norm() > width) continue;
          taken[other] = true;
          patch.push_back(other);
        }
      }
    }
    const double area = 0.5 * area_each * static_cast<double>(patch.size());  // both faces see it
    if (area <= places.lost_patch) continue;
    const auto thinnest = std::min_element(patch.begin(), patch.end(), [&](std::size_t a, std::size_t b) {
      return lost[a].thickness < lost[b].thickness;
    });
    places.lost_patch = area;
    places.lost_thickness = lost[*thinnest].thickness;
    places.lost_at = lost[*thinnest].middle;
  }
}

ThinPlaces gather(const std::vector<std::optional<Thin>>& seen, double area_each, double voxel_size) {
  ThinPlaces places;
  std::vector<Thin> lost;
  for (const std::optional<Thin>& thin : seen) {
    if (!thin) continue;
    if (places.samples++ == 0 || thin->thickness < places.smallest) {
      places.smallest = thin->thickness;
      places.at = thin->middle;
    }
    if (thin->thickness >= kLost * voxel_size * (1.0 - kThicknessRounding)) continue;
    places.lost_area += 0.5 * area_each;
    if (thin->parallel) lost.push_back(*thin);
  }
  places.area = 0.5 * area_each * static_cast<double>(places.samples);
  places.voxel_needed = places.smallest / kThin;
  measure_lost(lost, area_each, voxel_size, places);
  return places;
}

}  // namespace

ThinReport find_thin_places(const SolidSurface& surface, double voxel_size, const parallel::Progress& progress) {
  const Samples samples = sample(surface, voxel_size);
  const double search_radius = kThin * voxel_size * (1.0 - kThicknessRounding);
  std::vector<std::optional<Thin>> walls(samples.all.size());
  std::vector<std::optional<Thin>> gaps(samples.all.size());
  parallel::for_each_index(
      samples.all.size(),
      [&](std::size_t i) {
        const Sample& from = samples.all[i];
        if (!from.shell) {
          walls[i] = look_through_solid(surface, from, true, search_radius);
          gaps[i] = look_through_solid(surface, from, false, search_radius);
          return;
        }
        if (surface.thickness() < search_radius) walls[i] = Thin{surface.thickness(), from.point, false};
        const auto ahead = look_from_shell(surface, from, from.normal, search_radius);
        const auto behind = look_from_shell(surface, from, -from.normal, search_radius);
        gaps[i] = !behind || (ahead && ahead->thickness < behind->thickness) ? ahead : behind;
      },
      progress);
  return {gather(walls, samples.area, voxel_size), gather(gaps, samples.area, voxel_size), std::sqrt(samples.area)};
}

void require_walls_that_last(const ThinReport& report, double voxel_size, const std::string& mesh_name) {
  const ThinPlaces& walls = report.walls;
  if (walls.lost_patch <= kRefusedFaces * voxel_size * voxel_size) return;
  const double voxel_that_holds = 0.5 * walls.lost_thickness;
  throw VoxelTooLarge(
      fmt::format("{}: a wall of {:.3g} m over {:.2g} m^2 near ({:.4g}, {:.4g}, {:.4g}) is thinner than the "
                  "voxel of {:g} m and would be "
                  "lost; set voxel_size = {:.2g} or smaller, or surface = \"shell\" to thicken it",
                  mesh_name, walls.lost_thickness, walls.lost_patch, walls.lost_at.x(), walls.lost_at.y(),
                  walls.lost_at.z(), voxel_size, voxel_that_holds),
      VoxelTooLarge::Body::kStill, voxel_that_holds);
}

}  // namespace godobject::scene_compiler
