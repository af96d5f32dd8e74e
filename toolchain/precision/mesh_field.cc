#include "toolchain/precision/mesh_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace godobject::precision {

FieldSample MeshField::sample(const Vector3& p) const noexcept {
  constexpr double kOnSurface_m = 1e-9;
  const auto closest = surface_->closest(p);
  const double signed_distance = surface_->signed_distance(p, closest.distance);
  const bool on_shell = surface_->components()[surface_->component_of_triangle()[closest.triangle]].shell;
  FieldSample sample{signed_distance, Vector3::Zero(), true, std::max(0.0, signed_distance)};
  if (closest.distance > kOnSurface_m) {
    const double side = !on_shell && signed_distance < 0.0 ? -1.0 : 1.0;
    sample.gradient = side / closest.distance * (p - closest.point);
  } else {
    const auto& corners = surface_->mesh().triangles[closest.triangle];
    const auto& v = surface_->mesh().vertices;
    sample.gradient = (v[corners[1]] - v[corners[0]]).cross(v[corners[2]] - v[corners[0]]).normalized();
  }
  return sample;
}

LayerSample MeshField::layer(const Vector3& p) const noexcept {
  const Vector3 center = voxel_size_ * (p / voxel_size_).array().round().matrix();
  return {static_cast<int>(std::floor(0.5 - distance(center) / voxel_size_)), center - p};
}

double MeshField::lower_bound(const Vector3& center, double radius) const noexcept {
  // the winding number, which takes longest, matters only if the surface is farther away than the radius
  const double nearest = surface_->closest(center).distance;
  const double bound = nearest < radius ? -1.0 : surface_->signed_distance(center, nearest) - radius;
  return bound >= 0.0 ? bound : -std::numeric_limits<double>::infinity();
}

}  // namespace godobject::precision
