#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace godobject::scene_compiler {

/// A point on the surface of a body.
struct SurfaceSample {
  /// The kind of feature on which the sample lies. Where samples crowd, the sharper one stays.
  enum class Place : std::uint8_t { kFace = 0, kEdge = 1, kVertex = 2 };

  Eigen::Vector3d point;
  Eigen::Vector3d inward;  ///< unit normal, into the body
  Place place = Place::kFace;
  bool on_shell = false;  ///< half a thickness off the triangles of a sheet; otherwise on a triangle of a solid
};

inline std::vector<Eigen::Vector3d> points_of(std::span<const SurfaceSample> samples) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(samples.size());
  for (const SurfaceSample& sample : samples) points.push_back(sample.point);
  return points;
}

/// True if the samples lie on the same side of the body. Where the body is thinner than the spacing of the samples,
/// samples of the opposite side are near but have other contacts. They neither crowd nor replace each other.
inline bool same_side(const SurfaceSample& a, const SurfaceSample& b) { return a.inward.dot(b.inward) > -0.5; }

}  // namespace godobject::scene_compiler
